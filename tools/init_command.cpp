#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <plumbline/output/output_file.h>
#include <plumbline/renderer/core/errors.h>

#include "command.h"
#include "init_templates.h"

namespace plumbline::tools {
namespace {

namespace fs = std::filesystem;

struct InitArguments {
  std::string directory, language = "cpp";
};

/// Nothing that is there is written over.
void require_room(const fs::path& directory, const std::vector<TemplateFile>& files) {
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error)) {
    throw renderer::InputError(directory.string() + ": is not a directory");
  }
  for (const TemplateFile& file : files) {
    if (fs::exists(fs::symlink_status(directory / file.name, error))) {
      throw renderer::InputError((directory / file.name).string() +
                                 ": is there already; nothing was written");
    }
  }
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw renderer::MachineError(path.string() + ": cannot be written");
}

std::string next_steps(const InitArguments& arguments) {
  const std::string& at = arguments.directory;
  if (arguments.language == "python") {
    return fmt::format(
        "  python3 -m pytest {}\nwhere the package plumbline is (verify/python/README.md)\n", at);
  }
  return fmt::format(
      "  cmake -S {0} -B {0}/build && cmake --build {0}/build && ctest --test-dir {0}/build "
      "--output-on-failure\n",
      at);
}

int run_init(const InitArguments& arguments) {
  const fs::path directory = arguments.directory;
  std::error_code error;
  const std::string sources = fs::exists(PLUMBLINE_SOURCES, error) ? PLUMBLINE_SOURCES : "";
  const std::vector<TemplateFile> files =
      arguments.language == "python" ? python_template() : cpp_template(sources);
  require_room(directory, files);
  fs::create_directories(directory, error);
  if (error) {
    output::throw_errno(directory.string(), "cannot be made", error.value());
  }
  output::Files written;
  for (const TemplateFile& file : files) {
    written.writes("init", directory / file.name).fill([&](const fs::path& path) {
      write(path, file.text);
    });
  }
  written.finish();
  for (const TemplateFile& file : files) {
    fmt::print("{}\n", (directory / file.name).string());
  }
  fmt::print("\nPut your own BSDF in the place of this one. To run it:\n{}", next_steps(arguments));
  return kExitFine;
}

}  // namespace

void add_init_command(options::CommandLine& line) {
  const auto arguments = std::make_shared<InitArguments>();
  options::Command command =
      line.add_command("init", "Write a test project for a BSDF of your own, which runs");
  command.add("directory", arguments->directory, "Made where it is missing").required();
  command.add("--language", arguments->language, "cpp: CMake and GoogleTest; python: pytest")
      .one_of({"cpp", "python"})
      .shows_default();
  command.footer(
      "Files that are there are never written over.\n\nExamples:\n  plumbline init "
      "sampling_tests\n  plumbline init sampling_tests --language python");
  command.runs([arguments] { return run_init(*arguments); });
}

}  // namespace plumbline::tools
