#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>

namespace plumbline::exchange {

using Clock = std::chrono::steady_clock;

/// A shell command that runs in a process group of its own; its standard error is ours.
class ChildProcess {
 public:
  enum class Streams {
    pipes,  ///< to its standard input and from its standard output
    none    ///< it reads nothing and writes to our standard error
  };

  /// @param variables  of its environment, beside ours
  /// @throws std::system_error where no process or pipe is to be had
  explicit ChildProcess(const std::string& command, Streams streams = Streams::pipes,
                        const std::map<std::string, std::string>& variables = {});

  /// Kills what is left of its group.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  int input() const { return input_; }    ///< to write to; does not block; −1 once closed
  int output() const { return output_; }  ///< to read from; does not block

  void close_input();

  /// Waits until the command has ended, at most until then; whether it has.
  bool ended(Clock::time_point deadline);

  /// How it ended, as the end of a sentence about "the program": "ended with exit status 3". Empty
  /// while it runs, and where it ended well.
  std::string failure() const;

 private:
  void kill_group();

  pid_t pid_ = -1;
  int input_ = -1, output_ = -1;
  std::optional<int> status_;  // as waitpid gives it
};

/// Writing to a program that is gone is an error of write(), not our death, while this lives.
class IgnoredPipeSignal {
 public:
  IgnoredPipeSignal();
  ~IgnoredPipeSignal();
  IgnoredPipeSignal(const IgnoredPipeSignal&) = delete;
  IgnoredPipeSignal& operator=(const IgnoredPipeSignal&) = delete;

 private:
  void (*before_)(int);
};

}  // namespace plumbline::exchange
