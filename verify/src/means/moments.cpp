#include <algorithm>
#include <cmath>
#include <limits>

#include <plumbline/verify/detail/moments.h>

#include "means/central_moments.h"

namespace plumbline::verify {

namespace {

int octave(double x, int octaves) {
  if (x == 0) return 0;
  return std::clamp(std::ilogb(x) + octaves / 2, 0, octaves - 1);
}

}  // namespace

void Moments::add(double x) {
  if (!std::isfinite(x)) {
    ++non_finite_;
    return;
  }
  ++count_;
  const double n = static_cast<double>(count_);
  const double delta = x - mean_;
  const double step = delta / n;
  const double term = delta * step * (n - 1);
  mean_ += step;
  m3_ += term * step * (n - 2) - 3 * step * m2_;
  m2_ += term;
  smallest_ = std::min(smallest_, x);
  largest_ = std::max(largest_, x);
  ++octaves_[static_cast<std::size_t>(octave(x, kOctaves))];
}

void Moments::add_rejected() {
  add(0);
  ++rejected_;
}

void Moments::merge(const Moments& other) {
  rejected_ += other.rejected_;
  non_finite_ += other.non_finite_;
  if (other.count_ == 0) return;
  const CentralMoments both =
      merged({static_cast<double>(count_), mean_, m2_, m3_},
             {static_cast<double>(other.count_), other.mean_, other.m2_, other.m3_});
  mean_ = both.mean;
  m2_ = both.m2;
  m3_ = both.m3;
  count_ += other.count_;
  smallest_ = std::min(smallest_, other.smallest_);
  largest_ = std::max(largest_, other.largest_);
  for (std::size_t i = 0; i < octaves_.size(); ++i) octaves_[i] += other.octaves_[i];
}

double Moments::variance() const {
  return count_ < 2 ? 0.0 : m2_ / static_cast<double>(count_ - 1);
}

double Moments::standard_error() const {
  return count_ < 2 ? 0.0 : std::sqrt(variance() / static_cast<double>(count_));
}

double Moments::skewness() const {
  if (!(m2_ > 0)) return 0;
  return std::sqrt(static_cast<double>(count_)) * m3_ / (m2_ * std::sqrt(m2_));
}

double Moments::largest_share() const {
  return verify::largest_share({static_cast<double>(count_), mean_, m2_, m3_}, smallest_, largest_);
}

double Moments::tail_index() const {
  constexpr double kBounded = std::numeric_limits<double>::infinity();
  if (count_ < 100'000) return kBounded;
  // The tail starts at the highest octave with a thousandth of the samples at or above it.
  const double enough = static_cast<double>(count_) * 1e-3;
  double above = 0,
         excess = 0;  // samples in the tail, and the sum of their octaves beyond its start
  for (std::size_t i = octaves_.size(); i-- > 0;) {
    above += static_cast<double>(octaves_[i]);
    if (above >= enough) break;
    excess += above;
  }
  if (excess == 0) return kBounded;
  // Octaves beyond the start are geometric with ratio 2^-a: maximum likelihood and its error.
  const double ratio = excess / (above + excess);
  const double ratio_error = std::sqrt(ratio * (1 - ratio) * (1 - ratio) / above);
  constexpr double kLog2 = 0.69314718055994531;
  return -std::log2(ratio) - 2 * ratio_error / (ratio * kLog2);
}

}  // namespace plumbline::verify
