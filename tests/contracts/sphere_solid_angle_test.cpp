#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <plumbline/renderer/light/sphere_light.h>

namespace plumbline::tests {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;
using renderer::SphereLight;
using renderer::Vec2f;
using renderer::Vec3f;

/// 2π (1 − √(1 − R²/d²)), at its most direct: quad has the digits that cancel.
Quad solid_angle(float radius, float distance) {
  const Quad ratio = Quad(radius) / Quad(distance);
  return 2 * renderer::pi<Quad>() * (1 - sqrt(1 - ratio * ratio));
}

TEST(SphereLight, SolidAngleInFloatIsThatOfQuadToSixDigits) {
  // Radius and distance are exact in float, so that the difference is the formula's own. (One ulp
  // of the distance next to the surface moves the true value by 4e-5.)
  for (const float distance : {1.0f, 3.0f, 0.37f, 1000.25f}) {
    for (const float ratio : {1e-7f, 1e-6f, 1e-5f, 1e-4f, 1e-3f, 0.01f, 0.1f, 0.3f, 0.5f, 0.7f,
                              0.9f, 0.99f, 0.999f, 0.9999f, 0.99999f, 0.999999f}) {
      const float radius = ratio * distance;
      const SphereLight light{{0, 0, distance}, radius, false, {1, 1, 1}};
      const Quad exact = solid_angle(radius, distance);
      const float pdf_w = light.pdf(Vec3f{}, Vec3f{0, 0, 1});
      EXPECT_LE(abs(Quad(pdf_w) * exact - 1), 1e-6) << "R/d = " << ratio << ", d = " << distance;
      for (const float u : {0.0f, 0.3f, 1 - 0x1p-24f}) {
        const auto sample = light.sample(Vec3f{}, Vec2f{u, 0.7f});
        ASSERT_TRUE(sample);
        EXPECT_EQ(sample->pdf_w, pdf_w);
      }
    }
  }
}

TEST(SphereLight, FromInsideASphereThatEmitsOutwardsNothingIsSeen) {
  const SphereLight light{{0, 0, 1}, 2, false, {1, 1, 1}};
  EXPECT_FALSE(light.sample(Vec3f{}, Vec2f{0.5f, 0.5f}));
  EXPECT_EQ(light.pdf(Vec3f{}, Vec3f{0, 0, 1}), 0);
}

}  // namespace
}  // namespace plumbline::tests
