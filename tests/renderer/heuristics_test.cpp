#include <plumbline/renderer/core/mis/heuristics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace plumbline::renderer {
namespace {

std::vector<float> densities_over_the_whole_range_of_float() {
  std::vector<float> densities{0};
  for (int exponent = -38; exponent <= 38; ++exponent) {
    densities.push_back(std::pow(10.0f, static_cast<float>(exponent)));
  }
  return densities;
}

TEST(MisWeight, PairsAreFiniteAndSumToOneOverTheWholeRangeOfFloat) {
  for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
    for (const float a : densities_over_the_whole_range_of_float()) {
      for (const float b : densities_over_the_whole_range_of_float()) {
        const float w_a = mis_weight(heuristic, a, b), w_b = mis_weight(heuristic, b, a);
        ASSERT_TRUE(w_a >= 0 && w_a <= 1) << a << ' ' << b;
        if (a > 0 || b > 0) {
          ASSERT_NEAR(w_a + w_b, 1.0f, 2 * std::numeric_limits<float>::epsilon()) << a << ' ' << b;
        }
      }
    }
  }
}

TEST(MisWeight, ZeroDensityGivesZeroWeightAndAllToTheOther) {
  for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
    EXPECT_EQ(mis_weight(heuristic, 0.0f, 3.0f), 0.0f);
    EXPECT_EQ(mis_weight(heuristic, 3.0f, 0.0f), 1.0f);
    EXPECT_EQ(mis_weight(heuristic, 0.0f, 0.0f), 0.0f);
  }
}

TEST(MisWeight, ValuesAreThoseOfTheDefinitions) {
  EXPECT_DOUBLE_EQ(mis_weight(Heuristic::balance, 1.0, 10.0), 1.0 / 11);
  EXPECT_DOUBLE_EQ(mis_weight(Heuristic::balance, 10.0, 1.0), 10.0 / 11);
  EXPECT_DOUBLE_EQ(mis_weight(Heuristic::power, 1.0, 3.0), 1.0 / 10);
  EXPECT_DOUBLE_EQ(mis_weight(Heuristic::power, 3.0, 1.0), 9.0 / 10);
}

TEST(MisWeight, SquaringTheDensitiesWouldFail) {
  // The form that real renderers had: the test above has to tell it from ours.
  const auto naive = [](float a, float b) { return a * a / (a * a + b * b); };
  EXPECT_TRUE(std::isnan(naive(1e20f, 1e20f)));
  EXPECT_TRUE(std::isnan(naive(1e-30f, 1e-30f)));
}

}  // namespace
}  // namespace plumbline::renderer
