#include "rounding.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

/// What rounding does to a function, measured: enough for what formulas lose, and no more.
namespace plumbline::verify {
namespace {

constexpr double kEpsilon = 0x1p-53;
using Point = std::array<Vec3, 1>;

template <class F>
double spread_at(const Vec3& x, const F& f, Coordinates coordinates = Coordinates::directions) {
  const auto at_all = [&](const std::vector<Point>& places) {
    std::vector<double> values;
    for (const Point& p : places) values.push_back(f(p[0]));
    return values;
  };
  return spread_by_rounding(Point{x}, kEpsilon, coordinates, at_all);
}

TEST(Rounding, OfASmoothFunctionIsAFewUlps) {
  const double spread = spread_at({0.6, 0, 0.8}, [](const Vec3& x) { return 1 + x[0] * x[2]; });
  EXPECT_GT(spread, kEpsilon);
  EXPECT_LT(spread, 100 * kEpsilon);
}

TEST(Rounding, GrowsWithTheSlope) {
  const double spread =
      spread_at({0.6, 0, 0.8}, [](const Vec3& x) { return 1 + 1e6 * (x[0] - 0.6); });
  EXPECT_GT(spread, 1e6 * kEpsilon);
  EXPECT_LT(spread, 1e8 * kEpsilon);
}

TEST(Rounding, ShowsWhatACosineLosesAtThePeak) {
  // 1 + (α² − 1)·cos² is off by some 2^-52 of α² at most.
  for (const double alpha : {1e-2, 1e-3, 1e-4}) {
    const double a2 = alpha * alpha;
    const auto peak = [a2](const Vec3& x) {
      const double z = x[2] / std::hypot(x[0], x[1], x[2]), q = 1 + (a2 - 1) * z * z;
      return a2 / (q * q) * a2;
    };
    const double spread = spread_at({1e-9, 0, 1}, peak);
    EXPECT_GT(spread, kEpsilon / a2) << alpha;
    EXPECT_LT(spread, 100 * kEpsilon / a2) << alpha;
  }
}

TEST(Rounding, OfASquareRootAtZeroIsThatOfItsArgument) {
  const auto root = [](const Vec3& x) { return std::sqrt(1 - x[2] * x[2]); };
  const double spread = spread_at({1e-9, 0, 1 - 1e-15}, root);
  EXPECT_GT(spread, 1e-8);
  EXPECT_LT(spread, 1e-6);
}

TEST(Rounding, OfIndependentCoordinatesIsThatOfEach) {
  // A density ∝ 1/x is as well known near 0 as anywhere.
  const auto inverse = [](const Vec3& x) { return 1e-12 / x[0]; };
  EXPECT_LT(spread_at({1e-12, 0.5, 0}, inverse, Coordinates::independent), 100 * kEpsilon);
}

TEST(Rounding, IsNoExcuseForADifference) {
  const Vec3 x{0.6, 0, 0.8};
  const auto f = [](const Vec3& w) { return 1 + w[0] * w[2]; };
  const auto spread = [&] { return spread_at(x, f); };
  EXPECT_TRUE(equal_up_to_rounding(f(x), f(x) * (1 + 1e-10), kEpsilon, spread));
  EXPECT_FALSE(equal_up_to_rounding(f(x), f(x) * (1 + 1e-8), kEpsilon, spread));
  EXPECT_FALSE(equal_up_to_rounding(f(x), std::nan(""), kEpsilon, spread));
}

}  // namespace
}  // namespace plumbline::verify
