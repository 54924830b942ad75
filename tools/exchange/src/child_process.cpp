#include "child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace plumbline::exchange {
namespace {

constexpr int kPipeSize = 1 << 20;  // bytes; what an ordinary user may ask for

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// Closed at the end unless it is taken.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {
    if (number < 0) fail("no pipe to the program");
  }
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

  /// Reading and writing do not block then.
  int take() {
    fcntl(number_, F_SETFL, fcntl(number_, F_GETFL) | O_NONBLOCK);
    return std::exchange(number_, -1);
  }

 private:
  int number_;
};

struct Pipe {
  std::array<int, 2> ends = make();
  Descriptor reader{ends[0]}, writer{ends[1]};

  static std::array<int, 2> make() {
    std::array<int, 2> both{-1, -1};
    if (pipe2(both.data(), O_CLOEXEC) != 0) fail("no pipe to the program");
    fcntl(both[1], F_SETPIPE_SZ, kPipeSize);  // a wish
    return both;
  }
};

/// A program by its path, without anything that a shell must do afterwards, takes the shell's
/// place: what it closes is closed then, and the signal that ends it is seen.
std::string in_place_of_shell(const std::string& command) {
  constexpr std::string_view kSpecial = "|&;<>()$`\\\n#*?[]{}~!^";
  const std::string_view program = std::string_view(command).substr(0, command.find(' '));
  const bool plain = command.find_first_of(kSpecial) == std::string::npos &&
                     program.find('/') != std::string_view::npos &&
                     program.find_first_of("='\"") == std::string_view::npos;
  return plain ? "exec " + command : command;
}

std::string signal_text(int signal) {
  return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

/// The environment with variables added, as exec takes it.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& variables) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!variables.contains(text.substr(0, text.find('=')))) all.push_back(text);
  }
  for (const auto& [name, value] : variables) all.push_back(name + "=" + value);
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Between fork and exec: nothing here may allocate.
[[noreturn]] void become(int input, int output, pid_t parent, char* const* arguments,
                         char* const* environment) {
  setpgid(0, 0);
  // Should we be killed ourselves. What it has started itself meets the end of its input.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  std::signal(SIGPIPE, SIG_DFL);  // what is ignored stays so across exec
  std::signal(SIGXFSZ, SIG_DFL);
  if (dup2(input, STDIN_FILENO) >= 0 && dup2(output, STDOUT_FILENO) >= 0) {
    execve("/bin/sh", arguments, environment);
  }
  _exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::string& command, Streams streams,
                           const std::map<std::string, std::string>& variables) {
  std::vector<std::string> arguments = {"sh", "-c", in_place_of_shell(command)};
  std::vector<std::string> environment = environment_with(variables);
  const std::vector<char*> argument_list = pointers_to(arguments);
  const std::vector<char*> environment_list = pointers_to(environment);
  const auto start = [&](int input, int output) {
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ < 0) fail("no process for the program");
    if (pid_ == 0) become(input, output, parent, argument_list.data(), environment_list.data());
    setpgid(pid_, pid_);  // by both, whoever comes first
  };
  if (streams == Streams::none) {
    const Descriptor nothing(open("/dev/null", O_RDONLY | O_CLOEXEC));
    start(nothing.number(), STDERR_FILENO);
    return;
  }
  Pipe to, from;
  start(to.reader.number(), from.writer.number());
  input_ = to.writer.take();
  output_ = from.reader.take();
}

ChildProcess::~ChildProcess() {
  close_input();
  if (output_ >= 0) close(output_);
  kill_group();
  if (!status_) waitpid(pid_, nullptr, 0);
}

void ChildProcess::close_input() {
  if (input_ >= 0) close(std::exchange(input_, -1));
}

bool ChildProcess::ended(Clock::time_point deadline) {
  using namespace std::chrono_literals;
  std::chrono::microseconds pause = 100us;
  while (!status_) {
    // Its number is ours until it is reaped; what it started goes by that number.
    siginfo_t info{};
    if (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
        info.si_pid == pid_) {
      kill_group();
      int status = 0;
      waitpid(pid_, &status, 0);
      status_ = status;
    } else if (Clock::now() >= deadline) {
      return false;
    } else {
      std::this_thread::sleep_for(pause);
      pause = std::min<std::chrono::microseconds>(pause * 2, 10ms);
    }
  }
  return true;
}

std::string ChildProcess::failure() const {
  if (!status_) return {};
  if (WIFSIGNALED(*status_)) return "was ended by " + signal_text(WTERMSIG(*status_));
  const int code = WEXITSTATUS(*status_);
  if (code == 0) return {};
  const std::string text = "ended with exit status " + std::to_string(code);
  if (code == 127) return text + " (is the command there?)";
  constexpr int kShellsSignal = 128;
  if (code > kShellsSignal && code < kShellsSignal + NSIG) {
    return text + ": " + signal_text(code - kShellsSignal);
  }
  return text;
}

void ChildProcess::kill_group() {
  if (!status_) kill(-pid_, SIGKILL);
}

IgnoredPipeSignal::IgnoredPipeSignal() : before_(std::signal(SIGPIPE, SIG_IGN)) {}

IgnoredPipeSignal::~IgnoredPipeSignal() { std::signal(SIGPIPE, before_); }

}  // namespace plumbline::exchange
