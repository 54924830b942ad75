#pragma once

#include <plumbline_tests/support.h>
#include <sys/types.h>

#include <filesystem>
#include <functional>
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

/// Expects exit code 2, and a message that says why.
void expect_refused(const std::filesystem::path& directory, const std::string& arguments,
                    const std::string& why, const std::string& before = "");

/// Everything that `plumbline ARGUMENTS` shows on a terminal.
std::string run_on_terminal(const std::filesystem::path& directory, const std::string& arguments);

/// `plumbline ARGUMENTS` that goes on by itself; killed, if it still runs, at the end.
class Running {
 public:
  /// @param through  what runs it: "mpirun -n 2"
  Running(const std::filesystem::path& directory, const std::string& arguments,
          const std::string& through = "");
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  /// Waits until the condition holds, a minute at most.
  /// @return whether it came to hold while the command ran
  bool waits_for(const std::function<bool()>& condition);

  void signal(int number) const;

  pid_t process() const { return child_; }

  /// Waits for the end. `Outcome::exit_code` is −signal where one ended it.
  Outcome ended();

 private:
  ScratchDirectory outputs_;
  pid_t child_;
};

/// Starts `plumbline ARGUMENTS`, kills it after that time, and waits for its end.
/// @return whether it was still running
bool run_and_kill(const std::filesystem::path& directory, const std::string& arguments,
                  double seconds);

}  // namespace plumbline::tests
