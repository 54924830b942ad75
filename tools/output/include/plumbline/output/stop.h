#pragma once

#include <functional>

/// What SIGINT, SIGTERM and other signals do to the command.
namespace plumbline::output {

/// From here on a signal that ends the process first removes its temporary files. What was ignored
/// when the process started (nohup, a job in the background) stays ignored. A file that outgrows
/// its limit is an error of write(2), not a death without a word.
void handle_signals();

/// While one exists, the first SIGINT, SIGTERM, SIGHUP or SIGUSR1 only asks the work to stop, so
/// that it can keep what is done; the second ends the process. One at a time.
class StopRequests {
 public:
  StopRequests();
  ~StopRequests();
  StopRequests(const StopRequests&) = delete;
  StopRequests& operator=(const StopRequests&) = delete;
};

/// The signal that asked the work to stop; 0 where none has. Cheap, from any thread.
int stop_signal() noexcept;

/// As if the signal had come, where StopRequests wait for the first: from another process that was
/// asked.
void ask_to_stop(int signal) noexcept;

/// Does work that knows nothing of signals: in a thread of its own, which is left behind where a
/// signal asks to stop. What it throws is thrown on.
///
/// @return  whether it came to its end; where not, the process must end without destructors
///          (`std::_Exit`), for the thread still works
bool finishes_before_stop(const std::function<void()>& work);

/// As shells call a process that a signal ended: 130 for SIGINT, 143 for SIGTERM, 129 for SIGHUP,
/// 138 for SIGUSR1.
constexpr int exit_code_of_signal(int signal) { return 128 + signal; }

/// Removes the file if a signal ends the process, until it is forgotten. A name longer than the
/// system takes, and more files than a command has, are not remembered.
///
/// @return  to forget it by; −1 where it is not remembered
int remove_on_signal(const char* path) noexcept;
void forget_on_signal(int slot) noexcept;

}  // namespace plumbline::output
