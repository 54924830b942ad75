#pragma once

#include <ctime>

namespace plumbline::bench {

/// CPU time of this thread [s]: a neighbour's load does not enter it.
inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU time of this thread that `function` takes [s].
template <class Function>
double seconds_of(const Function& function) {
  const double start = thread_seconds();
  function();
  return thread_seconds() - start;
}

}  // namespace plumbline::bench
