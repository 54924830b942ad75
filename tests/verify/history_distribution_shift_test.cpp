#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include <plumbline/verify/history/distribution_shift.h>
#include <plumbline/verify/ratio.h>

#include "history_noise.h"

namespace plumbline::verify::history {
namespace {

using Nights = std::vector<std::vector<double>>;

TEST(DistributionShift, IsTheEnergyDistanceAndItsPermutations) {
  // Distances between the groups: 10, 12, 8, 10, mean 10; within: 2 and 2. 2·10 − 2 − 2 = 16. Of
  // the six ways to take two of four nights two are as far apart.
  const Nights before = {{0}, {2}}, after = {{10}, {12}};
  const DistributionShift shift = distribution_shift(before, after);
  EXPECT_DOUBLE_EQ(shift.energy_distance, 16);
  EXPECT_DOUBLE_EQ(shift.p_value, 2.0 / 6);
  EXPECT_EQ(shift.larger, 1);
  EXPECT_EQ(distribution_shift(after, before).larger, 0);
  EXPECT_DOUBLE_EQ(distribution_shift(after, before).energy_distance, 16);
}

TEST(DistributionShift, NightsCountAlikeHoweverManyValuesTheyHave) {
  const Nights before = {{0, 0, 0, 0}, {2}}, after = {{10, 10}, {12, 12, 12}, {11}};
  const Nights short_before = {{0}, {2}}, short_after = {{10}, {12}, {11}};
  EXPECT_DOUBLE_EQ(distribution_shift(before, after).energy_distance,
                   distribution_shift(short_before, short_after).energy_distance);
  // The smaller group is one of C(5, 2) = 10.
  EXPECT_DOUBLE_EQ(distribution_shift(before, after).p_value, 0.1);
  EXPECT_DOUBLE_EQ(distribution_shift(after, before).p_value, 0.1);
}

TEST(DistributionShift, SeesAWidthThatTheMeanDoesNotShow) {
  Nights before, after;
  for (int i = 0; i < 10; ++i) {
    before.push_back({9, 10, 11});
    after.push_back({5, 10, 15});
  }
  const DistributionShift shift = distribution_shift(before, after);
  EXPECT_EQ(shift.larger, 0.5);
  EXPECT_LE(shift.p_value, 0.01);
}

TEST(DistributionShift, TiesAndEqualNightsShowNothing) {
  const Nights same(5, {1, 1});
  const DistributionShift shift = distribution_shift(same, same);
  EXPECT_EQ(shift.energy_distance, 0);
  EXPECT_EQ(shift.p_value, 1);
  EXPECT_EQ(shift.larger, 0.5);
}

/// Ten nights on each side without a shift, whose values share what the night adds.
Nights dependent_nights(Random& random) {
  Nights nights;
  for (int i = 0; i < 10; ++i) {
    const double shared = normal(random);
    std::vector<double>& night = nights.emplace_back();
    for (int k = 0; k < 8; ++k) night.push_back(shared + 0.3 * normal(random));
  }
  return nights;
}

/// Each value as a night of its own: what a test of independent values does.
Nights taken_apart(const Nights& nights) {
  Nights result;
  for (const auto& night : nights) {
    for (const double x : night) result.push_back({x});
  }
  return result;
}

/// Share of p-values up to 5 % where there is no shift, against that level.
template <class Prepare>
CheckResult small_p_values(const char* subject, std::uint64_t runs, Prepare prepare) {
  ProportionOptions claim;
  claim.subject = subject;
  claim.seed = tests::check_seed(subject);
  claim.at_most = 0.1;  // 8.6 standard errors above 5 %, of 1,500 runs
  Random random(claim.seed);
  std::uint64_t hits = 0;
  for (std::uint64_t i = 0; i < runs; ++i) {
    const Nights before = prepare(dependent_nights(random)),
                 after = prepare(dependent_nights(random));
    hits += distribution_shift(before, after, 99, random.bits()).p_value <= 0.05 ? 1u : 0u;
  }
  return check_proportion(claim, hits, runs);
}

TEST(DistributionShift, KeepsItsLevelWhereTheValuesOfANightDepend) {
  tests::expect_verdict(
      small_p_values("history/shift/nights", 1500, [](const Nights& nights) { return nights; }));
}

TEST(DistributionShift, ValuesTakenAsIndependentDoNot) {
  CheckResult r = small_p_values("history/shift/values", 150, taken_apart);
  r.expected = Verdict::fail;
  tests::expect_verdict(r);
}

TEST(DistributionShift, RefusesWhatCannotBeCompared) {
  const Nights one = {{1}}, two = {{1}, {2}}, empty = {{1}, {}};
  const Nights bad = {{1}, {std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_THROW(distribution_shift(one, two), std::invalid_argument);
  EXPECT_THROW(distribution_shift(two, one), std::invalid_argument);
  EXPECT_THROW(distribution_shift(two, empty), std::invalid_argument);
  EXPECT_THROW(distribution_shift(bad, two), std::invalid_argument);
  EXPECT_THROW(distribution_shift(two, two, 0), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::verify::history
