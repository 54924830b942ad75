#pragma once

#include <chrono>

namespace plumbline::tools {

/// One line on the terminal with the share done and the time left; silent where standard error is
/// not a terminal. Cleared at the end.
class Progress {
 public:
  /// @param seconds      time limit of the work, which then tells how much is done; 0: none
  /// @param has_samples  whether the number of samples is known; without either the line shows time
  Progress(double seconds, bool has_samples);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  bool shown() const { return shown_; }

  /// @param done  share of the samples, in [0, 1]
  void update(double done);

 private:
  using Clock = std::chrono::steady_clock;

  bool shown_, has_samples_;
  double limit_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace plumbline::tools
