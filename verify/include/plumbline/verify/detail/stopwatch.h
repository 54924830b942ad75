#pragma once

#include <chrono>

namespace plumbline::verify {

/// Wall-clock time since it was made or restarted.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

  /// `seconds`, and begins anew.
  double lap() {
    const double elapsed = seconds();
    began_ = std::chrono::steady_clock::now();
    return elapsed;
  }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace plumbline::verify
