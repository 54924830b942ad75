#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/estimators/allocation.h>
#include <plumbline/verify/detail/random.h>

#include "integral_problem.h"

/// The allocation policies without noise: on sums over a discrete domain whose samples come in
/// exactly their expected numbers, and on what must never harm them.
namespace plumbline::tests {
namespace {

using renderer::Allocation;
using renderer::AllocationOptions;
using renderer::Allocator;
using renderer::MixtureSample;
using renderer::TechniqueCounts;
using renderer::total_count;

MixtureSample sample_of(double f, double p1, double p2, double alpha) {
  const double p = alpha * p1 + (1 - alpha) * p2;
  return {f / p, {p1 / p, p2 / p}};
}

/// Three points with probabilities in tenths.
constexpr std::array kF{1.0, 2.0, 4.0};
constexpr std::array kP1{0.5, 0.3, 0.2};
constexpr std::array kP2{0.1, 0.4, 0.5};

double variance(double alpha) {
  double sum = -7 * 7;  // μ = 1 + 2 + 4
  for (std::size_t x = 0; x < 3; ++x) {
    sum += kF[x] * kF[x] / (alpha * kP1[x] + (1 - alpha) * kP2[x]);
  }
  return sum;
}

double slope(double alpha) {
  constexpr double kStep = 1e-5;
  return (variance(alpha + kStep) - variance(alpha - kStep)) / (2 * kStep);
}

double curvature(double alpha) {
  constexpr double kStep = 1e-4;
  return (variance(alpha + kStep) - 2 * variance(alpha) + variance(alpha - kStep)) /
         (kStep * kStep);
}

/// Adds every point as often as it is expected among these counts, which are multiples of ten.
template <class Policy>
void add_expected(Policy& policy, const TechniqueCounts& counts) {
  const double alpha = counts[0] / total_count(counts);
  for (std::size_t t = 0; t < 2; ++t) {
    for (std::size_t x = 0; x < 3; ++x) {
      const double times = counts[t] * (t == 0 ? kP1[x] : kP2[x]);
      for (int i = 0; i < std::lround(times); ++i) {
        policy.add(t, sample_of(kF[x], kP1[x], kP2[x], alpha));
      }
    }
  }
}

constexpr std::array<TechniqueCounts, 3> kCounts{{{50, 50}, {20, 30}, {80, 20}}};

TEST(AllocationSlope, BothVersionsAndTheCurvatureAreTheDerivativesOfTheVariance) {
  for (const TechniqueCounts& counts : kCounts) {
    const double alpha = counts[0] / total_count(counts);
    renderer::SlopeSums sums;
    add_expected(sums, counts);
    // Central differences of a convex sum of 1/p: relative error of some 1e-7.
    EXPECT_NEAR(sums.version_1(counts), slope(alpha), 1e-6 * std::abs(slope(alpha)));
    EXPECT_NEAR(sums.version_2(counts), slope(alpha), 1e-6 * std::abs(slope(alpha)));
    EXPECT_NEAR(sums.curvature(counts), curvature(alpha), 1e-5 * curvature(alpha));
  }
}

TEST(AllocationPolicies, LuTakesItsStepFromEqualCountsWhateverWasDrawn) {
  const double expected = 0.5 - slope(0.5) / curvature(0.5);
  renderer::LuAllocation policy;
  for (const TechniqueCounts& counts : kCounts) {
    add_expected(policy, counts);
    EXPECT_NEAR(policy.next(counts).value(), expected, 1e-5);
  }
}

TEST(AllocationPolicies, SbertSharesByInverseMomentsWhateverWasDrawn) {
  std::array<double, 2> moment{};
  for (std::size_t x = 0; x < 3; ++x) {
    moment[0] += kF[x] * kF[x] / kP1[x];
    moment[1] += kF[x] * kF[x] / kP2[x];
  }
  for (const bool of_variance : {false, true}) {
    renderer::SbertAllocation policy(of_variance);
    const double square = of_variance ? 49 : 0;
    const double expected = 1 / (1 + (moment[0] - square) / (moment[1] - square));
    for (const TechniqueCounts& counts : kCounts) {
      add_expected(policy, counts);
      EXPECT_NEAR(policy.next(counts).value(), expected, 1e-12);
    }
  }
}

double best_share(double cost_ratio) {
  double best = 0.1;
  const auto product = [&](double a) { return variance(a) * (a * cost_ratio + 1 - a); };
  for (double a = 0.1; a <= 0.9; a += 1e-4) best = product(a) < product(best) ? a : best;
  return best;
}

TEST(AllocationPolicies, NodesFindTheRootBetweenThemWithAndWithoutCosts) {
  for (const double cost_ratio : {1.0, 2.0, 0.5}) {
    renderer::NodeAllocation policy(0.1, cost_ratio);
    for (const TechniqueCounts& counts : kCounts) {
      add_expected(policy, counts);
      // Nodes 0.1 apart: the interpolation between them is good to 0.01.
      EXPECT_NEAR(policy.next(counts).value(), best_share(cost_ratio), 0.01) << cost_ratio;
    }
  }
}

TEST(AllocationPolicies, RootMovesTheOldSlopeByTheCurvatureAndWeighsTheNewByOneOverRootN) {
  const TechniqueCounts first = kCounts[0], second = kCounts[1];
  for (const bool version_1 : {true, false}) {
    renderer::RootAllocation policy(version_1);
    add_expected(policy, first);
    EXPECT_NEAR(policy.next(first).value(), 0.5 - slope(0.5) / curvature(0.5), 1e-5);
    add_expected(policy, second);
    const double w = 1 / std::sqrt(2.0);
    const double moved = slope(0.5) + curvature(0.5) * (0.4 - 0.5);
    const double new_slope = (1 - w) * moved + w * slope(0.4);
    const double new_curvature = (1 - w) * curvature(0.5) + w * curvature(0.4);
    EXPECT_NEAR(policy.next(second).value(), 0.4 - new_slope / new_curvature, 1e-5);
  }
}

TEST(AllocationPolicies, NamesLeadBackToThem) {
  for (const Allocation policy : renderer::kAllocations) {
    EXPECT_EQ(renderer::from_name(renderer::kAllocations, name(policy)), policy);
  }
  EXPECT_EQ(renderer::from_name(renderer::kAllocations, "root"), std::nullopt);
}

TEST(Allocator, CountsAddUpAndNeitherTechniqueIsLeftOut) {
  for (const double limit : {0.001, 0.1, 0.5}) {
    Allocator allocator({.policy = Allocation::root_nodes, .limit = limit});
    // Technique 2 alone has the integrand: α falls to its limit.
    for (int i = 0; i < 10; ++i) allocator.add(1, {1, {0.1, 1.9}});
    allocator.end_iteration({10, 10});
    EXPECT_EQ(allocator.alpha(), limit);
    for (const std::uint32_t n : {2u, 3u, 50u, 1000u}) {
      const TechniqueCounts counts = allocator.counts(n);
      EXPECT_EQ(counts[0] + counts[1], n);
      EXPECT_GE(counts[0], 1u);
      EXPECT_GE(counts[1], 1u);
    }
  }
}

class EveryPolicy : public testing::TestWithParam<Allocation> {
 protected:
  Allocator allocator{AllocationOptions{.policy = GetParam(), .cost_ratio = 1}};

  void expect_within_limits() const {
    EXPECT_GE(allocator.alpha(), 0.1);
    EXPECT_LE(allocator.alpha(), 0.9);
  }
};

TEST_P(EveryPolicy, KeepsEqualCountsWhereThereIsNoLight) {
  for (int i = 0; i < 20; ++i) {
    allocator.end_iteration(allocator.counts(50));
    EXPECT_EQ(allocator.alpha(), 0.5);
  }
}

TEST_P(EveryPolicy, KeepsEqualCountsWhereTheDensitiesAreEqual) {
  // V″ = 0, while the two sides of V′ in version 1 differ by their noise.
  for (int i = 0; i < 20; ++i) {
    for (const std::size_t t : {0u, 1u}) allocator.add(t, {t == 0 ? 1.0 : 3.0, {1, 1}});
    allocator.end_iteration(allocator.counts(50));
    EXPECT_NEAR(allocator.alpha(), 0.5, 1e-12);
  }
}

TEST_P(EveryPolicy, StaysWithinTheLimitsWhereTheCurvatureVanishes) {
  for (const double difference : {1e-12, 1e-100, 1e-160, 5e-324}) {
    for (const double value : {1e-150, 1.0, 1e150}) {
      allocator.add(0, {value, {1 + difference, 1 - difference}});
      allocator.add(1, {value, {1 - difference, 1 + 3 * difference}});
      allocator.end_iteration(allocator.counts(50));
      expect_within_limits();
    }
  }
}

TEST_P(EveryPolicy, NoSampleDrivesAlphaOutOfItsLimits) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr std::array kExtremes{0.0,
                                 5e-324,
                                 1e-300,
                                 1e-30,
                                 1.0,
                                 1e30,
                                 1e155,
                                 1e300,
                                 kInfinity,
                                 -kInfinity,
                                 std::numeric_limits<double>::quiet_NaN()};
  verify::Random random(1);
  Uniform<double> uniform(random);
  const auto extreme = [&] {
    return kExtremes[static_cast<std::size_t>(uniform() * kExtremes.size())];
  };
  for (int iteration = 0; iteration < 2000; ++iteration) {
    for (int s = 0; s < 3; ++s) {
      allocator.add(uniform() < 0.5 ? 0 : 1, {extreme(), {extreme(), extreme()}});
    }
    allocator.end_iteration(allocator.counts(50));
    expect_within_limits();
    // Sums that overflowed stay so: begin again.
    if (iteration % 10 == 0) allocator = Allocator({.policy = GetParam()});
  }
}

TEST_P(EveryPolicy, WhatIsNotFiniteIsLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Allocator clean({.policy = GetParam()});
  for (const std::size_t t : {0u, 1u}) {
    for (Allocator* a : {&allocator, &clean}) a->add(t, sample_of(1, 0.3, 0.1, 0.5));
    allocator.add(t, {nan, {1, 1}});
    allocator.add(t, {1, {nan, 1}});
    allocator.add(t, {1, {1, std::numeric_limits<double>::infinity()}});
  }
  allocator.end_iteration({25, 25});
  clean.end_iteration({25, 25});
  EXPECT_EQ(allocator.alpha(), clean.alpha());
}

std::string policy_name(const testing::TestParamInfo<Allocation>& info) {
  std::string text(name(info.param));
  for (char& c : text) c = c == '-' ? '_' : c;
  return text;
}

INSTANTIATE_TEST_SUITE_P(Policies, EveryPolicy, testing::ValuesIn(renderer::kAllocations),
                         policy_name);

TEST(AllocationPitfalls, TechniqueWithoutHitsIsNotOneWithoutVariance) {
  // Technique 1 finds light where technique 2 has a hundredth of the density; technique 2 has found
  // none. By its own samples its moment would be 0 and it would get all the samples.
  for (const Allocation policy : {Allocation::sbert_moment, Allocation::sbert_variance}) {
    Allocator allocator({.policy = policy});
    for (int i = 0; i < 25; ++i) allocator.add(0, sample_of(1, 1, 0.01, 0.5));
    allocator.end_iteration({25, 25});
    EXPECT_EQ(allocator.alpha(), 0.9);
  }
}

TEST(AllocationPitfalls, TechniqueThatMissesAPartOfTheIntegrandGetsTheLeast) {
  Allocator allocator({.policy = Allocation::sbert_moment});
  allocator.add(0, sample_of(1, 1, 0, 0.5));
  allocator.add(1, sample_of(1, 1, 1, 0.5));
  allocator.end_iteration({25, 25});
  EXPECT_EQ(allocator.alpha(), 0.9);
}

}  // namespace
}  // namespace plumbline::tests
