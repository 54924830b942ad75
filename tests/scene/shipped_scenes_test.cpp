#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

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
    const TemporaryDirectory directory;
    directory.write("bunny.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
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
