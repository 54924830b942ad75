#pragma once

#include <cmath>
#include <numbers>

#include <plumbline/verify/detail/random.h>

/// Noise as machines make it, for simulated nights.
namespace plumbline::verify::history {

/// Standard normal.
/// @source Box, Muller 1958
inline double normal(Random& random) {
  const double radius = std::sqrt(-2 * std::log1p(-random.uniform()));
  return radius * std::cos(2 * std::numbers::pi * random.uniform());
}

/// A stationary sequence with standard deviation 1 in which neighbours are correlated: AR(1).
class CorrelatedNoise {
 public:
  /// @param correlation  of neighbours, in (−1, 1)
  CorrelatedNoise(Random& random, double correlation)
      : random_(random), correlation_(correlation), state_(normal(random)) {}

  double next() {
    const double result = state_;
    state_ = correlation_ * state_ + std::sqrt(1 - correlation_ * correlation_) * normal(random_);
    return result;
  }

 private:
  Random& random_;
  double correlation_, state_;
};

}  // namespace plumbline::verify::history
