#include <plumbline/renderer/core/render/film.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace plumbline::renderer {
namespace {

Rgbf sample_at(int i) {
  const auto x = static_cast<float>(i);
  return {1 + 0.1f * std::sin(x), 2 + 0.2f * std::cos(3 * x), x};
}

TEST(Film, SamplesTogetherGiveTheBitsOfOneByOne) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::vector<Rgbf> samples;
  for (int i = 0; i < 100; ++i) samples.push_back(sample_at(i));
  samples[7].g = kInfinity;
  samples[8] = {0, 0, std::nanf("")};
  PixelMoments one_by_one, together;
  for (const Rgbf& sample : samples) one_by_one.add(sample);
  together.add(std::span(samples).first(0));
  together.add(std::span(samples).first(9));
  together.add(std::span(samples).subspan(9));
  EXPECT_EQ(together.count, 98u);
  EXPECT_EQ(together.non_finite, 2u);
  EXPECT_EQ(together.count, one_by_one.count);
  EXPECT_EQ(together.non_finite, one_by_one.non_finite);
  EXPECT_EQ(together.mean, one_by_one.mean);
  EXPECT_EQ(together.sum_squares, one_by_one.sum_squares);
}

TEST(Film, MergedMomentsEqualThoseOfOneStream) {
  PixelMoments whole, first, second;
  for (int i = 0; i < 1000; ++i) {
    whole.add(sample_at(i));
    (i < 300 ? first : second).add(sample_at(i));
  }
  first.merge(second);
  EXPECT_EQ(first.count, whole.count);
  EXPECT_NEAR(first.mean.r, whole.mean.r, 1e-14);
  EXPECT_NEAR(first.variance().g, whole.variance().g, 1e-14);
  EXPECT_NEAR(first.variance().b, whole.variance().b, 1e-9 * whole.variance().b);
}

TEST(Film, MergingOneSampleOrNoneIsAddingThem) {
  PixelMoments moments, one, none;
  moments.merge(none);
  EXPECT_EQ(moments.count, 0u);
  EXPECT_EQ(moments.mean.r, 0.0);
  moments.add({1, 1, 1});
  one.add({3, 3, 3});
  moments.merge(one);
  moments.merge(none);
  EXPECT_EQ(moments.count, 2u);
  EXPECT_EQ(moments.mean.r, 2.0);
  EXPECT_EQ(moments.variance().r, 2.0);
}

TEST(Film, VarianceOfAnArithmeticProgressionIsExact) {
  PixelMoments moments;
  for (int i = 0; i < 10; ++i) moments.add(sample_at(i));
  EXPECT_NEAR(moments.variance().b, 55.0 / 6.0, 1e-13);  // n (n + 1)/12 for 0 … n − 1
}

TEST(Film, MeanDoesNotStallWhereAFloatSumWould) {
  // 2^24 + 1 is not a float: a float sum of ones stops there, and the mean of twice as many is 0.5.
  PixelMoments moments;
  constexpr int kCount = 1 << 25;
  for (int i = 0; i < kCount; ++i) moments.add({1, 1, 1});
  EXPECT_EQ(moments.mean.r, 1.0);
  EXPECT_EQ(moments.variance().r, 0.0);

  float naive_sum = 0;
  for (int i = 0; i < kCount; ++i) naive_sum += 1.0f;
  EXPECT_EQ(naive_sum / static_cast<float>(kCount), 0.5f);
}

TEST(Film, MeanStillMovesAfterABillionSamples) {
  // Half zeros, half ones, 2^30 in all. A running mean in float cannot go on from 0.5: one more
  // sample moves it by 2^-31, and the next float is 2^-24 away.
  PixelMoments moments;
  moments.add({0, 0, 0});
  moments.add({1, 1, 1});
  for (int i = 1; i < 30; ++i) moments.merge(PixelMoments(moments));
  EXPECT_EQ(moments.count, 1u << 30);
  EXPECT_NEAR(moments.variance().g, 0.25, 1e-9);
  constexpr int kMore = 1 << 20;
  for (int i = 0; i < kMore; ++i) moments.add({1, 1, 1});
  EXPECT_NEAR(moments.mean.g, (0x1p29 + kMore) / (0x1p30 + kMore), 1e-12);
}

TEST(Film, NonFiniteSamplesAreCountedAndLeftOut) {
  PixelMoments moments;
  moments.add({1, 1, 1});
  moments.add({1, std::numeric_limits<float>::quiet_NaN(), 1});
  moments.add({std::numeric_limits<float>::infinity(), 1, 1});
  EXPECT_EQ(moments.count, 1u);
  EXPECT_EQ(moments.non_finite, 2u);
  EXPECT_EQ(moments.mean.g, 1.0);
}

TEST(Film, PixelsStandRowByRowFromTheTop) {
  Film film(3, 2);
  film.at(2, 1).add({1, 1, 1});
  const Film& same = film;
  EXPECT_EQ(film.pixels()[5].count, 1u);
  EXPECT_EQ(&same.at(2, 1), &film.pixels()[5]);
  EXPECT_EQ(&same.at(1, 0), &film.pixels()[1]);
}

TEST(Film, AReplicateIsOneValueHoweverFewItsSamples) {
  PixelMoments whole, one, none;
  one.add({3, 3, 3});
  none.add({std::numeric_limits<float>::infinity(), 1, 1});
  whole.add_replicate(one);
  whole.add_replicate(none);
  EXPECT_EQ(whole.count, 1u);
  EXPECT_EQ(whole.mean.r, 3.0);
  EXPECT_EQ(whole.non_finite, 1u);
}

TEST(Film, CountsWhatIsNotFiniteInAllPixels) {
  Film film(2, 1);
  EXPECT_EQ(film.non_finite(), 0u);
  for (int x : {0, 0, 1}) film.at(x, 0).add({std::numeric_limits<float>::quiet_NaN(), 0, 0});
  EXPECT_EQ(film.non_finite(), 3u);
}

TEST(Film, RelativeErrorFollowsItsDefinition) {
  Film film(1, 1);
  film.at(0, 0).add({1, 1, 1});
  film.at(0, 0).add({3, 3, 3});
  // Mean 2, variance 2, two samples: √((2/2)/(4 + 0.01)).
  EXPECT_NEAR(film.relative_error(), std::sqrt(1 / 4.01), 1e-12);
}

}  // namespace
}  // namespace plumbline::renderer
