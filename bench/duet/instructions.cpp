#include "instructions.h"

#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace plumbline::duet {
namespace {

/// Stops before the work and after it.
[[noreturn]] void be_counted(const std::function<std::function<void()>()>& prepare) {
  const std::function<void()> measured = prepare();
  measured();  // what is made at the first call is not counted
  if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
  std::raise(SIGSTOP);
  measured();
  std::raise(SIGSTOP);
  _exit(0);
}

/// Waits for the child's next stop.
/// @return the signal that it stopped for; 0 where it has ended
int next_stop(pid_t child) {
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFSTOPPED(status)) return 0;
  return WSTOPSIG(status);
}

bool step(pid_t child) { return ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) == 0; }

void end(pid_t child) {
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

}  // namespace

std::optional<std::uint64_t> count_instructions(
    const std::function<std::function<void()>()>& prepare, std::uint64_t most) {
  const pid_t child = fork();
  if (child < 0) return std::nullopt;
  if (child == 0) be_counted(prepare);
  if (next_stop(child) != SIGSTOP) {
    end(child);
    return std::nullopt;
  }
  std::optional<std::uint64_t> counted;
  for (std::uint64_t steps = 0; steps < most && step(child); ++steps) {
    const int signal = next_stop(child);
    if (signal == SIGTRAP) continue;
    if (signal == SIGSTOP) counted = steps;
    break;
  }
  end(child);
  return counted;
}

}  // namespace plumbline::duet
