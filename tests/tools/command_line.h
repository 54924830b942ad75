#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

/// The command `plumbline` as a person or a script runs it.
namespace plumbline::tests {

struct Outcome {
  int exit_code = -1;  ///< −1 where a signal ended it
  std::string out, err;
};

/// Runs `plumbline ARGUMENTS` through the shell, in that directory.
///
/// @param before  shell commands to run first: "ulimit -f 8;"
Outcome run_plumbline(const std::filesystem::path& directory, const std::string& arguments,
                      const std::string& before = "");

/// Everything that `plumbline ARGUMENTS` shows on a terminal.
std::string run_on_terminal(const std::filesystem::path& directory, const std::string& arguments);

/// Starts `plumbline ARGUMENTS`, kills it after that time, and waits for its end.
/// @return whether it was still running
bool run_and_kill(const std::filesystem::path& directory, const std::string& arguments,
                  double seconds);

}  // namespace plumbline::tests
