#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <plumbline/analytic/estimator_moments.h>
#include <plumbline/analytic/integral1d.h>
#include <plumbline_tests/support.h>

#include "allocation_run.h"

/// Adapting the allocation leaves the mean alone, and the two ways in which it would not.
namespace plumbline::tests {
namespace {

using analytic::Integral1d;
using renderer::Allocation;

struct Setting {
  std::uint32_t iterations, iteration_samples;

  std::uint32_t samples() const { return iterations * iteration_samples; }
  renderer::AllocationOptions options(Allocation policy) const {
    return {.policy = policy, .iterations = iterations, .cost_ratio = 1.2};
  }
};

/// A short run shows a bias sooner than a long one: the later iterations adapt least, and the
/// counts of short iterations are the coarsest.
Setting setting() { return nightly() ? Setting{20, 50} : Setting{4, 20}; }

/// Standard deviation of the same number of samples with equal counts.
double equal_deviation(const Integral1d& integral) {
  const int half = static_cast<int>(setting().samples() / 2);
  return std::sqrt(multi_sample_moments(integral, analytic::WeightRule{}, {half, half}).variance);
}

verify::MeanOptions mean_options(const Integral1d& integral, std::string_view what) {
  verify::MeanOptions options;
  options.subject = integral.name + "/";
  options.subject.append(what);
  options.reference = integral.value;
  options.relative = false;
  options.tolerance = 0.01 * equal_deviation(integral);
  options.rounding_allowance = 1e-9 * integral.value;
  options.max_samples = 1 << 22;
  options.seed = check_seed(options.subject);
  return options;
}

using Case = std::tuple<int, Allocation>;

Integral1d integral_of(int i) {
  return i == 0 ? analytic::bad_gaussian_interval() : analytic::peaked_times_peaked();
}

class AdaptiveMean : public testing::TestWithParam<Case> {};

TEST_P(AdaptiveMean, IsUnbiasedToAHundredthOfAnEqualMisStandardDeviation) {
  const Integral1d integral = integral_of(std::get<0>(GetParam()));
  const Allocation policy = std::get<1>(GetParam());
  auto options = mean_options(integral, "mean of " + std::string(name(policy)));
  expect_verdict(check_mean(options, runs(options.seed, [&](verify::Random& random) {
                              double sum = 0;
                              renderer::allocate_samples(
                                  setting().options(policy), setting().samples(),
                                  IntegralDraw(integral, random),
                                  [&](std::uint32_t, std::size_t, double f) { sum += f; });
                              return sum / setting().samples();
                            })));
}

// All policies on one integral in the gate, on both at night.
INSTANTIATE_TEST_SUITE_P(Integrals, AdaptiveMean,
                         testing::Combine(testing::Range(0, nightly() ? 2 : 1),
                                          testing::ValuesIn(renderer::kAllocations)),
                         [](const testing::TestParamInfo<Case>& param) {
                           std::string text = integral_of(std::get<0>(param.param)).name;
                           text.append("_").append(name(std::get<1>(param.param)));
                           std::replace(text.begin(), text.end(), '-', '_');
                           return text;
                         });

/// One iteration with α = 0.13: of 50 samples 7 are of technique 1. The weights as if it were 6.5.
TEST(AdaptiveMeanControl, WeightsByTheWantedShareInsteadOfTheCountsDrawnFail) {
  constexpr double kWanted = 0.13;
  constexpr int kDrawn = 7;
  const Integral1d integral = analytic::bad_gaussian_interval();
  auto options = mean_options(integral, "weights by the wanted share");
  options.subject.insert(0, "control/");
  options.expected = verify::Verdict::fail;
  expect_verdict(check_mean(options, runs(options.seed, [&](verify::Random& random) {
                              const IntegralDraw draw(integral, random);
                              double sum = 0;
                              for (int s = 0; s < 50; ++s) {
                                const auto x = draw(s < kDrawn ? 0 : 1);
                                const double p1 = s < kDrawn ? x.pdf : x.other_pdf;
                                const double p2 = s < kDrawn ? x.other_pdf : x.pdf;
                                sum += x.value * x.pdf / (kWanted * p1 + (1 - kWanted) * p2);
                              }
                              return sum / 50;
                            })));
}

/// The iterations of one run, weighted by their inverse estimated variances.
double by_inverse_variance(const Integral1d& integral, verify::Random& random) {
  std::vector<verify::Moments> iterations(setting().iterations);
  renderer::allocate_samples(setting().options(Allocation::root_v2), setting().samples(),
                             IntegralDraw(integral, random),
                             [&](std::uint32_t i, std::size_t, double f) { iterations[i].add(f); });
  double sum = 0, weights = 0;
  for (const verify::Moments& moments : iterations) {
    sum += moments.mean() / moments.variance();
    weights += 1 / moments.variance();
  }
  return sum / weights;
}

TEST(AdaptiveMeanControl, IterationsWeightedByInverseVariancesFail) {
  const Integral1d integral = analytic::peaked_times_peaked();
  auto options = mean_options(integral, "inverse-variance weights");
  options.subject.insert(0, "control/");
  options.expected = verify::Verdict::fail;
  expect_verdict(check_mean(options, runs(options.seed, [&](verify::Random& random) {
                              return by_inverse_variance(integral, random);
                            })));
}

}  // namespace
}  // namespace plumbline::tests
