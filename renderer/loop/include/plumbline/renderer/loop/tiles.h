#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>

namespace plumbline::renderer {

/// Part of an image.
struct Tile {
  int first_x, end_x, first_y, end_y;

  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(end_x - first_x) *
           static_cast<std::uint64_t>(end_y - first_y);
  }

  /// function(x, y)
  template <class Function>
  void for_each_pixel(const Function& function) const {
    for (int y = first_y; y < end_y; ++y) {
      for (int x = first_x; x < end_x; ++x) function(x, y);
    }
  }
};

/// Threads that share the tiles of an image. They treat denormal numbers as zero, as Embree asks
/// for.
class TileThreads {
 public:
  /// @param threads  0: one per core
  explicit TileThreads(int threads);

  /// Calls the function for tiles that cover the image once, about `side` pixels wide and high.
  void run(int width, int height, std::size_t side,
           const std::function<void(const Tile&)>& function);

 private:
  oneapi::tbb::global_control limit_;  // an arena alone cannot exceed the number of cores
  oneapi::tbb::task_arena arena_;
};

/// Tells a function of the fraction done, from whichever thread is free to, one at a time.
class ProgressReport {
 public:
  ProgressReport(const std::function<void(double)>& report, std::uint64_t total)
      : report_(report), total_(total) {}

  void advance(std::uint64_t samples) {
    const std::uint64_t done = done_.fetch_add(samples, std::memory_order_relaxed) + samples;
    if (!report_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) report_(static_cast<double>(done) / static_cast<double>(total_));
  }

 private:
  const std::function<void(double)>& report_;
  std::uint64_t total_;
  std::atomic<std::uint64_t> done_ = 0;
  std::mutex mutex_;
};

}  // namespace plumbline::renderer
