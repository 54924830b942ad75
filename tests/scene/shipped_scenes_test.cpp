#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <plumbline/renderer/render/exr.h>

#include "scene_text.h"

/// What the repository ships and what it documents is what the reader takes.
namespace plumbline::tests {
namespace {

const std::filesystem::path kSource = PLUMBLINE_SOURCE_DIR;

std::vector<std::filesystem::path> scene_files() {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"analytic/scenes", "bench/scenes"}) {
    for (const auto& entry : std::filesystem::directory_iterator(kSource / folder)) {
      if (entry.path().extension() == ".xml") files.push_back(entry.path());
    }
  }
  return files;
}

TEST(ShippedScenes, AreAllTaken) {
  const auto files = scene_files();
  EXPECT_GE(files.size(), 7u);
  for (const auto& file : files) {
    EXPECT_NO_THROW(renderer::load_scene(file)) << file;
  }
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ShippedScenes, AreThereForPbrtWhereItHasTheMaterials) {
  for (const auto& file : scene_files()) {
    if (file.parent_path().filename() != "scenes" ||
        file.parent_path().parent_path().filename() != "analytic") {
      continue;
    }
    const std::string xml = text_of(file);
    bool expressible = true;
    for (const char* type : {"phong", "clearcoat", "thinfilm", "blendbsdf", "twosided", "sun"}) {
      expressible =
          expressible && xml.find("type=\"" + std::string(type) + "\"") == std::string::npos;
    }
    std::filesystem::path pbrt = file;
    pbrt.replace_extension(".pbrt");
    EXPECT_EQ(std::filesystem::exists(pbrt), expressible) << pbrt;
    if (expressible) {
      // As many shapes, one camera, the same film.
      const std::string text = text_of(pbrt);
      const auto count = [](const std::string& in, const std::string& word) {
        std::size_t n = 0;
        for (std::size_t at = in.find(word); at != std::string::npos; at = in.find(word, at + 1)) {
          ++n;
        }
        return n;
      };
      EXPECT_EQ(count(text, "  Shape \""), count(xml, "<shape ")) << pbrt;
      EXPECT_EQ(count(text, "AreaLightSource"), count(xml, "<emitter type=\"area\"")) << pbrt;
      EXPECT_EQ(count(text, "Camera \"perspective\""), 1u) << pbrt;
    }
  }
}

/// The blocks between ```xml and ``` of docs/scene_format.md.
std::vector<std::string> documented_examples() {
  std::ifstream in(kSource / "docs/scene_format.md");
  std::vector<std::string> examples;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line == "```xml") {
      inside = true;
      examples.emplace_back();
    } else if (line == "```") {
      inside = false;
    } else if (inside) {
      examples.back() += line + "\n";
    }
  }
  return examples;
}

TEST(SceneFormatDocument, ExamplesAreTaken) {
  const auto examples = documented_examples();
  EXPECT_GE(examples.size(), 8u);
  for (const std::string& example : examples) {
    const ScratchDirectory directory;
    directory.write("bunny.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    renderer::write_exr(directory.path() / "sky.exr", {1, 1, {{1, 1, 1}}, {}, {}, {}});
    // An example is a whole file or a part of one.
    const bool whole = example.rfind("<scene", 0) == 0 || example.rfind("<?xml", 0) == 0;
    const auto file = directory.write(
        "scene.xml", whole ? example
                           : "<scene version=\"3.0.0\">\n" + example +
                                 (example.find("<sensor") == std::string::npos ? kSensor : "") +
                                 "<shape type=\"sphere\"/></scene>");
    EXPECT_EQ(refusal_of_file(file), "") << example;
  }
}

}  // namespace
}  // namespace plumbline::tests
