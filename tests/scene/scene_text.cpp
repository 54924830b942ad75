#include "scene_text.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace plumbline::tests {

TemporaryDirectory::TemporaryDirectory() {
  std::string pattern = (std::filesystem::temp_directory_path() / "plumbline_XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary directory");
  path_ = pattern;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryDirectory::write(const std::string& name,
                                                std::string_view content) const {
  const std::filesystem::path file = path_ / name;
  std::ofstream out(file, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
  return file;
}

std::string scene_with(std::string_view body) {
  return std::string("<scene version=\"3.0.0\">\n") + kSensor + "\n" + std::string(body) +
         "\n</scene>\n";
}

renderer::SceneDescription load_text(const std::string& text,
                                     const std::map<std::string, std::string>& overrides) {
  const TemporaryDirectory directory;
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
  const TemporaryDirectory directory;
  return refusal_of_file(directory.write("scene.xml", text), overrides);
}

}  // namespace plumbline::tests
