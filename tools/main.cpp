#include <fmt/core.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/nearest_name.h>

#include "command.h"

namespace plumbline::tools {
namespace {

constexpr const char* kExamples = R"(Examples:
  plumbline list scenes
  plumbline render furnace_sphere -o furnace.exr --strategy mis --spp 256
  plumbline compare furnace.exr --scene furnace_sphere
  plumbline verify --exec './my_bsdf'
  plumbline calibrate
  plumbline history list --history build/history.db
  plumbline render bench/scenes/cornell.xml -o cornell.exr --seconds 10 --json cornell.json

Exit codes: 0 fine, 1 a check did not give its expected verdict, 2 bad input or usage,
3 the machine failed (disk full, out of memory).)";

constexpr const char* kOutputLost = "cannot write to the standard output; is it full?";

/// CLI11 says of an unknown command or option in its place only that a command is required.
void check_command_name(const options::CommandLine& line, const std::string& first) {
  const std::vector<std::string> known = line.commands();
  if (std::find(known.begin(), known.end(), first) != known.end()) return;
  if (line.has_option(first)) return;
  throw renderer::InputError(
      fmt::format("there is no command \"{}\"; {}", first, renderer::name_hint(first, known)));
}

int fail(int exit_code, const char* message) {
  fmt::print(stderr, "plumbline: {}\n", message);
  return exit_code;
}

/// Runs the command and turns what it throws into an exit code.
int run_command(const options::Run& run) {
  try {
    const int exit_code = run();
    // What was printed must have arrived: a full disk may lie behind the standard output.
    if (std::fflush(stdout) != 0) return fail(kExitMachineFailed, kOutputLost);
    return exit_code;
  } catch (const renderer::InputError& error) {
    return fail(kExitBadInput, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(kExitBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kExitMachineFailed, "out of memory");
  } catch (const std::exception& error) {
    return fail(kExitMachineFailed, error.what());
  }
}

int main_of(int argc, char** argv) {
  // A file that would outgrow its limit is an error of write(), not a death without a word.
  std::signal(SIGXFSZ, SIG_IGN);
  options::CommandLine line("Checks Monte Carlo sampling code, around a compact MIS renderer",
                            "plumbline");
  line.add_version(PLUMBLINE_VERSION);
  line.program().footer(kExamples);
  add_list_command(line);
  add_render_command(line);
  add_check_command(line);
  add_compare_command(line);
  add_calibrate_command(line);
  add_verify_command(line);
  add_init_command(line);
  add_report_command(line);
  add_history_command(line);
  try {
    if (argc > 1) check_command_name(line, argv[1]);
    if (const std::optional<bool> printed = line.parse(argc, argv)) {
      if (!*printed) return kExitBadInput;
      return std::cout.flush() ? kExitFine : fail(kExitMachineFailed, kOutputLost);
    }
  } catch (const renderer::InputError& error) {
    return fail(kExitBadInput, error.what());
  }
  return run_command(line.chosen());
}

}  // namespace
}  // namespace plumbline::tools

int main(int argc, char** argv) { return plumbline::tools::main_of(argc, argv); }
