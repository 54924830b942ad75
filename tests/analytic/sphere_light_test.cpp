#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/analytic/sphere_light.h>

namespace plumbline::analytic {
namespace {

using std::numbers::pi;

/// The irradiance by quadrature over rings around the *normal*, where the closed form works around
/// the light's axis: ∫ cosθ sinθ 2Φ(θ) dθ, with Φ the half-width in azimuth of the cone at polar
/// angle θ.
double irradiance_by_rings(double radius, double height, double lateral) {
  const double d = std::hypot(height, lateral);
  const double sigma = std::asin(radius / d);
  const double beta = std::atan2(lateral, height);
  const double last = std::min(beta + sigma, pi / 2);
  // A ring meets the cone's edge where cosΦ = (cos σ − cosθ cosβ)/(sinθ sinβ), and 1 ∓ cosΦ factor
  // into half angles, which keeps Φ precise where the ring only grazes it.
  const auto half_width = [&](double theta) {
    if (theta <= sigma - beta) return pi;
    const double a = std::sin((sigma + beta - theta) / 2) * std::sin((sigma - beta + theta) / 2);
    const double b = std::sin((theta + beta - sigma) / 2) * std::sin((theta + beta + sigma) / 2);
    return 2 * std::atan2(std::sqrt(std::max(a, 0.0)), std::sqrt(std::max(b, 0.0)));
  };
  const auto ring = [&](double theta) {
    return std::cos(theta) * std::sin(theta) * 2 * half_width(theta);
  };
  boost::math::quadrature::tanh_sinh<double> quadrature;
  double sum = 0;
  if (sigma > beta) {
    sum += quadrature.integrate(ring, 0.0, std::min(sigma - beta, pi / 2), 1e-14);
  }
  const double first = std::abs(beta - sigma);
  if (first < last) sum += quadrature.integrate(ring, first, last, 1e-14);
  return sum;
}

TEST(SphereIrradiance, AboveTheHorizonAgreesWithQuadrature) {
  for (const double height : {0.5, 0.6, 1.0, 3.0, 20.0}) {
    for (const double lateral : {0.0, 0.1, 0.75, 2.0, 10.0}) {
      const double exact = sphere_irradiance(0.5, height, lateral);
      EXPECT_NEAR(exact, irradiance_by_rings(0.5, height, lateral), 1e-12 * exact)
          << height << ' ' << lateral;
    }
  }
}

TEST(SphereIrradiance, PartlyBelowTheHorizonAgreesWithQuadrature) {
  for (const double height : {0.49999, 0.4, 0.25, 0.01, 0.0, -0.01, -0.25, -0.4}) {
    for (const double lateral : {0.501, 0.6, 0.75, 2.0, 10.0}) {
      const double exact = sphere_irradiance(0.5, height, lateral);
      const double scale = std::max(exact, pi * 0.25 / (lateral * lateral + height * height));
      const double tolerance = height >= 0 ? 1e-12 * exact : 1e-12 * scale;
      EXPECT_NEAR(exact, irradiance_by_rings(0.5, height, lateral), tolerance)
          << height << ' ' << lateral;
    }
  }
}

TEST(SphereIrradiance, IsContinuousWhereTheSphereTouchesThePlane) {
  for (const double lateral : {0.1, 0.75, 3.0}) {
    const double touching = sphere_irradiance(0.5, 0.5, lateral);
    const double dipping = sphere_irradiance(0.5, 0.5 * (1 - 1e-10), lateral);
    EXPECT_NEAR(dipping, touching, 1e-9 * touching) << lateral;
  }
}

TEST(SphereIrradiance, VanishesAsTheSphereSinks) {
  EXPECT_NEAR(sphere_irradiance(0.5, -0.4999, 2), 0, 1e-6);
  EXPECT_EQ(sphere_irradiance(0.5, -0.5, 2), 0);
  EXPECT_EQ(sphere_irradiance(0.5, -3, 2), 0);
}

TEST(SphereIrradiance, TouchingPointSeesNothingElse) {
  // At the contact point the sphere fills the hemisphere.
  EXPECT_DOUBLE_EQ(sphere_irradiance(0.5, 0.5, 0), pi);
}

TEST(SphereIrradiance, HalfSunkenSphereLooksHalfAsLarge) {
  // Centre in the plane: the upper half of the circle, E/L = ψ₀ − sin ψ₀ cos ψ₀ with sin ψ₀ = R/r.
  for (const double lateral : {0.6, 1.0, 5.0, 1e3, 1e6}) {
    const double x = 0.5 / lateral;
    const double exact = x < 0.01 ? 2 * x * x * x / 3 * (1 + 0.3 * x * x)
                                  : std::asin(x) - x * std::sqrt((1 - x) * (1 + x));
    EXPECT_NEAR(sphere_irradiance(0.5, 0, lateral), exact, 3e-9 * x * x * exact + 1e-13 * exact);
  }
}

TEST(SphereIrradiance, FarSphereIsAPointLight) {
  // E/L → π R² cosβ/d², with a relative error that is exactly 0 above the horizon.
  EXPECT_NEAR(sphere_irradiance(1e-6, 3, 4) / (pi * 1e-12 * 0.6 / 25), 1, 1e-14);
}

TEST(SphereIrradiance, InsideTheSphereIsDark) { EXPECT_EQ(sphere_irradiance(1, 0.5, 0.2), 0); }

TEST(SphereIrradianceMean, AgreesWithNestedQuadrature) {
  using boost::math::quadrature::gauss_kronrod;
  struct Box {
    double x0, x1, y0, y1;
  };
  const std::vector<Box> boxes = {{0.75, 2.75, -0.75, 0.75}, {1, 1.01, 0.3, 0.31}, {-1, 1, -1, 1}};
  for (const Box& box : boxes) {
    for (const double height : {0.5, 1.0, 4.0}) {
      const auto row = [&](double y) {
        return gauss_kronrod<double, 21>::integrate(
            [&](double x) { return sphere_irradiance(0.5, height, std::hypot(x, y)); }, box.x0,
            box.x1, 8, 1e-13);
      };
      const double mean = gauss_kronrod<double, 21>::integrate(row, box.y0, box.y1, 8, 1e-13) /
                          ((box.x1 - box.x0) * (box.y1 - box.y0));
      const double exact =
          sphere_irradiance_mean_above(0.5, height, box.x0, box.x1, box.y0, box.y1);
      EXPECT_NEAR(exact, mean, 1e-11 * mean);
    }
  }
}

TEST(SphereIrradianceMean, TendsToThePointValueForSmallBoxes) {
  for (const double side : {1e-3, 1e-5, 1e-7}) {
    const double mean = sphere_irradiance_mean_above(0.5, 1, 1.5, 1.5 + side, 0.2, 0.2 + side);
    const double point = sphere_irradiance(0.5, 1, std::hypot(1.5 + side / 2, 0.2 + side / 2));
    EXPECT_NEAR(mean, point, (side * side + 1e-13) * point);
  }
}

TEST(SphereLightScene, PixelsAgreeWithBruteForceThroughTheCamera) {
  const KnownScene& scene = known_scene("sphere_light");
  for (const auto& [radius, height] :
       {std::pair{0.5, 1.0}, {0.5, 0.5}, {0.5, 0.2}, {0.4, 0.0}, {0.4, -0.1}}) {
    const auto oracle =
        make_oracle(scene, {{"radius", radius}, {"height", height}}, FilmSize{16, 12});
    const Camera camera = make_camera(scene.view, {16, 12});
    constexpr int kGrid = 40;
    for (const auto& [px, py] : {std::pair{0, 0}, {0, 5}, {7, 3}, {15, 11}}) {
      double sum = 0;
      for (int i = 0; i < kGrid; ++i) {
        for (int j = 0; j < kGrid; ++j) {
          const Vec3 w = camera.direction(px + (i + 0.5) / kGrid, py + (j + 0.5) / kGrid);
          const double t = -camera.origin.z / w.z;
          const Vec3 p = camera.origin + w * t;
          sum += sphere_irradiance(radius, height, std::hypot(p.x, p.y));
        }
      }
      const double brute = 0.75 / pi * 4 * sum / (kGrid * kGrid);
      const Average exact = oracle->pixel_mean(px, py);
      EXPECT_NEAR(exact.value.g, brute, 3e-4 * brute) << height << ' ' << px << ' ' << py;
      EXPECT_LE(exact.error.g, 1e-9 * exact.value.g);
      EXPECT_GE(exact.error.g, 0);
    }
  }
}

TEST(SphereLightScene, PixelsSumToTheImageMean) {
  for (const double height : {1.0, 0.5}) {
    const auto oracle =
        make_oracle(known_scene("sphere_light"), {{"height", height}}, FilmSize{16, 12});
    double sum = 0;
    for (const Colour& value : oracle->image()) sum += value.g;
    const Average mean = oracle->image_mean();
    EXPECT_NEAR(sum / (16 * 12), mean.value.g, 1e-9 * mean.value.g);
  }
}

TEST(SphereLightScene, IsBlackBeforeDirectLightCounts) {
  const auto oracle = make_oracle(known_scene("sphere_light"), {}, std::nullopt, 1);
  EXPECT_EQ(oracle->image_mean().value.g, 0);
}

TEST(SphereLightScene, RefusesALightInView) {
  const KnownScene& scene = known_scene("sphere_light");
  EXPECT_THROW(make_oracle(scene, {{"radius", 1.5}}), std::invalid_argument);
  EXPECT_THROW(make_oracle(scene, {{"height", 0.0}, {"radius", 0.6}}), std::invalid_argument);
  EXPECT_THROW(make_oracle(scene, {{"radius", 0.0}}), std::invalid_argument);
  EXPECT_THROW(make_oracle(scene, {{"height", std::nan("")}}), std::invalid_argument);
  EXPECT_THROW(make_oracle(scene, {}, FilmSize{1, 100}), std::invalid_argument);
  EXPECT_NO_THROW(make_oracle(scene, {{"height", 0.0}, {"radius", 0.4}}));
}

}  // namespace
}  // namespace plumbline::analytic
