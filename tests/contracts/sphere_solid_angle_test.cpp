#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include <plumbline/renderer/core/light/sphere_light.h>

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

TEST(SphereLight, AtTheLimbOfAnInwardOneTheRecordIsTheDensityOfTheDirectionSampled) {
  // From a distance of 3 of the centre of a sphere of radius 2, cosθ at the light is 0 for
  // n_z = 1 − 2 u.x = 2/3.
  const SphereLight light{{0, 0, 0}, 2, true, {1, 1, 1}};
  const Vec3f ref{0, 0, 3};
  int seen = 0;
  for (int i = -10; i <= 2000; ++i) {
    for (const float azimuth : {0.0f, 0.13f, 0.4f, 0.77f}) {
      const auto s = light.sample(ref, Vec2f{1.0f / 6 + static_cast<float>(i) * 0x1p-20f, azimuth});
      if (!s) continue;
      ++seen;
      EXPECT_EQ(s->pdf_w, light.pdf(ref, s->wi));
      EXPECT_GT(s->pdf_w, 0);
    }
  }
  EXPECT_GT(seen, 1000);
}

TEST(SphereLight, OnAnInwardOneTheDensityKeepsItsDigitsAtGrazingAngles) {
  // From a point on the sphere pdf = d²/(cosθ A) with d = 2 R cosθ: 4 R² cosθ/(4π R²) = cosθ/π. The
  // point (0, 0, 1) is exact, and so is its distance from the centre.
  const SphereLight light{{0, 0, 0}, 1, true, {1, 1, 1}};
  for (float cosine = 1; cosine > 1e-6f; cosine *= 0.71f) {
    const Vec3f wi{std::sqrt((1 - cosine) * (1 + cosine)), 0, -cosine};
    EXPECT_NEAR(light.pdf(Vec3f{0, 0, 1}, wi) * renderer::pi<float>() / cosine, 1, 1e-6f) << cosine;
  }
}

TEST(SphereLight, FromInsideASphereThatEmitsOutwardsNothingIsSeen) {
  const SphereLight light{{0, 0, 1}, 2, false, {1, 1, 1}};
  EXPECT_FALSE(light.sample(Vec3f{}, Vec2f{0.5f, 0.5f}));
  EXPECT_EQ(light.pdf(Vec3f{}, Vec3f{0, 0, 1}), 0);
}

}  // namespace
}  // namespace plumbline::tests
