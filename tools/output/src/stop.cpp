#include <plumbline/output/stop.h>

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <future>
#include <thread>
#include <utility>

namespace plumbline::output {
namespace {

/// A file to be removed. Nothing here allocates: a signal comes at any time.
struct Slot {
  enum State : int { kFree, kFilling, kRemembered };
  std::atomic<int> state = kFree;
  std::array<char, PATH_MAX> path{};
};

std::array<Slot, 16> slots;
std::atomic<bool> asks_first = false;
std::atomic<int> asked_by = 0;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

/// SIGUSR1 is what batch systems and mpirun hand on without an end that follows.
bool may_ask(int signal) {
  return signal == SIGINT || signal == SIGTERM || signal == SIGHUP || signal == SIGUSR1;
}

extern "C" void plumbline_on_signal(int signal) {
  int none = 0;
  if (may_ask(signal) && asks_first && asked_by.compare_exchange_strong(none, signal)) return;
  const int before = errno;
  for (const Slot& slot : slots) {
    if (slot.state == Slot::kRemembered) unlink(slot.path.data());
  }
  errno = before;
  std::signal(signal, SIG_DFL);
  raise(signal);  // held back until this function returns
}

}  // namespace

void handle_signals() {
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGALRM, SIGXCPU, SIGUSR1,
                           SIGUSR2, SIGVTALRM, SIGPROF}) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = plumbline_on_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

StopRequests::StopRequests() {
  asked_by = 0;
  asks_first = true;
}

StopRequests::~StopRequests() { asks_first = false; }

int stop_signal() noexcept { return asked_by.load(std::memory_order_relaxed); }

void ask_to_stop(int signal) noexcept {
  int none = 0;
  if (asks_first) asked_by.compare_exchange_strong(none, signal);
}

bool finishes_before_stop(const std::function<void()>& work) {
  std::packaged_task<void()> task(work);
  std::future<void> end = task.get_future();
  std::thread thread(std::move(task));
  constexpr std::chrono::milliseconds kLook(50);
  while (end.wait_for(kLook) != std::future_status::ready) {
    if (stop_signal() == 0) continue;
    thread.detach();
    return false;
  }
  thread.join();
  end.get();
  return true;
}

int remove_on_signal(const char* path) noexcept {
  const std::size_t bytes = std::strlen(path) + 1;
  if (bytes > PATH_MAX) return -1;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    int free = Slot::kFree;
    if (!slots[i].state.compare_exchange_strong(free, Slot::kFilling)) continue;
    std::memcpy(slots[i].path.data(), path, bytes);
    slots[i].state = Slot::kRemembered;
    return static_cast<int>(i);
  }
  return -1;
}

void forget_on_signal(int slot) noexcept {
  if (slot >= 0) slots[static_cast<std::size_t>(slot)].state = Slot::kFree;
}

}  // namespace plumbline::output
