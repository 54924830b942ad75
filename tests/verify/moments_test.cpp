#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <plumbline/verify/detail/moments.h>

#include "samplers.h"

namespace plumbline::verify {
namespace {

using tests::Exponential;
using tests::Pareto;

Moments draw(std::uint64_t seed, std::uint64_t count, auto distribution) {
  return tests::sampler(seed, distribution)(0, count);
}

TEST(Moments, OfFourNumbersAreTheTextbookOnes) {
  Moments m;
  for (const double x : {1.0, 2.0, 4.0, 9.0}) m.add(x);
  // Mean 4; deviations −3, −2, 0, 5: squares sum to 38, cubes to −27 − 8 + 125 = 90.
  EXPECT_DOUBLE_EQ(m.mean(), 4);
  EXPECT_DOUBLE_EQ(m.m2(), 38);
  EXPECT_NEAR(m.m3(), 90, 1e-12);
  EXPECT_DOUBLE_EQ(m.variance(), 38.0 / 3);
  EXPECT_DOUBLE_EQ(m.largest_share(), 25.0 / 38);
  EXPECT_EQ(m.smallest(), 1);
  EXPECT_EQ(m.largest(), 9);
}

TEST(Moments, MergedPartsEqualTheWhole) {
  Moments whole, parts;
  Random random(7);
  for (int part = 0; part < 10; ++part) {
    Moments m;
    for (int i = 0; i <= 100 * part; ++i) {
      const double x = Exponential{}(random);
      whole.add(x);
      m.add(x);
    }
    parts.merge(m);
  }
  EXPECT_EQ(parts.count(), whole.count());
  EXPECT_NEAR(parts.mean(), whole.mean(), 1e-14);
  EXPECT_NEAR(parts.m2(), whole.m2(), 1e-10 * whole.m2());
  EXPECT_NEAR(parts.m3(), whole.m3(), 1e-9 * whole.m3());
  EXPECT_EQ(parts.tail_index(), whole.tail_index());
}

TEST(Moments, KeepSmallVarianceBesideLargeMean) {
  // The sum of squares would lose 1e-8² beside 1e8² altogether.
  Moments m;
  for (int i = 0; i < 1000; ++i) m.add(1e8 + (i % 2 == 0 ? 1e-4 : -1e-4));
  EXPECT_NEAR(m.variance(), 1e-8 * 1000 / 999, 1e-10);
}

TEST(Moments, CountNonFiniteSamplesAndLeaveThemOut) {
  Moments m;
  m.add(1);
  m.add(std::numeric_limits<double>::quiet_NaN());
  m.add(std::numeric_limits<double>::infinity());
  m.add_rejected();
  EXPECT_EQ(m.count(), 2u);
  EXPECT_EQ(m.non_finite(), 2u);
  EXPECT_EQ(m.rejected(), 1u);
  EXPECT_DOUBLE_EQ(m.mean(), 0.5);
}

TEST(Moments, TailIndexTellsFiniteFromInfiniteVariance) {
  EXPECT_LT(draw(1, 1'000'000, Pareto{1.5}).tail_index(), 2);
  EXPECT_LT(draw(2, 1'000'000, Pareto{2.0}).tail_index(), 2);
  EXPECT_GT(draw(3, 1'000'000, Pareto{3.0}).tail_index(), 2);
  EXPECT_GT(draw(4, 1'000'000, Exponential{}).tail_index(), 3);
  EXPECT_GT(draw(5, 1'000'000, tests::Bernoulli{1e-4}).tail_index(), 3);
}

TEST(Moments, InfiniteVarianceSeldomLooksFinite) {
  // Two standard errors once and three a few times: about one in forty at the limit itself.
  int finite = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    finite += draw(seed, 200'000, Pareto{2.0}).tail_index() > 2 ? 1 : 0;
  EXPECT_LE(finite, 20);
}

/// Falls off with index 0.7 up to where it ends, as the values of a narrow lobe do.
struct SlowUpToAnEnd {
  double end;
  double operator()(Random& random) const {
    return std::min(end, std::pow(1 - random.uniform(), -1 / 0.7));
  }
};

TEST(Moments, ATailThatFallsOffSlowlyAndEndsIsBounded) {
  // A thousandth of the samples lies beyond 2e4, 90 of a million beyond 6e5.
  EXPECT_GT(draw(1, 1'000'000, SlowUpToAnEnd{6e5}).tail_index(), 2);
  EXPECT_LT(draw(2, 1'000'000, SlowUpToAnEnd{6e8}).tail_index(), 2);  // too few there to see it
}

}  // namespace
}  // namespace plumbline::verify
