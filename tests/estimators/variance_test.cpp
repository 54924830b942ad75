#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <plumbline/verify/mean.h>
#include <plumbline_tests/support.h>

#include "estimator_cases.h"

// Every strategy on every integral: the mean and the variance that it has are those that it must
// have.
namespace plumbline::tests {
namespace {

using verify::Verdict;

/// A quantity of which a check estimates the mean: what decides how many samples that takes.
struct Target {
  double mean = 0, variance = 0, third = 0;  ///< the last two central

  double cv2() const { return variance / (mean * mean); }
  double skewness() const { return third / std::pow(variance, 1.5); }
};

Target of_estimate(const EstimatorCase& c) { return {c.value, c.exact.variance, c.exact.third}; }

/// (F − E F)²: its mean is the variance of F, its variance is μ₄ − σ⁴.
Target of_square(const EstimatorCase& c) {
  const double v = c.exact.variance;
  return {v, c.exact.fourth - v * v, c.exact.sixth - 3 * v * c.exact.fourth + 2 * v * v * v};
}

/// Samples after which a correct estimator has certainly proven the tolerance: enough for the
/// bound, and four times what brings the skewness of the estimate down to the guard's 0.05.
double needed(const Target& target, double tolerance) {
  const double cv = std::sqrt(std::max(0.0, target.cv2()));
  return std::max(static_cast<double>(verify::samples_to_decide(tolerance, cv)),
                  4 * std::pow(target.skewness() / 0.05, 2));
}

/// Tolerance and cap of a check, chosen from the exact moments before any sample is drawn: the
/// finest of a few tolerances that a short run proves, else the coarsest with a longer run, else
/// none.
struct Plan {
  double tolerance = 0;
  std::uint64_t cap = 0;
  bool provable = false;
};

Plan plan(const Target& target, const std::vector<double>& tolerances) {
  const double effort = nightly() ? 64 : 1;
  for (const double tolerance : tolerances) {
    const double samples = needed(target, tolerance);
    const bool last = tolerance == tolerances.back();
    if (samples <= (last ? 0x1p23 : 0x1p17) * effort) {
      return {tolerance, std::max<std::uint64_t>(1 << 15, static_cast<std::uint64_t>(samples)),
              true};
    }
  }
  return {tolerances.back(), 1 << 15, false};
}

verify::CheckResult mean_of(const EstimatorCase& c) {
  const Plan p = plan(of_estimate(c), {0.002, 0.005, 0.01, 0.02, 0.05});
  const double bias = std::abs(c.exact.mean / c.value - 1);
  verify::MeanOptions options;
  options.subject = c.subject();
  options.reference = c.value;
  options.tolerance = p.tolerance;
  options.max_samples = p.cap;
  options.exact_variance = c.exact.variance;
  if (!p.provable) {
    options.expected = Verdict::inconclusive;
  } else if (bias > p.tolerance) {
    options.expected = Verdict::fail;
  }
  options.seed = check_seed(options.subject + "/mean");
  return verify::check_mean(options, moment_sampler(c, options.seed, [](double x) { return x; }));
}

/// A mean check of (F − E F)² with everything known.
verify::CheckResult variance_of(const EstimatorCase& c) {
  const Target target = of_square(c);
  const Plan p = plan(target, {0.01, 0.02, 0.05, 0.1});
  verify::MeanOptions options;
  options.subject = c.subject() + "/variance";
  options.reference = target.mean;
  options.tolerance = p.tolerance;
  options.max_samples = p.cap;
  options.exact_variance = target.variance;
  if (!p.provable) options.expected = Verdict::inconclusive;
  options.seed = check_seed(options.subject);
  const double mean = c.exact.mean;
  verify::CheckResult result = verify::check_mean(
      options,
      moment_sampler(c, options.seed, [mean](double x) { return (x - mean) * (x - mean); }));
  result.kind = verify::CheckKind::variance;
  return result;
}

/// Rounding is all the spread there is: nothing to estimate.
bool is_exact(const EstimatorCase& c) { return c.exact.variance < 1e-20 * c.value * c.value; }

class EveryStrategy : public testing::TestWithParam<std::size_t> {
 protected:
  std::vector<EstimatorCase> cases_ = estimator_cases(analytic::known_integrals()[GetParam()]);
};

TEST_P(EveryStrategy, HasTheMeanItMustHave) {
  for (const EstimatorCase& c : cases_) expect_verdict(mean_of(c));
}

TEST_P(EveryStrategy, HasTheVarianceItMustHave) {
  for (const EstimatorCase& c : cases_) {
    if (std::isinf(c.exact.variance)) continue;  // heavy_tail_test.cpp
    if (is_exact(c)) {
      const auto sample = moment_sampler(c, check_seed(c.subject()), [](double x) { return x; });
      EXPECT_LE(sample(0, 10000).variance(), 1e-24 * c.value * c.value) << c.subject();
    } else {
      expect_verdict(variance_of(c));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Integrals, EveryStrategy,
                         testing::Range<std::size_t>(0, analytic::known_integrals().size()),
                         [](const auto& param) {
                           return analytic::known_integrals()[param.param].name;
                         });

TEST(EveryStrategyControl, AWrongVarianceIsCaught) {
  EstimatorCase c = estimator_cases(analytic::two_steps())[2];
  ASSERT_EQ(c.strategy, "naive average");
  c.exact.variance *= 1.15;
  verify::CheckResult result = variance_of(c);
  result.expected = Verdict::fail;
  result.subject += "/15 % too large";
  expect_verdict(result);
}

}  // namespace
}  // namespace plumbline::tests
