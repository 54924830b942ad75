#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace plumbline::mpi {

/// Waits in small steps, so that a rank that waits leaves its core to others.
class Nap {
 public:
  void sleep() {
    std::this_thread::sleep_for(length_);
    length_ = std::min(length_ * 2, kLongest);
  }

 private:
  using Time = std::chrono::microseconds;
  static constexpr Time kLongest{2000};  // no matter beside the tenth of a second of a slice
  Time length_{20};
};

}  // namespace plumbline::mpi
