#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <locale>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/output/failure.h>
#include <plumbline/output/stop.h>
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
3 the machine failed (disk full, out of memory, of threads or of files), 128 + N ended by the signal N:
130 for Ctrl-C, 143 for TERM, 129 for HUP, 138 for USR1.)";

constexpr const char* kOutputLost = "cannot write to the standard output; is it full?";

/// CLI11 says of an unknown command or option in its place only that a command is required.
void check_command_name(const options::CommandLine& line, const std::string& first) {
  const std::vector<std::string> known = line.commands();
  if (std::find(known.begin(), known.end(), first) != known.end()) return;
  if (line.has_option(first)) return;
  throw renderer::InputError(
      fmt::format("there is no command \"{}\"; {}", first, renderer::name_hint(first, known)));
}

int fail(const output::Failure& failure) noexcept {
  output::tell("plumbline: ");
  output::tell(failure.what);
  output::tell("\n");
  return failure.exit_code;
}

/// A file that is opened must not become the standard output, and take what is printed.
void open_standard_files() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(file, F_GETFD) == -1 && errno == EBADF && open("/dev/null", O_RDWR) != file) {
      std::_Exit(kExitMachineFailed);  // and nowhere to say it
    }
  }
}

void start() {
  open_standard_files();
  output::handle_signals();
  std::setlocale(LC_ALL, "C");  // numbers in files and messages have a point, whoever runs it
  std::locale::global(std::locale::classic());
}

/// What the command line asks for.
int run(int argc, char** argv) {
  options::CommandLine line("Checks Monte Carlo sampling code, around a compact MIS renderer",
                            "plumbline");
  line.add_version(PLUMBLINE_VERSION);
  line.program().footer(kExamples);
  add_list_command(line);
  add_render_command(line);
  add_check_command(line);
  add_compare_command(line);
  add_merge_command(line);
  add_calibrate_command(line);
  add_verify_command(line);
  add_init_command(line);
  add_report_command(line);
  add_history_command(line);
  if (argc > 1) check_command_name(line, argv[1]);
  if (const std::optional<bool> printed = line.parse(argc, argv)) {
    if (!*printed) return kExitBadInput;
    if (!std::cout.flush()) throw renderer::MachineError(kOutputLost);
    return kExitFine;
  }
  const int exit_code = line.chosen()();
  // What was printed must have arrived: a full disk may lie behind the standard output.
  if (std::fflush(stdout) != 0) throw renderer::MachineError(kOutputLost);
  return exit_code;
}

int main_of(int argc, char** argv) noexcept {
  try {
    start();
    return run(argc, argv);
  } catch (...) {
    return fail(output::failure_of(std::current_exception()));
  }
}

}  // namespace
}  // namespace plumbline::tools

int main(int argc, char** argv) { return plumbline::tools::main_of(argc, argv); }
