#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <plumbline/verify/detail/budget.h>
#include <plumbline/verify/mean.h>

#include "means/mean_judgement.h"

/// How often the mean check fails a correct but skewed estimator, summed exactly; simulated by the
/// calibration.
namespace plumbline::verify {
namespace {

/// Evidence of k hits in n trials.
Evidence bernoulli_evidence(double k, double n) {
  Evidence e;
  const double p = k / n, variance = p * (1 - p);
  e.samples = static_cast<std::uint64_t>(n);
  e.estimate = p;
  e.standard_error = std::sqrt(variance / (n - 1));
  if (variance > 0) {
    e.skewness = (1 - 2 * p) / std::sqrt(variance * n);
    e.largest_share = std::pow(std::max(p, 1 - p), 2) / (n * variance);
  }
  e.smallest = k == n ? 1 : 0;
  e.largest = k == 0 ? 0 : 1;
  return e;
}

double log_binomial(double n, double k, double p) {
  return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) + k * std::log(p) +
         (n - k) * std::log1p(-p);
}

/// Probability of a fail at one look, summed over all outcomes that matter: nothing is simulated,
/// so the check is tested at the level that it really uses.
double false_failure(double p, double n, double level) {
  MeanQuestion q;
  q.reference = p;
  q.tolerance = 0.005 * p;
  q.fail_level = q.last_fail_level = level;
  q.pass_level = 1e-4;
  q.max_samples = static_cast<std::uint64_t>(n);
  const double span = std::max(200.0, 20 * std::sqrt(n * p * (1 - p)));
  double sum = 0;
  for (double k = std::max(0.0, std::floor(n * p - span)); k <= std::min(n, n * p + span); ++k) {
    if (judge_mean(q, bernoulli_evidence(k, n)).verdict == Verdict::fail) {
      sum += std::exp(log_binomial(n, k, p));
    }
  }
  return sum;
}

TEST(FalseFailures, OfABernoulliEstimatorStayBelowTheLevelAtEveryLook) {
  for (const double p : {1e-4, 4e-4, 1e-3, 4e-3, 0.01, 0.1, 0.5, 0.9, 0.96, 0.99, 0.999, 0.9999}) {
    const LookPlan plan = plan_looks(1250, 1 << 24, ErrorBudget{});
    double total = 0;
    for (std::size_t k = 0; k < plan.samples.size(); ++k) {
      const double chance =
          false_failure(p, static_cast<double>(plan.samples[k]), plan.fail_level[k]);
      // Outcomes are discrete: the tail in steps can exceed its normal value by a few percent.
      EXPECT_LE(chance, 1.05 * plan.fail_level[k]) << "p " << p << ", n " << plan.samples[k];
      total += chance;
    }
    EXPECT_LE(total, ErrorBudget{}.fail_level()) << p;
  }
}

TEST(FalseFailures, WouldBeManyForThePlainNormalTest) {
  // The negative control of the above: 20 hits expected, so 5 are seen now and then, and look 6.7
  // standard errors off.
  const double n = 20'000, p = 1e-3;
  double sum = 0;
  for (double k = 1; k < 100; ++k) {
    const Evidence e = bernoulli_evidence(k, n);
    if (std::abs(e.estimate - p) / e.standard_error > 5.73) sum += std::exp(log_binomial(n, k, p));
  }
  EXPECT_GT(sum, 1e-5);
}

}  // namespace
}  // namespace plumbline::verify
