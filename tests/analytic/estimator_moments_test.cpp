#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <plumbline/analytic/estimator_moments.h>

namespace plumbline::analytic {
namespace {

using Kind = WeightRule::Kind;

const std::vector<WeightRule> kRules = {{Kind::balance, 0},
                                        {Kind::power, 2},
                                        {Kind::power, 1.5},
                                        {Kind::cutoff, 0.1},
                                        {Kind::maximum, 0}};

std::vector<int> ones(const Integral1d& integral) {
  return std::vector<int>(integral.densities.size(), 1);
}

std::vector<double> equal_shares(const Integral1d& integral) {
  const auto count = integral.densities.size();
  return std::vector<double>(count, 1.0 / static_cast<double>(count));
}

TEST(EstimatorMoments, TwoStepsByHand) {
  const Integral1d integral = two_steps();
  // 8 with probability 0.9, 80 with 0.1.
  EXPECT_NEAR(single_moments(integral, 0).mean, 15.2, 1e-12);
  EXPECT_NEAR(single_moments(integral, 0).variance, 0.09 * 72 * 72, 1e-10);
  EXPECT_NEAR(single_moments(integral, 0).fourth, 0.9 * std::pow(7.2, 4) + 0.1 * std::pow(64.8, 4),
              1e-7);
  // Always 80/10.
  EXPECT_NEAR(single_moments(integral, 1).mean, 8, 1e-13);
  EXPECT_NEAR(single_moments(integral, 1).variance, 0, 1e-25);
  EXPECT_NEAR(naive_average_moments(integral).mean, 11.6, 1e-12);
  EXPECT_NEAR(naive_average_moments(integral).variance, 0.09 * 36 * 36, 1e-10);
  EXPECT_NEAR(plain_sum_moments(integral).mean, 23.2, 1e-12);
  // The first technique adds 8 or 80/11, the second always 80/11.
  const Moments balance = multi_sample_moments(integral, {Kind::balance, 0}, {1, 1});
  EXPECT_NEAR(balance.mean, 15.2, 1e-13);
  EXPECT_NEAR(balance.variance, 0.09 * std::pow(8.0 / 11, 2), 1e-14);
  // Either 16 (with probability 0.45) or 160/11.
  const Moments coin = mixture_moments(integral, {0.5, 0.5});
  EXPECT_NEAR(coin.mean, 15.2, 1e-13);
  EXPECT_NEAR(coin.variance, 0.45 * 0.55 * std::pow(16.0 / 11, 2), 1e-13);
  // Maximum: 8 or 0 from the first, 8 from the second.
  EXPECT_NEAR(multi_sample_moments(integral, {Kind::maximum, 0}, {1, 1}).variance, 0.09 * 64,
              1e-12);
  EXPECT_NEAR(weight({Kind::balance, 0}, {1, 0}, 0), 1, 0);
  EXPECT_NEAR(weight({Kind::balance, 0}, {1, 10}, 0), 1.0 / 11, 1e-16);
  EXPECT_NEAR(weight({Kind::balance, 0}, {1, 10}, 1), 10.0 / 11, 1e-16);
}

TEST(EstimatorMoments, CumulantsAdd) {
  // f/p is 0 or 2, that is 1 ± 1. The sum of two is off by −2, 0, 0 or 2.
  Integral1d integral;
  integral.f = [](double x) { return x < 0.5 ? 0.0 : 2.0; };
  integral.breaks = {0.5};
  integral.value = 1;
  integral.densities = {uniform_density(0, 1), uniform_density(0, 1)};
  integral.infinite_variance = {false, false};
  const Moments sum = plain_sum_moments(integral);
  EXPECT_NEAR(sum.mean, 2, 1e-14);
  EXPECT_NEAR(sum.variance, 2, 1e-14);
  EXPECT_NEAR(sum.third, 0, 1e-7);
  EXPECT_NEAR(sum.fourth, 8, 1e-7);
  EXPECT_NEAR(sum.sixth, 32, 1e-7);
  EXPECT_NEAR(naive_average_moments(integral).sixth, 0.5, 1e-8);
}

TEST(EstimatorMoments, SidewalkByHand) {
  const Integral1d integral = sun_and_sidewalk();
  const double q = cone_fraction(sun_half_angle());
  // ∫ f² = 10¹² ∫₀^q (1 − v)² + ∫_q^1 (1 − v)².
  const double rest = std::pow(1 - q, 3) / 3;
  const double second = 1e12 * (1.0 / 3 - rest) + rest;
  const Moments uniform = single_moments(integral, 0);
  EXPECT_NEAR(uniform.mean, integral.value, 1e-10);
  // 1 − (1 − q)³ cancels to eleven digits here.
  EXPECT_NEAR(uniform.variance, second - integral.value * integral.value, 1e-9 * second);
  // Rays needed for 10 %, with the sky's share: 8.4 million.
  EXPECT_NEAR(uniform.variance / (integral.value * integral.value) / 0.01, 8.45e6, 1e4);
  // Half sun, half sky: fewer than a hundred.
  const Moments coin = mixture_moments(integral, {0.5, 0.5});
  EXPECT_NEAR(coin.variance / (integral.value * integral.value) / 0.01, 83.2, 0.1);
}

TEST(EstimatorMoments, GaussianLineByHand) {
  const Integral1d integral = bad_gaussian_line();
  EXPECT_EQ(single_moments(integral, 0).variance, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(single_moments(integral, 1).variance, gaussian_ratio_second_moment(1, 2) - 1, 1e-12);
  EXPECT_EQ(naive_average_moments(integral).variance, std::numeric_limits<double>::infinity());
  EXPECT_LT(multi_sample_moments(integral, {Kind::balance, 0}, {1, 1}).variance, 0.1);
}

void expect_unbiased_and_precise(const Integral1d& integral, const std::vector<int>& counts) {
  const double scale = integral.value * integral.value;
  for (const WeightRule& rule : kRules) {
    for (const Moments& moments : {multi_sample_moments(integral, rule, counts),
                                   one_sample_moments(integral, rule, equal_shares(integral))}) {
      EXPECT_NEAR(moments.mean, integral.value, 1e-10 * integral.value) << integral.name;
      EXPECT_LE(moments.variance_error, 1e-10 * moments.variance + 1e-15 * scale) << integral.name;
    }
  }
}

TEST(EstimatorMoments, WeightedEstimatorsAreUnbiasedAndPrecise) {
  for (const Integral1d& integral : known_integrals()) {
    expect_unbiased_and_precise(integral, ones(integral));
  }
  for (const Integral1d& integral : combination_integrals()) {
    std::vector<int> uneven = ones(integral);
    for (std::size_t i = 0; i < uneven.size(); ++i) uneven[i] = 1 + static_cast<int>(2 * i);
    expect_unbiased_and_precise(integral, uneven);
  }
}

TEST(EstimatorMoments, FindsTheJumpsOfTheWeights) {
  // Uniform against 2x: equal at ½. Maximum takes f = 1 from the uniform below and from 2x above:
  // E[X²] = ½ + ∫_½ 1/(2x) dx.
  Integral1d integral;
  integral.f = [](double x) { return x >= 0 && x <= 1 ? 1.0 : 0.0; };
  integral.value = 1;
  integral.densities = {uniform_density(0, 1), rising_density(1)};
  integral.infinite_variance = {false, true};
  const Moments moments = multi_sample_moments(integral, {Kind::maximum, 0}, {1, 1});
  EXPECT_NEAR(moments.variance, 0.5 - 0.25 + 0.5 * std::log(2.0) - 0.25, 1e-13);
}

TEST(OptimalSystem, SolutionMakesTheVarianceLeast) {
  // For two densities the condition A α = b, checked at the α that solves it, and by stepping away.
  for (const Integral1d& integral : {two_steps(), broad_times_peaked(), bad_gaussian_interval()}) {
    const OptimalSystem s = optimal_system(integral, {1, 1});
    const double det = s.matrix[0][0] * s.matrix[1][1] - s.matrix[0][1] * s.matrix[1][0];
    const std::vector<double> alpha = {
        (s.vector[0] * s.matrix[1][1] - s.vector[1] * s.matrix[0][1]) / det,
        (s.vector[1] * s.matrix[0][0] - s.vector[0] * s.matrix[1][0]) / det};
    const double least = control_variate_moments(integral, {1, 1}, alpha).variance;
    const double step = 1e-3 * integral.value;
    for (const auto& [a, b] : {std::pair{step, 0.0}, {-step, 0.0}, {0.0, step}, {step, -step}}) {
      EXPECT_GE(control_variate_moments(integral, {1, 1}, {alpha[0] + a, alpha[1] + b}).variance,
                least - 1e-13 * integral.value * integral.value)
          << integral.name;
    }
    EXPECT_LE(least, multi_sample_moments(integral, {Kind::balance, 0}, {1, 1}).variance);
  }
}

TEST(OptimalSystem, TwoStepsIsACombinationOfItsDensities) {
  // f = 8 p₁ + 7.2 p₂ exactly.
  const Moments moments = control_variate_moments(two_steps(), {1, 1}, {8, 7.2});
  EXPECT_NEAR(moments.mean, 15.2, 1e-13);
  EXPECT_NEAR(moments.variance, 0, 1e-25);
}

TEST(BestFractions, AreAMinimum) {
  for (const Integral1d& integral : known_integrals()) {
    if (integral.name == "two_steps") continue;  // the minimum is 0: below
    const std::vector<double> best = best_fractions(integral);
    const double least = mixture_moments(integral, best).variance;
    EXPECT_LE(least, mixture_moments(integral, equal_shares(integral)).variance) << integral.name;
    int steps = 0;
    for (std::size_t i = 0; i < best.size(); ++i) {
      for (const double shift : {-0.01, 0.01}) {
        std::vector<double> moved = best;
        if (moved[i] + shift <= 0 || moved[i] + shift >= 1) continue;
        ++steps;
        const double keep = (1 - moved[i] - shift) / (1 - moved[i]);
        for (double& share : moved) share *= keep;
        moved[i] = best[i] + shift;
        EXPECT_GE(mixture_moments(integral, moved).variance, least * (1 - 1e-6)) << integral.name;
      }
    }
    EXPECT_GE(steps, 2) << integral.name;  // inwards from an end, at least
  }
}

TEST(BestFractions, ReachZeroWhereTheIntegrandIsAMixture) {
  const std::vector<double> best = best_fractions(two_steps());
  EXPECT_NEAR(best[0], 8 / 15.2, 1e-8);
  EXPECT_NEAR(mixture_moments(two_steps(), best).variance, 0, 1e-12);
}

}  // namespace
}  // namespace plumbline::analytic
