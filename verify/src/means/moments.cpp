#include <algorithm>
#include <cmath>
#include <limits>

#include <plumbline/verify/detail/moments.h>

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
  const double na = static_cast<double>(count_), nb = static_cast<double>(other.count_);
  const double n = na + nb;
  const double delta = other.mean_ - mean_;
  m3_ += other.m3_ + delta * delta * delta * na * nb * (na - nb) / (n * n) +
         3 * delta * (na * other.m2_ - nb * m2_) / n;
  m2_ += other.m2_ + delta * delta * na * nb / n;
  mean_ += delta * nb / n;
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
  if (!(m2_ > 0)) return 0;
  const double deviation = std::max(largest_ - mean_, mean_ - smallest_);
  return std::min(1.0, deviation * deviation / m2_);
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
