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

/// A directory for one test; gone with the object.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  void write(const std::string& name, const std::string& content) const;
  std::string read(const std::string& name) const;

  /// Names of all files, sorted, separated by spaces.
  std::string listing() const;

 private:
  std::filesystem::path path_;
};

}  // namespace plumbline::tests
