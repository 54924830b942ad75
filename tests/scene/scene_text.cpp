#include "scene_text.h"

#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <plumbline/renderer/core/errors.h>

namespace plumbline::tests {

std::string scene_with(std::string_view body) {
  // Not a sum, in which GCC 12 at -O1 sees a write beyond an array.
  std::string text = "<scene version=\"3.0.0\">\n";
  text.append(kSensor).append("\n").append(body).append("\n</scene>\n");
  return text;
}

renderer::SceneDescription load_text(const std::string& text,
                                     const std::map<std::string, std::string>& overrides) {
  const ScratchDirectory directory;
  return renderer::load_scene(directory.write("scene.xml", text), overrides);
}

std::string refusal_of_file(const std::filesystem::path& file,
                            const std::map<std::string, std::string>& overrides) {
  try {
    renderer::load_scene(file, overrides);
  } catch (const renderer::InputError& error) {
    std::string message = error.what();
    const std::string directory = file.parent_path().string() + "/";
    for (std::size_t at = message.find(directory); at != std::string::npos;
         at = message.find(directory)) {
      message.erase(at, directory.size());
    }
    return message;
  }
  return {};
}

std::string refusal_of_text(const std::string& text,
                            const std::map<std::string, std::string>& overrides) {
  const ScratchDirectory directory;
  return refusal_of_file(directory.write("scene.xml", text), overrides);
}

void expect_near(const renderer::Vec3d& actual, const renderer::Vec3d& expected) {
  EXPECT_NEAR(actual.x, expected.x, kRounding);
  EXPECT_NEAR(actual.y, expected.y, kRounding);
  EXPECT_NEAR(actual.z, expected.z, kRounding);
}

}  // namespace plumbline::tests
