#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/analytic/shadow.h>

namespace plumbline::analytic {
namespace {

using std::numbers::pi;

using boost::math::quadrature::gauss_kronrod;

TEST(DiskIrradiance, AboveTheCentreIsPiSinSquared) {
  EXPECT_NEAR(disk_irradiance(0.5, 2, 0), pi * 0.25 / 4.25, 1e-15);
  // A point light but for a relative R²/d².
  EXPECT_NEAR(disk_irradiance(1e-5, 3, 4) / (pi * 1e-10 * 9 / 625), 1, 1e-11);
}

TEST(DiskPartIrradiance, OfTheWholeDiskIsTheClosedForm) {
  for (const double x : {0.0, 0.3, 2.0}) {
    for (const double y : {0.0, -1.5}) {
      const double whole = disk_irradiance(0.5, 2, std::hypot(x, y));
      EXPECT_NEAR(disk_part_irradiance(0.5, 2, x, y, -0.5), whole, 1e-12);
      EXPECT_NEAR(disk_part_irradiance(0.5, 2, x, y, -7), whole, 1e-12);
      EXPECT_EQ(disk_part_irradiance(0.5, 2, x, y, 0.5), 0);
      // Mirrored, the other part is what is left.
      EXPECT_NEAR(
          disk_part_irradiance(0.5, 2, x, y, 0.2) + disk_part_irradiance(0.5, 2, -x, y, -0.2),
          whole, 1e-12);
    }
  }
}

TEST(DiskPartIrradiance, AgreesWithQuadratureInPolarCoordinates) {
  const double x = 0.3, y = -0.2, from_x = 0.1;
  const double by_rings = gauss_kronrod<double, 31>::integrate(
      [&](double r) {
        if (r <= from_x) return 0.0;
        const double edge = std::acos(from_x / r);
        return r * gauss_kronrod<double, 31>::integrate(
                       [&](double phi) {
                         const double dx = r * std::cos(phi) - x, dy = r * std::sin(phi) - y;
                         return 4 / std::pow(4 + dx * dx + dy * dy, 2);
                       },
                       -edge, edge, 10, 1e-12);
      },
      from_x, 0.5, 15, 1e-10);
  EXPECT_NEAR(disk_part_irradiance(0.5, 2, x, y, from_x), by_rings, 1e-8);
}

SphereCone cone(double tilt, double half_angle) {
  return {std::sin(tilt), 0, std::cos(tilt), half_angle};
}

TEST(EclipsedIrradiance, FullyOutAndFullyInAreTheLimits) {
  const double full = pi * std::pow(std::sin(0.1), 2) * std::cos(0.3);
  EXPECT_NEAR(eclipsed_irradiance(cone(0.3, 0.1), cone(-0.4, 0.5)), full, 1e-15);
  EXPECT_EQ(eclipsed_irradiance(cone(0.3, 0.1), cone(0.2, 0.5)), 0);
}

TEST(EclipsedIrradiance, AnnulusIsTheDifferenceOfTwoCones) {
  // Blocker wholly inside the light's outline: the lit ring is one cone less another.
  const double annulus = pi * (std::pow(std::sin(0.4), 2) * std::cos(0.3) -
                               std::pow(std::sin(0.1), 2) * std::cos(0.45));
  EXPECT_NEAR(eclipsed_irradiance(cone(0.3, 0.4), cone(0.45, 0.1)), annulus, 1e-7 * annulus);
}

TEST(EclipsedIrradiance, PenumbraAgreesWithASumOverDirections) {
  const SphereCone light = cone(0.3, 0.2), blocker{0.1, 0.2, std::sqrt(1 - 0.05), 0.25};
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    // Uniform in cos a over the light's cone, and in azimuth.
    const double cos_a = 1 - (i + 0.5) / kSteps * (1 - std::cos(light.half_angle));
    const double sin_a = std::sqrt(1 - cos_a * cos_a);
    for (int j = 0; j < kSteps; ++j) {
      const double phi = 2 * pi * (j + 0.5) / kSteps;
      // Frame about the light's axis (sin t, 0, cos t): e1 = (cos t, 0, −sin t), e2 = y.
      const double a = sin_a * std::cos(phi), b = sin_a * std::sin(phi);
      const double x = light.x * cos_a + light.z * a, z = light.z * cos_a - light.x * a;
      const bool covered =
          x * blocker.x + b * blocker.y + z * blocker.z >= std::cos(blocker.half_angle);
      if (!covered) sum += z;
    }
  }
  sum *= 2 * pi * (1 - std::cos(light.half_angle)) / (1.0 * kSteps * kSteps);
  const double exact = eclipsed_irradiance(light, blocker);
  EXPECT_NEAR(exact, sum, 2e-4 * exact);
}

TEST(EclipsedIrradiance, RefusesALightBelowTheHorizon) {
  EXPECT_THROW(eclipsed_irradiance(cone(1.5, 0.2), cone(0, 0.1)), std::invalid_argument);
}

TEST(SphereShadowScene, IsBlackInTheUmbraAndUnblockedFarAside) {
  const KnownScene& scene = known_scene("sphere_shadow");
  EXPECT_EQ(make_oracle(scene, {{"blocker_x", 0.0}})->image_mean().value.g, 0);
  // Without the blocker: π R² h/d³ over the patch, from sphere_light's own closed form.
  const double clear = make_oracle(scene, {{"blocker_x", 3.0}})->image_mean().value.g;
  const double x = 0.5 * std::tan(pi / 6), y = 0.75 * x;
  const double radiance_over_pi = 10 * 0.75 / pi;
  const double by_hand = gauss_kronrod<double, 31>::integrate(
      [&](double a) {
        return gauss_kronrod<double, 31>::integrate(
            [&](double b) { return pi * 3 / std::pow(9 + a * a + b * b, 1.5); }, -y, y, 8, 1e-12);
      },
      -x, x, 8, 1e-12);
  EXPECT_NEAR(clear, radiance_over_pi * by_hand / (4 * x * y), 1e-6 * clear);
}

TEST(IntegratingSphereScene, BalancesAndTruncatesToItsSeries) {
  const KnownScene& scene = known_scene("integrating_sphere");
  const double f = 0.1, albedo = 0.8, emitted = 10;
  const double e = make_oracle(scene)->image_mean().value.g / albedo * pi;
  EXPECT_NEAR(e, pi * emitted * f + albedo * (1 - f) * e, 1e-12);
  double sum = 0, power = 1;
  for (int depth = 1; depth <= 5; ++depth) {
    EXPECT_NEAR(make_oracle(scene, {}, std::nullopt, depth)->image_mean().value.g,
                albedo * emitted * f * sum, 1e-13);
    sum += power;
    power *= albedo * (1 - f);
  }
}

}  // namespace
}  // namespace plumbline::analytic
