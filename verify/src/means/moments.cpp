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

namespace {

/// Lower limit, so many standard errors below the estimate, of the tail index from an octave on
/// that holds `above` samples at or above it, which lie `excess` octaves beyond it in all. Octaves
/// beyond the start are geometric with ratio 2^-a: maximum likelihood and its error.
double lowest_tail_index(double above, double excess, double errors) {
  constexpr double kLog2 = 0.69314718055994531;
  const double ratio = excess / (above + excess);
  const double ratio_error = std::sqrt(ratio * (1 - ratio) * (1 - ratio) / above);
  return -std::log2(ratio) - errors * ratio_error / (ratio * kLog2);
}

}  // namespace

double Moments::tail_index() const {
  constexpr double kBounded = std::numeric_limits<double>::infinity();
  if (count_ < 100'000) return kBounded;
  // A tail starts at the highest octave with a thousandth of the samples at or above it. It may
  // fall off slowly there and end all the same, as the values of a narrow lobe do over directions
  // that are even over the sphere: they reach over many octaves, up to the lobe's peak. So it is
  // looked at from each higher octave too that holds enough samples to tell. A tail of index 2 has
  // none of so many beyond such a start with a chance of 0.75^64 = 1e-8; and since up to a dozen
  // starts are looked at, three standard errors hold for them, and two for the first.
  constexpr double kEnoughToTell = 64;
  const double first_start = static_cast<double>(count_) * 1e-3;
  double above = 0, excess = 0;
  double largest = -kBounded;
  for (std::size_t i = octaves_.size(); i-- > 0;) {
    above += static_cast<double>(octaves_[i]);
    const bool last = above >= first_start;
    if (last || above >= kEnoughToTell) {
      if (excess == 0) return kBounded;
      largest = std::max(largest, lowest_tail_index(above, excess, last ? 2 : 3));
    }
    if (last) break;
    excess += above;
  }
  return largest;
}

}  // namespace plumbline::verify
