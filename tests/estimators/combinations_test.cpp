#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <plumbline/analytic/estimator_moments.h>
#include <plumbline/renderer/estimators/estimators.h>
#include <plumbline/verify/mean.h>
#include <plumbline_tests/support.h>

#include "integral_problem.h"

// Every integrand with every set of techniques, every heuristic and several counts: unbiased.
namespace plumbline::tests {
namespace {

using analytic::Integral1d;
using analytic::WeightRule;
using renderer::Heuristic;
using renderer::Weighting;
using Kind = WeightRule::Kind;

struct Rule {
  std::string name;
  Weighting weighting;
  WeightRule oracle;
};

const std::vector<Rule> kRules = {{"balance", Heuristic::balance, {Kind::balance, 0}},
                                  {"power 2", Heuristic::power, {Kind::power, 2}},
                                  {"power 3.7", {Heuristic::power, 3.7}, {Kind::power, 3.7}},
                                  {"cutoff 0.1", Heuristic::cutoff, {Kind::cutoff, 0.1}},
                                  {"cutoff 0.6", {Heuristic::cutoff, 0.6}, {Kind::cutoff, 0.6}},
                                  {"maximum", Heuristic::maximum, {Kind::maximum, 0}}};

/// Counts of technique i; the table alternates between equal and unequal ones.
std::vector<int> counts_for(std::size_t techniques, std::size_t variant) {
  std::vector<int> counts;
  for (std::size_t i = 0; i < techniques; ++i) {
    counts.push_back(variant % 2 == 0 ? 1 : 1 + static_cast<int>((2 * i + 2) % 5));
  }
  return counts;
}

verify::CheckResult check(const Integral1d& integral, const Rule& rule,
                          const std::vector<int>& counts) {
  const IntegralProblem<double> problem(integral);
  const std::vector<double> n(counts.begin(), counts.end());
  verify::MeanOptions options;
  options.subject = "combinations/" + integral.name + "/" + rule.name;
  for (const int count : counts) options.subject.append(" ").append(std::to_string(count));
  options.reference = integral.value;
  // What a check of a few milliseconds can prove; that the weights are exactly those of the oracle,
  // whose mean is exact to 1e-10, is shown elsewhere, without noise.
  options.tolerance = nightly() ? 0.002 : 0.02;
  options.exact_variance = multi_sample_moments(integral, rule.oracle, counts).variance;
  const double cv = std::sqrt(*options.exact_variance) / integral.value;
  options.max_samples =
      std::max<std::uint64_t>(1 << 15, verify::samples_to_decide(options.tolerance, cv));
  options.seed = check_seed(options.subject);
  verify::Random random(options.seed);
  Uniform<double> uniform(random);
  return verify::check_mean(options, [&](std::uint64_t, std::uint64_t count) {
    verify::Moments moments;
    for (std::uint64_t k = 0; k < count; ++k) {
      moments.add(
          renderer::multi_sample(problem, rule.weighting, std::span<const double>(n), uniform));
    }
    return moments;
  });
}

class Combinations : public testing::TestWithParam<std::size_t> {};

TEST_P(Combinations, AreUnbiased) {
  const auto& integrals = analytic::combination_integrals();
  ASSERT_GE(integrals.size() * kRules.size(), 200U);
  const Rule& rule = kRules[GetParam()];
  for (std::size_t i = 0; i < integrals.size(); ++i) {
    expect_verdict(
        check(integrals[i], rule, counts_for(integrals[i].densities.size(), i + GetParam())));
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, Combinations, testing::Range<std::size_t>(0, 6),
                         [](const auto& param) {
                           std::string name = kRules[param.param].name;
                           for (char& c : name) c = c == ' ' || c == '.' ? '_' : c;
                           return name;
                         });

TEST(Combinations, AHeuristicThatForgetsTheCountsIsCaught) {
  // Weights from the densities alone, but divided by n_i p_i.
  const Integral1d& integral = analytic::combination_integrals().front();
  const IntegralProblem<double> problem(integral);
  const std::vector<double> ones(problem.size(), 1.0);
  verify::MeanOptions options;
  options.subject = "combinations/" + integral.name + "/selection probability forgotten";
  options.reference = integral.value;
  options.tolerance = 0.02;
  options.max_samples = 1 << 20;
  options.expected = verify::Verdict::fail;
  options.seed = check_seed(options.subject);
  verify::Random random(options.seed);
  Uniform<double> uniform(random);
  expect_verdict(verify::check_mean(options, [&](std::uint64_t, std::uint64_t count) {
    verify::Moments moments;
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::size_t i = uniform() < 0.5 ? 0 : 1;
      const double x = *problem.sample(i, uniform);
      moments.add(renderer::mis_contribution(problem, Heuristic::balance,
                                             std::span<const double>(ones), i, x));
    }
    return moments;
  }));
}

}  // namespace
}  // namespace plumbline::tests
