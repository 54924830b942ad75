#pragma once

#include <functional>
#include <string>
#include <vector>

#include <plumbline/analytic/estimator_moments.h>
#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/mean.h>

namespace plumbline::tests {

/// One way of estimating one integral, with what it must give exactly.
struct EstimatorCase {
  std::string integral;
  std::string strategy;  ///< "multi-sample power 2, counts 1 1"
  double value = 0;      ///< of the integral; not always the estimator's mean
  analytic::Moments exact;
  double samples = 1;    ///< drawn for one estimate
  std::string featured;  ///< its short name in the figure of error against N; empty if not there
  std::function<double(verify::Random&)> draw;

  std::string subject() const { return integral + "/" + strategy; }
};

/// All strategies on an integral: each technique alone, the two wrong averages, multi-sample with
/// every heuristic and several counts, one-sample, coin flip, deterministic mixture, optimal
/// weights.
std::vector<EstimatorCase> estimator_cases(const analytic::Integral1d& integral);

/// Coefficients α of the optimal weights from the system by quadrature.
std::vector<double> optimal_alpha(const analytic::Integral1d& integral,
                                  const std::vector<int>& counts);

/// A sampler for the checks: `transform` of one estimate is one sample.
verify::MomentSampler moment_sampler(const EstimatorCase& c, std::uint64_t seed,
                                     std::function<double(double)> transform);

}  // namespace plumbline::tests
