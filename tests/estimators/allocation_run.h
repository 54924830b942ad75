#pragma once

#include <cstddef>
#include <cstdint>

#include <plumbline/renderer/estimators/allocation.h>
#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/mean.h>

#include "integral_problem.h"

namespace plumbline::tests {

/// Draws from an integral with two densities as the renderer draws from a pixel.
class IntegralDraw {
 public:
  IntegralDraw(const analytic::Integral1d& integral, verify::Random& random)
      : problem_(integral), uniform_(random) {}

  renderer::TechniqueSample<double> operator()(std::size_t technique) const {
    const double x = *problem_.sample(technique, uniform_);
    const double own = problem_.density(technique, x).pdf;
    return {problem_.value(x) / own, own, problem_.density(1 - technique, x).pdf};
  }

 private:
  IntegralProblem<double> problem_;
  mutable Uniform<double> uniform_;
};

/// A sampler for the checks: each of its samples is what `run(random)` makes of one whole run.
template <class Run>
verify::MomentSampler runs(std::uint64_t seed, const Run& run) {
  return [seed, run](std::uint64_t first, std::uint64_t count) {
    verify::Moments moments;
    for (std::uint64_t i = first; i < first + count; ++i) {
      verify::Random random(seed, i);
      moments.add(run(random));
    }
    return moments;
  };
}

}  // namespace plumbline::tests
