#include "command_line.h"

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

bool run_and_kill(const std::filesystem::path& directory, const std::string& arguments,
                  double seconds) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  // exec: the signal must meet the command, not the shell before it.
  if (child == 0) become_shell(directory, "exec '" + kCommand + "' " + arguments + " >/dev/null");
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  const bool running = waitpid(child, nullptr, WNOHANG) == 0;
  if (running) {
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  return running;
}

}  // namespace plumbline::tests
