#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include <plumbline/renderer/scene_file/load_scene.h>

#include "command.h"
#include "scene_argument.h"

namespace plumbline::tools {
namespace {

struct CheckArguments {
  std::string scene;
  std::vector<std::string> definitions;
};

int run_check(const CheckArguments& arguments) {
  const std::vector<std::string> problems =
      renderer::check_scene(scene_path(arguments.scene), parse_definitions(arguments.definitions));
  for (const std::string& problem : problems) fmt::print("{}\n", problem);
  if (!problems.empty()) return kExitBadInput;
  fmt::print("{}: can be rendered\n", arguments.scene);
  return kExitFine;
}

}  // namespace

void add_check_command(options::CommandLine& line) {
  const auto arguments = std::make_shared<CheckArguments>();
  options::Command command =
      line.add_command("check", "List all that keeps a scene file from being rendered");
  command.add("scene", arguments->scene, "Scene file, or name of a known scene")
      .required()
      .type("");
  command.add("-D", arguments->definitions, "Value for a <default> of the scene; repeatable")
      .one_value_each()
      .type("NAME=VALUE");
  command.footer(
      R"(One line each, "file:line: what and what to do"; included files are checked too. Exit code 0 where there
is nothing, else 2. docs/scene_format.md says what a scene file may hold.

Example:
  plumbline check scene.xml)");
  command.runs([arguments] { return run_check(*arguments); });
}

}  // namespace plumbline::tools
