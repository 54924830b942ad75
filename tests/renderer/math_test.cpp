#include <plumbline/renderer/core/math.h>

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::renderer {
namespace {

TEST(SinCosTurns, HoldsItsErrorOverTheWholeTurn) {
  for (int i = 0; i <= 10'000; ++i) {
    const float u = static_cast<float>(i) / 10'000;
    const auto [sine, cosine] = sin_cos_turns(u);
    const double angle = 2 * pi<double>() * static_cast<double>(u);
    EXPECT_NEAR(static_cast<double>(sine), std::sin(angle), 1.2e-7) << u;
    EXPECT_NEAR(static_cast<double>(cosine), std::cos(angle), 1.2e-7) << u;
  }
}

TEST(AngleOf, IsRightToFloatInEveryQuadrantAndForSmallAngles) {
  for (int i = -10'000; i <= 10'000; ++i) {
    const double angle = i == 0 ? 1e-9 : pi<double>() * i / 10'000;
    // Far outside of what float could hold.
    const double y = 1e60 * std::sin(angle), x = 1e60 * std::cos(angle);
    EXPECT_NEAR(static_cast<double>(angle_of<float>(y, x)) / angle, 1, 3e-7) << angle;
    EXPECT_NEAR(angle_of<double>(y, x) / angle, 1, 4e-16) << angle;
  }
  EXPECT_EQ(angle_of<float>(0.0, 0.0), 0.0f);
}

TEST(Luminance, HasTheWeightsOfRec709) {
  // ITU-R BT.709-6, Section 3.2; the sum is that of white.
  EXPECT_EQ(luminance(Rgbd{1, 0, 0}), 0.2126);
  EXPECT_EQ(luminance(Rgbd{0, 1, 0}), 0.7152);
  EXPECT_EQ(luminance(Rgbd{0, 0, 1}), 0.0722);
  EXPECT_EQ(luminance(Rgbf{0, 0, 1}), 0.0722f);
  EXPECT_NEAR(luminance(Rgbd{1, 1, 1}), 1, 1e-15);
}

}  // namespace
}  // namespace plumbline::renderer
