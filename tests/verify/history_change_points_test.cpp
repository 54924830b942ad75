#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include <plumbline/verify/history/change_points.h>

#include "tigerbeetle.h"

namespace plumbline::verify::history {
namespace {

std::vector<std::size_t> indices(std::span<const double> series,
                                 const ChangePointOptions& options) {
  std::vector<std::size_t> result;
  for (const ChangePoint& point : find_change_points(series, options)) {
    result.push_back(point.index);
  }
  return result;
}

ChangePointOptions as_otava(double max_p_value, double min_magnitude) {
  ChangePointOptions options;
  options.window = 30;
  options.max_p_value = max_p_value;
  options.min_magnitude = min_magnitude;
  options.as_otava = true;
  return options;
}

// The expected points are those of Apache Otava's tests/tigerbeetle_test.py.
TEST(ChangePoints, AreThoseOfOtavaOnTigerbeetle) {
  using Points = std::vector<std::size_t>;
  EXPECT_EQ(indices(kTigerbeetle, as_otava(0.01, 0.05)), (Points{15, 71}));
  EXPECT_EQ(indices(kTigerbeetle, as_otava(0.05, 0.05)), (Points{15, 71}));
  EXPECT_EQ(indices(kTigerbeetle, as_otava(0.1, 0.05)), (Points{10, 11, 15, 71, 363}));
  EXPECT_EQ(indices(kTigerbeetle, as_otava(0.2, 0.05)), (Points{10, 11, 15, 71}));
  EXPECT_EQ(indices(kTigerbeetle, as_otava(0.01, 0)),
            (Points{15, 26, 61, 71, 95, 117, 131, 142, 148, 165, 169, 192, 212, 260}));
  EXPECT_EQ(indices(kTigerbeetle, as_otava(1e-3, 0)),
            (Points{15, 61, 71, 95, 117, 131, 142, 148, 192, 212, 260}));
  EXPECT_EQ(indices(kTigerbeetle, as_otava(1e-4, 0)),
            (Points{71, 95, 117, 131, 142, 148, 192, 212}));
  EXPECT_EQ(indices(kTigerbeetle, as_otava(1e-5, 0)), (Points{71, 95, 131, 192, 212}));
}

TEST(ChangePoints, AreThoseOfOtavaWhereMostOfThemAreNoise) {
  using Points = std::vector<std::size_t>;
  EXPECT_EQ(indices(kTigerbeetle, as_otava(0.1, 0.01)),
            (Points{10,  11,  15,  28,  29,  35,  37,  48,  49,  61,  71,  95,  117, 131,
                    142, 148, 165, 169, 192, 206, 212, 260, 265, 268, 278, 282, 363}));
  EXPECT_EQ(indices(kTigerbeetle, as_otava(0.1, 0)),
            (Points{3,   6,   10,  11,  15,  16,  28,  29,  35,  37,  39,  41,
                    44,  48,  49,  61,  71,  95,  117, 131, 142, 148, 165, 169,
                    192, 206, 212, 260, 265, 268, 278, 282, 288, 305, 363}));
  EXPECT_EQ(indices(kTigerbeetle, as_otava(0.2, 0)).size(), 70u);
}

TEST(ChangePoints, WithoutOtavasRulesAreTestedAgainstBothNeighbours) {
  // 26 stays in Otava's list only because its right segment has not been looked at again.
  ChangePointOptions options = as_otava(0.01, 0);
  options.as_otava = false;
  const std::vector<std::size_t> found = indices(kTigerbeetle, options);
  EXPECT_EQ(std::count(found.begin(), found.end(), 26u), 0);
  for (const std::size_t sure : {15u, 71u, 95u, 131u, 192u, 212u}) {
    EXPECT_EQ(std::count(found.begin(), found.end(), sure), 1) << sure;
  }
}

TEST(ChangePoints, AThirdLevelHidesNone) {
  // From 0 to 1 and back: against all that comes after it the step up is no difference, which
  // Otava's rules look at.
  std::vector<double> series;
  for (int i = 0; i < 60; ++i) series.push_back(0.1 * (i % 3) + (i >= 20 && i < 40 ? 1 : 0));
  ChangePointOptions options;
  options.window = 120;
  options.max_p_value = 1e-6;
  EXPECT_EQ(indices(series, options), (std::vector<std::size_t>{20, 40}));
  options.as_otava = true;
  EXPECT_TRUE(indices(series, options).empty());
}

TEST(ChangePoints, SayWhatStudentsTestSays) {
  // Means 2 and 12, each side with squared deviations of 2: t = 10/√((4/4)·(2/3)) = 12.2474 with
  // four degrees of freedom; twice the tail is 2.552e-4 (R's pt).
  const std::vector<double> series = {1, 2, 3, 11, 12, 13};
  ChangePointOptions options;
  options.max_p_value = 0.01;
  const std::vector<ChangePoint> points = find_change_points(series, options);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].index, 3u);
  EXPECT_EQ(points[0].segment_begin, 0u);
  EXPECT_EQ(points[0].segment_end, 6u);
  EXPECT_DOUBLE_EQ(points[0].mean_before, 2);
  EXPECT_DOUBLE_EQ(points[0].mean_after, 12);
  EXPECT_NEAR(points[0].error, std::sqrt(2.0 / 3), 1e-14);
  EXPECT_NEAR(points[0].p_value, 2.552e-4, 1e-7);
  EXPECT_NEAR(points[0].magnitude(), 5, 1e-14);
  // Twice the variance of a mean: t = 8.6603 with two degrees of freedom, p = 0.013072.
  options.variance_inflation = 2;
  EXPECT_TRUE(find_change_points(series, options).empty());
  options.max_p_value = 0.02;
  ASSERT_EQ(find_change_points(series, options).size(), 1u);
  EXPECT_NEAR(find_change_points(series, options)[0].p_value, 0.013072, 1e-6);
}

TEST(ChangePoints, KeepToTheShortestSegment) {
  std::vector<double> series;
  for (int i = 0; i < 30; ++i) series.push_back(i % 3 + (i < 28 ? 0 : 50));
  ChangePointOptions options;
  EXPECT_EQ(indices(series, options), std::vector<std::size_t>{28});
  options.min_segment = 3;
  for (const std::size_t index : indices(series, options)) EXPECT_LE(index, 27u);
}

TEST(ChangePoints, NoneInAConstantSeriesOrInNothing) {
  EXPECT_TRUE(find_change_points(std::vector<double>(100, 3.0), {}).empty());
  EXPECT_TRUE(find_change_points({}, {}).empty());
  EXPECT_TRUE(find_change_points(std::vector<double>{1}, {}).empty());
}

TEST(ChangePoints, FindAStepFromZero) {
  std::vector<double> series(20, 0.0);
  series.resize(40, 1.0);
  EXPECT_EQ(indices(series, {}), std::vector<std::size_t>{20});
}

TEST(ChangePoints, RefuseWhatMakesNoSense) {
  const std::vector<double> series = {1, 2, 3};
  const auto refused = [&](auto change) {
    ChangePointOptions options;
    change(options);
    EXPECT_THROW(find_change_points(series, options), std::invalid_argument);
  };
  refused([](auto& o) { o.window = 1; });
  refused([](auto& o) { o.min_segment = 0; });
  refused([](auto& o) { o.max_p_value = 0; });
  refused([](auto& o) { o.max_p_value = 1; });
  refused([](auto& o) { o.variance_inflation = 0.5; });
  refused([](auto& o) { o.min_magnitude = -1; });
  const std::vector<double> bad = {1, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW(find_change_points(bad, {}), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::verify::history
