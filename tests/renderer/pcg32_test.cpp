#include <plumbline/renderer/core/sampling/pcg32.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <utility>

#include <plumbline/renderer/core/sampling/sobol.h>

namespace plumbline::renderer {
namespace {

TEST(Pcg32, NeverReturnsOneAndCoversTheUnitInterval) {
  Pcg32 random(1, 2, 3);
  float low = 1, high = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const float u = random.next_1d();
    ASSERT_GE(u, 0.0f);
    ASSERT_LT(u, 1.0f);
    low = std::min(low, u);
    high = std::max(high, u);
  }
  // Each bound is missed by a correct generator with probability (1 − 2e-5)^1e6 = 2e-9.
  EXPECT_LT(low, 2e-5f);
  EXPECT_GT(high, 1 - 2e-5f);
}

TEST(Pcg32, ThirtyTwoBitsTimesTwoToTheMinusThirtyTwoWouldReachOne) {
  // Why next_1d takes 24 bits: the widespread alternative rounds up.
  EXPECT_EQ(static_cast<float>(0xffffffffu) * 0x1p-32f, 1.0f);
}

TEST(Pcg32, GivesThePublishedNumbers) {
  // The demonstration of pcg-c-basic, pcg32_srandom(42, 54), after the two steps of its seeding.
  Pcg32 random({0x185706b82c2e03f8u, 54u << 1 | 1u});
  for (const std::uint32_t bits :
       {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu}) {
    EXPECT_EQ(random.next_bits(), bits);
  }
}

TEST(MixBits, GivesThePublishedNumberOfSplitMix64) {
  // The first number of SplitMix64 from the state 1234567, which adds the golden ratio first.
  EXPECT_EQ(mix_bits(1234567u + 0x9e3779b97f4a7c15u), 6457827717110365317u);
}

// An image that was made with a seed is made again with it, by every later version. The numbers are
// from a few lines of Python written after the formulas' sources.
TEST(Pcg32, SeedPixelAndSampleStayTheSequenceThatTheyWere) {
  Pcg32 random(1, 2, 3);
  for (const std::uint32_t bits : {0xcb837636u, 0x15084b7au, 0xc49d0ff6u, 0x6ecfd4ecu}) {
    EXPECT_EQ(random.next_bits(), bits);
  }
}

TEST(SobolSampler, SeedNetAndIndexStayThePointsThatTheyWere) {
  SobolSampler pairs(1, 2, 3);
  for (const auto& [x, y] : {std::pair{0xad5f11, 0x96bb31}, std::pair{0xaaf9b1, 0x2eaba4},
                             std::pair{0x0bb976, 0xf5b39a}}) {
    const Vec2f point = pairs.next_2d();
    EXPECT_EQ(point.x, static_cast<float>(x) * 0x1p-24f);
    EXPECT_EQ(point.y, static_cast<float>(y) * 0x1p-24f);
  }
  // A number alone is the first of the pair that would have stood in its place.
  SobolSampler numbers(1, 2, 3);
  EXPECT_EQ(numbers.next_1d(), static_cast<float>(0xad5f11) * 0x1p-24f);
}

TEST(Pcg32, NeighbouringPixelsSamplesAndSeedsStartDifferentSequences) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (std::uint64_t pixel = 0; pixel < 20; ++pixel) {
      for (std::uint64_t sample = 0; sample < 20; ++sample) {
        Pcg32 random(seed, pixel, sample);
        const std::uint64_t high = random.next_bits();
        seen.insert(high << 32 | random.next_bits());
      }
    }
  }
  EXPECT_EQ(seen.size(), 8000u);
}

}  // namespace
}  // namespace plumbline::renderer
