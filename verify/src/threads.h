#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace plumbline::verify {

/// f(0) to f(count − 1), some at the same time. What the first of them throws, in their order, is
/// thrown when all have ended.
template <class F>
void on_threads(int threads, std::size_t count, const F& f) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) f(i);
    return;
  }
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> thrown(count);
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        f(i);
      } catch (...) {
        thrown[i] = std::current_exception();
      }
    }
  };
  std::vector<std::jthread> others;
  const std::size_t more = std::min(static_cast<std::size_t>(threads), count) - 1;
  for (std::size_t i = 0; i < more; ++i) others.emplace_back(work);
  work();
  others.clear();  // joins
  for (const std::exception_ptr& e : thrown) {
    if (e) std::rethrow_exception(e);
  }
}

}  // namespace plumbline::verify
