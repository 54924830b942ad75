#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <plumbline/verify/detail/budget.h>
#include <plumbline/verify/mean.h>

#include "means/mean_judgement.h"

/// How often the mean check fails a correct but skewed estimator, or passes a wrong one, at any of
/// its looks: summed exactly over all that Bernoulli estimators may show; others are simulated by
/// the calibration.
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

/// Probabilities of the hits first, first + 1, …
struct Hits {
  std::size_t first = 0;
  std::vector<double> chance;

  /// Of n trials; without those that all together have less than 1e-20.
  static Hits of(double n, double p) {
    const double reach = 10 * std::sqrt(n * p * (1 - p)) + 40;
    Hits hits;
    hits.first = static_cast<std::size_t>(std::max(0.0, std::floor(n * p - reach)));
    const auto last = static_cast<std::size_t>(std::min(n, std::ceil(n * p + reach)));
    for (std::size_t k = hits.first; k <= last; ++k) {
      hits.chance.push_back(std::exp(log_binomial(n, static_cast<double>(k), p)));
    }
    return hits;
  }

  Hits with(const Hits& more) const {
    Hits sum;
    sum.first = first + more.first;
    sum.chance.assign(chance.size() + more.chance.size() - 1, 0.0);
    for (std::size_t i = 0; i < chance.size(); ++i) {
      if (chance[i] < 1e-24) continue;
      for (std::size_t j = 0; j < more.chance.size(); ++j) {
        sum.chance[i + j] += chance[i] * more.chance[j];
      }
    }
    return sum;
  }
};

/// Chances of the verdicts at each look.
struct Verdicts {
  std::vector<double> fail, pass;

  static double sum(const std::vector<double>& v) {
    double total = 0;
    for (const double x : v) total += x;
    return total;
  }
};

/// Takes the outcomes that a look decides out of those that have come so far.
void decide(const MeanQuestion& q, double n, Hits& undecided, Verdicts& verdicts) {
  double fail = 0, pass = 0;
  for (std::size_t i = 0; i < undecided.chance.size(); ++i) {
    double& chance = undecided.chance[i];
    if (chance < 1e-20) continue;
    const double k = static_cast<double>(undecided.first + i);
    const Verdict verdict = judge_mean(q, bernoulli_evidence(k, n)).verdict;
    if (verdict == Verdict::inconclusive) continue;
    (verdict == Verdict::fail ? fail : pass) += chance;
    chance = 0;
  }
  verdicts.fail.push_back(fail);
  verdicts.pass.push_back(pass);
}

/// What a mean check makes of hits of probability p: nothing is simulated, so it is tested at the
/// levels that it really uses, all looks together.
Verdicts chances(double p, MeanQuestion q, const LookPlan& plan) {
  Verdicts verdicts;
  Hits undecided{0, {1}};
  double drawn = 0;
  for (std::size_t look = 0; look < plan.samples.size(); ++look) {
    const double n = static_cast<double>(plan.samples[look]);
    undecided = undecided.with(Hits::of(n - drawn, p));
    drawn = n;
    set_look(q, plan, look);
    decide(q, n, undecided, verdicts);
  }
  return verdicts;
}

MeanQuestion question(double reference, double tolerance) {
  MeanQuestion q;
  q.reference = reference;
  q.tolerance = tolerance;
  return q;
}

constexpr double kProbabilities[] = {1e-4, 1e-3, 0.01, 0.1, 0.5, 0.9, 0.99, 0.999};

/// So many samples that Bernoulli estimators are normal enough: a spread of 150 hits.
LookPlan plan_up_to_normal(double p, const ErrorBudget& budget = {}) {
  const double cap = 150 * 150 / (p * (1 - p));
  return plan_mean_looks(1250, static_cast<std::uint64_t>(cap), budget);
}

// No tolerance is proven, so that nothing ends before it fails.
constexpr double kNever = 1e-9;

TEST(FalseFailures, OfABernoulliEstimatorStayBelowTheLevelAtAllLooksTogether) {
  for (const double p : kProbabilities) {
    const LookPlan plan = plan_up_to_normal(p);
    const Verdicts verdicts = chances(p, question(p, kNever * p), plan);
    for (std::size_t look = 0; look < plan.samples.size(); ++look) {
      // Outcomes are discrete: the tail in steps can exceed its normal value by a few percent.
      EXPECT_LE(verdicts.fail[look], 1.05 * plan.fail_level[look])
          << "p " << p << ", n " << plan.samples[look];
    }
    EXPECT_LE(Verdicts::sum(verdicts.fail), ErrorBudget{}.fail_level()) << p;
  }
}

TEST(FalseFailures, AreNotFarBelowTheLevelWhereNothingIsSkewed) {
  // Looks a factor of 2^(1/4) apart fail almost independently at seven standard errors: together
  // 0.86 as often as their levels add up to. The rest is that half of a few thousand samples, hit
  // or not, have lighter tails than the normal distribution.
  const Verdicts verdicts = chances(0.5, question(0.5, kNever), plan_up_to_normal(0.5));
  EXPECT_GE(Verdicts::sum(verdicts.fail), 0.2 * ErrorBudget{}.fail_level());
}

TEST(FalseFailures, WouldBeTooManyWithTheWholeLevelAtEachLook) {
  LookPlan plan = plan_up_to_normal(0.5);
  plan.fail_level.assign(plan.samples.size(), ErrorBudget{}.fail_level());
  EXPECT_GE(Verdicts::sum(chances(0.5, question(0.5, kNever), plan).fail), 3e-10);
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

/// Chance that hits of probability p are taken for right, where they are off by the tolerance.
///
/// @param bias  over the tolerance: 1 or −1
double wrong_pass(double p, double bias, const LookPlan& plan) {
  constexpr double kTolerance = 0.05;
  const double reference = p / (1 + bias * kTolerance);
  return Verdicts::sum(chances(p, question(reference, kTolerance * reference), plan).pass);
}

LookPlan plan_up_to_decided(double p, double confidence) {
  ErrorBudget budget;
  budget.pass_confidence = confidence;
  return plan_mean_looks(1250, samples_to_decide(0.05, std::sqrt((1 - p) / p)), budget);
}

TEST(WrongPasses, OfABernoulliEstimatorStayBelowTheLevelAtAllLooksTogether) {
  for (const double p : kProbabilities) {
    for (const double bias : {-1.0, 1.0}) {
      EXPECT_LE(wrong_pass(p, bias, plan_up_to_decided(p, 0.999)), 1e-3) << p << ' ' << bias;
      EXPECT_LE(wrong_pass(p, bias, plan_up_to_decided(p, 0.95)), 0.05) << p << ' ' << bias;
    }
  }
}

TEST(WrongPasses, TakeMostOfWhatTheLineMay) {
  EXPECT_GE(wrong_pass(0.1, 1, plan_up_to_decided(0.1, 0.999)), 0.4e-3);
}

TEST(WrongPasses, WouldBeTooManyWithTheWholeLevelAtEachLook) {
  LookPlan plan = plan_up_to_decided(0.1, 0.999);
  plan.line_level = 0;
  plan.pass_level.assign(plan.samples.size(), 1e-3);
  EXPECT_GE(wrong_pass(0.1, 1, plan), 2e-3);
}

}  // namespace
}  // namespace plumbline::verify
