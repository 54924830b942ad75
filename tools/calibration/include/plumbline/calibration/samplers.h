#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/mean.h>

/// Estimators whose mean and variance are known, for the checks to be held against.
namespace plumbline::calibration {

/// A sampler of a mean check from a function of the generator. Each call continues the sequence.
template <class Draw>
verify::MomentSampler sampler(std::uint64_t seed, Draw draw) {
  return [random = verify::Random(seed), draw](std::uint64_t, std::uint64_t count) mutable {
    verify::Moments moments;
    for (std::uint64_t i = 0; i < count; ++i) moments.add(draw(random));
    return moments;
  };
}

/// Mean p.
struct Bernoulli {
  double p;
  double operator()(verify::Random& random) const { return random.uniform() < p ? 1.0 : 0.0; }
};

/// Mean 1, uniform within ± `spread`: coefficient of variation spread/√3.
struct Uniform {
  double spread = 1;
  double operator()(verify::Random& random) const {
    return 1 + spread * (2 * random.uniform() - 1);
  }
};

/// Mean 1, coefficient of variation √(e^σ² − 1).
struct Lognormal {
  double sigma;
  double operator()(verify::Random& random) const {
    // Box–Muller; 1 − u is never 0.
    const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
    const double normal = radius * std::cos(2 * std::numbers::pi * random.uniform());
    return std::exp(sigma * normal - sigma * sigma / 2);
  }
};

/// Mean 1, P(X > t) ∝ t^-index: variance finite for an index above 2.
struct Pareto {
  double index;
  double operator()(verify::Random& random) const {
    return (index - 1) / index * std::pow(1 - random.uniform(), -1 / index);
  }
};

/// Mean 1, coefficient of variation 1.
struct Exponential {
  double operator()(verify::Random& random) const { return -std::log(1 - random.uniform()); }
};

}  // namespace plumbline::calibration
