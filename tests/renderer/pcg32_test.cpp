#include <plumbline/renderer/core/sampling/pcg32.h>

#include <gtest/gtest.h>

#include <set>

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
