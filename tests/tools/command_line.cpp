#include "command_line.h"

#include <gtest/gtest.h>
#include <plumbline_tests/support.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <utility>

namespace plumbline::tests {
namespace {

const std::string kCommand = PLUMBLINE_COMMAND;

/// Replaces this process, which a fork has made, by the shell.
[[noreturn]] void become_shell(const std::filesystem::path& directory, const std::string& command) {
  if (chdir(directory.c_str()) == 0) {
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
  }
  _exit(127);
}

}  // namespace

Outcome run_plumbline(const std::filesystem::path& directory, const std::string& arguments,
                      const std::string& before) {
  const ScratchDirectory outputs;
  const std::string redirected =
      arguments.find('>') == std::string::npos ? " >" + (outputs / "out").string() : "";
  const std::string command =
      before + " '" + kCommand + "' " + arguments + redirected + " 2>" + (outputs / "err").string();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) become_shell(directory, command);
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, outputs.read("out"), outputs.read("err")};
}

std::string run_on_terminal(const std::filesystem::path& directory, const std::string& arguments) {
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child < 0) throw std::runtime_error("no terminal");
  if (child == 0) become_shell(directory, "'" + kCommand + "' " + arguments);
  std::string shown;
  std::array<char, 4096> buffer;
  // Reading fails when the last process has left the terminal.
  for (ssize_t n = 0; (n = read(terminal, buffer.data(), buffer.size())) > 0;) {
    shown.append(buffer.data(), static_cast<std::size_t>(n));
  }
  close(terminal);
  waitpid(child, nullptr, 0);
  return shown;
}

Running::Running(const std::filesystem::path& directory, const std::string& arguments,
                 const std::string& through)
    : child_(fork()) {
  if (child_ < 0) throw std::runtime_error("cannot fork");
  if (child_ > 0) return;
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(number, SIG_DFL);
  // exec: the signal must meet the command, not the shell before it.
  become_shell(directory, "exec " + through + " '" + kCommand + "' " + arguments + " >" +
                              (outputs_ / "out").string() + " 2>" + (outputs_ / "err").string());
}

Running::~Running() {
  if (child_ <= 0) return;
  signal(SIGKILL);
  waitpid(child_, nullptr, 0);
}

bool Running::waits_for(const std::function<bool()>& condition) {
  siginfo_t info{};
  const auto runs = [&] {
    return waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == 0;
  };
  constexpr int kTries = 60'000;
  for (int i = 0; i < kTries && runs(); ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

void expect_refused(const std::filesystem::path& directory, const std::string& arguments,
                    const std::string& why, const std::string& before) {
  const Outcome outcome = run_plumbline(directory, arguments, before);
  EXPECT_EQ(outcome.exit_code, 2) << arguments << "\n" << outcome.err;
  EXPECT_NE(outcome.err.find(why), std::string::npos) << arguments << "\n" << outcome.err;
}

void Running::signal(int number) const { kill(child_, number); }

Outcome Running::ended() {
  int status = 0;
  waitpid(std::exchange(child_, 0), &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), outputs_.read("out"),
          outputs_.read("err")};
}

bool run_and_kill(const std::filesystem::path& directory, const std::string& arguments,
                  double seconds) {
  Running running(directory, arguments);
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  const bool is_running = running.waits_for([] { return true; });
  running.signal(SIGKILL);
  running.ended();
  return is_running;
}

}  // namespace plumbline::tests
