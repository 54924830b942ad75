#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <plumbline/renderer/image_io/exr.h>

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
  EXPECT_GE(files.size(), 40u);  // 30 with a closed form, and those of the benchmarks
  for (const auto& file : files) {
    EXPECT_NO_THROW(renderer::load_scene(file)) << file;
  }
}

TEST(ShippedScenes, AreThereForPbrtWhereItHasTheMaterials) {
  int translated = 0;
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
      ++translated;
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
  EXPECT_GE(translated, 21);
}

TEST(ShippedScenes, ForPbrtScaleNoLightOfARoundShape) {
  // pbrt takes the area of a disk or sphere before it is scaled, and with it the light's density.
  int blocks = 0;
  for (const char* folder : {"analytic/scenes", "bench/scenes"}) {
    for (const auto& entry : std::filesystem::directory_iterator(source_file(folder))) {
      if (entry.path().extension() != ".pbrt") continue;
      const std::string text = text_of(entry.path());
      for (std::size_t at = text.find("AttributeBegin"); at != std::string::npos;
           at = text.find("AttributeBegin", at + 1)) {
        const std::string block = text.substr(at, text.find("AttributeEnd", at) - at);
        const auto has = [&](const char* word) { return block.find(word) != std::string::npos; };
        ++blocks;
        EXPECT_FALSE(has("AreaLightSource") && has("Scale ") && !has("trianglemesh"))
            << entry.path() << "\n"
            << block;
      }
    }
  }
  EXPECT_GT(blocks, 1000);
}

constexpr int kSkyWidth = 64, kSkyHeight = 32;

/// Radiance of the skies of bench/scenes/outdoor.xml at the centre of a pixel, rows from the
/// zenith.
renderer::Rgbf sky_radiance(const std::string& sky, int row, int column) {
  constexpr int kSunRow = 8, kSunColumn = 40;
  const auto theta = [](int y) { return (y + 0.5) * renderer::pi<double>() / kSkyHeight; };
  const double turn = (column - kSunColumn) * 2 * renderer::pi<double>() / kSkyWidth;
  const auto rgb = [](double r, double g, double b) {
    return renderer::Rgbf{static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)};
  };
  if (row >= kSkyHeight / 2) return rgb(0.1, 0.1, 0.1);
  // Moon and Spencer 1942: (1 + 2 cosθ)/3 of the zenith.
  if (sky == "overcast") {
    const double grey = (1 + 2 * std::cos(theta(row))) / 3;
    return rgb(grey, grey, grey);
  }
  const double height = 2 * theta(row) / renderer::pi<double>();  // 0 at the zenith, 1 below
  const double blue = 1 + 2 * height * height * height * height;
  if (sky == "clear" && row == kSunRow && column == kSunColumn) return rgb(2100, 1950, 1700);
  // The haze spreads the sun over a standard deviation of 0.12 rad.
  const double cos_to_sun = std::cos(theta(row)) * std::cos(theta(kSunRow)) +
                            std::sin(theta(row)) * std::sin(theta(kSunRow)) * std::cos(turn);
  const double angle = std::acos(std::min(cos_to_sun, 1.0));
  const double sun = sky == "hazy" ? 40 * std::exp(-angle * angle / (2 * 0.12 * 0.12)) : 0;
  return rgb(0.4 * blue + 1.05 * sun, 0.6 * blue + sun, blue + 0.85 * sun);
}

TEST(ShippedScenes, SkiesAreThoseOfTheirFormulas) {
  for (const std::string sky : {"clear", "hazy", "overcast"}) {
    const renderer::Image image =
        renderer::read_exr(kSource / "bench/scenes" / ("outdoor_" + sky + ".exr"));
    ASSERT_EQ(image.width, kSkyWidth);
    ASSERT_EQ(image.height, kSkyHeight);
    for (int i = 0; i < kSkyWidth * kSkyHeight; ++i) {
      const renderer::Rgbf expected = sky_radiance(sky, i / kSkyWidth, i % kSkyWidth);
      const renderer::Rgbf& pixel = image.pixels[static_cast<std::size_t>(i)];
      ASSERT_NEAR(pixel.r, expected.r, 1e-6 * static_cast<double>(expected.r)) << sky << " " << i;
      ASSERT_NEAR(pixel.g, expected.g, 1e-6 * static_cast<double>(expected.g)) << sky << " " << i;
      ASSERT_NEAR(pixel.b, expected.b, 1e-6 * static_cast<double>(expected.b)) << sky << " " << i;
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
