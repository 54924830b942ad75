#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <plumbline/reports/power_fit.h>

namespace plumbline::tests {
namespace {

using reports::fit_power;
using reports::PowerFit;
using reports::PowerFitPoint;

TEST(PowerFit, ExactPowerLawIsFoundExactly) {
  std::vector<PowerFitPoint> points;
  for (double x = 0.01; x < 20; x *= 4) points.push_back({x, 0.3 * std::pow(x, -0.5), 0.1});
  const PowerFit fit = fit_power(points);
  EXPECT_NEAR(fit.exponent, -0.5, 1e-14);
  EXPECT_NEAR(fit.factor, 0.3, 1e-14);
  EXPECT_EQ(fit.points, static_cast<int>(points.size()));
}

/// Two points at log x = 0 and 1 with errors s1 and s2: the slope is their difference, and its
/// variance s1² + s2².
TEST(PowerFit, StandardErrorOfTwoPointsIsThatOfTheirDifference) {
  const std::vector<PowerFitPoint> points{{1, 2, 0.3}, {std::exp(1.0), 5, 0.4}};
  const PowerFit fit = fit_power(points);
  EXPECT_NEAR(fit.exponent, std::log(2.5), 1e-14);
  EXPECT_NEAR(fit.exponent_error, 0.5, 1e-14);
}

/// Of 2000 fits with normal errors, the share whose interval of ±1.96 standard errors holds the
/// true slope is binomial with p = 0.95: outside ±7.5 standard deviations (0.037) less than
/// once in 1e11 seeds. With unknown errors and 6 points it is Student's t with 4 degrees of
/// freedom: p = P(|t| < 1.96) = 0.8785.
TEST(PowerFit, StandardErrorCoversTheTruthAsOftenAsItShould) {
  std::mt19937_64 random(check_seed("power_fit/coverage"));
  std::normal_distribution<double> normal;
  constexpr int kFits = 2000;
  int covered_known = 0, covered_unknown = 0;
  for (int i = 0; i < kFits; ++i) {
    std::vector<PowerFitPoint> known, unknown;
    for (int k = 0; k < 6; ++k) {
      const double x = std::pow(4.0, k), error = 0.05 * (1 + k % 3);
      known.push_back({x, std::pow(x, -0.5) * std::exp(error * normal(random)), error});
      unknown.push_back({x, std::pow(x, -0.5) * std::exp(0.1 * normal(random)), 0});
    }
    const PowerFit a = fit_power(known), b = fit_power(unknown);
    covered_known += std::abs(a.exponent + 0.5) < 1.96 * a.exponent_error;
    covered_unknown += std::abs(b.exponent + 0.5) < 1.96 * b.exponent_error;
  }
  EXPECT_NEAR(covered_known / double{kFits}, 0.95, 7.5 * std::sqrt(0.95 * 0.05 / kFits));
  EXPECT_NEAR(covered_unknown / double{kFits}, 0.8785, 7.5 * std::sqrt(0.8785 * 0.1215 / kFits));
}

TEST(PowerFit, PointsWithoutALogarithmAreLeftOut) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::vector<PowerFitPoint> points{{1, 1, 0},  {2, 2, 0},    {4, 4, 0},  {0, 3, 0},
                                          {3, -1, 0}, {5, kNaN, 0}, {-1, 1, 0}, {HUGE_VAL, 1, 0}};
  const PowerFit fit = fit_power(points);
  EXPECT_EQ(fit.points, 3);
  EXPECT_NEAR(fit.exponent, 1, 1e-14);
}

TEST(PowerFit, WithoutTwoDifferentAbscissasThereIsNoSlope) {
  EXPECT_TRUE(std::isnan(fit_power({}).exponent));
  const std::vector<PowerFitPoint> one{{2, 3, 0.1}};
  EXPECT_TRUE(std::isnan(fit_power(one).exponent));
  // Rounding must not make an abscissa of its own out of the mean of equal ones.
  for (double x = 0.001; x < 10; x *= 1.1) {
    const std::vector<PowerFitPoint> alone{{x, 3, 0.1 * x}};
    EXPECT_TRUE(std::isnan(fit_power(alone).exponent)) << x;
  }
  const std::vector<PowerFitPoint> same{{2, 3, 0.1}, {2, 4, 0.1}};
  EXPECT_TRUE(std::isnan(fit_power(same).exponent));
}

TEST(PowerFit, TwoPointsOfUnknownErrorHaveASlopeButNoErrorOfIt) {
  const std::vector<PowerFitPoint> points{{1, 1, 0}, {4, 2, 0}};
  const PowerFit fit = fit_power(points);
  EXPECT_NEAR(fit.exponent, 0.5, 1e-14);
  EXPECT_TRUE(std::isnan(fit.exponent_error));
}

}  // namespace
}  // namespace plumbline::tests
