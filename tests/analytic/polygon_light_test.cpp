#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <plumbline/analytic/polygon_light.h>

namespace plumbline::analytic {
namespace {

using std::numbers::pi;
constexpr Vec3 kUp{0, 0, 1};

using boost::math::quadrature::gauss_kronrod;

Vec3 unit(double x, double y, double z) { return normalize({x, y, z}); }

/// ∫ (w·u)ⁿ (v·u) cosθ'/d² dA over the triangle, both cosines cut at 0: over the area, where the
/// closed form goes along the boundary.
double moment_by_area(const Polygon& t, const Vec3& p, const Vec3& v, const Vec3& w, int n) {
  const Vec3 e1 = t[1] - t[0], e2 = t[2] - t[0];
  const Vec3 normal = cross(e1, e2);
  return gauss_kronrod<double, 21>::integrate(
      [&](double a) {
        return gauss_kronrod<double, 21>::integrate(
            [&](double b) {
              const Vec3 r = t[0] + e1 * a + e2 * (b * (1 - a)) - p;
              const double d = std::sqrt(dot(r, r));
              const double above = std::fmax(0, dot(v, r) / d);
              const double lobe = std::fmax(0, dot(w, r) / d);
              const double power = n == 0 ? (lobe > 0 ? 1 : 0) : std::pow(lobe, n);
              return power * above * std::abs(dot(normal, r)) / (d * d * d) * (1 - a);
            },
            0.0, 1.0, 12, 1e-11);
      },
      0.0, 1.0, 12, 1e-11);
}

const Polygon kTriangle{{-0.6, -0.5, 1.5}, {0.7, -0.3, 1.2}, {0, 0.8, 1.9}};
const Polygon kDipping{{0.5, -0.5, -0.4}, {0.9, 0.6, -0.1}, {0.7, 0.1, 1.1}};

TEST(PolygonIrradiance, AgreesWithQuadratureOverTheArea) {
  for (const Vec3& p : {Vec3{0, 0, 0}, {1.75, 0.2, 0}, {-3, 1, 0.4}}) {
    const double exact = polygon_irradiance(kTriangle, p, kUp);
    EXPECT_NEAR(exact, moment_by_area(kTriangle, p, kUp, kUp, 0), 1e-10 * exact);
  }
}

TEST(PolygonIrradiance, CutByTheHorizonAgreesWithQuadratureOverTheArea) {
  for (const Vec3& p : {Vec3{0, 0, 0}, {-1, 0.3, 0}}) {
    const double exact = polygon_irradiance(kDipping, p, kUp);
    EXPECT_NEAR(exact, moment_by_area(kDipping, p, kUp, kUp, 0), 1e-5 * exact);
  }
  EXPECT_EQ(polygon_irradiance({{1, 0, -1}, {0, 1, -1}, {-1, -1, -2}}, {0, 0, 0}, kUp), 0);
}

TEST(PolygonIrradiance, OfAVastSquareIsPi) {
  const double r = 1e8;
  EXPECT_NEAR(polygon_irradiance({{-r, -r, 1}, {r, -r, 1}, {r, r, 1}, {-r, r, 1}}, {0, 0, 0}, kUp),
              pi, 1e-12);
}

TEST(PolygonIrradiance, DoesNotDependOnTheOrderOfCornersNorOnTheScale) {
  const Polygon turned{kTriangle[2], kTriangle[1], kTriangle[0]};
  Polygon large = kTriangle;
  for (Vec3& corner : large) corner = corner * 1e6;
  const double exact = polygon_irradiance(kTriangle, {0, 0, 0}, kUp);
  EXPECT_NEAR(polygon_irradiance(turned, {0, 0, 0}, kUp), exact, 1e-15);
  EXPECT_NEAR(polygon_irradiance(large, {0, 0, 0}, kUp), exact, 1e-14);
}

TEST(PolygonSolidAngle, OfAnOctantIsHalfPi) {
  EXPECT_NEAR(polygon_solid_angle({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}, kUp), pi / 2,
              1e-15);
}

TEST(PolygonMoment, WithoutALobeIsTheIrradianceAboveItsPlane) {
  const double exact = polygon_irradiance(kTriangle, {0, 0, 0}, kUp);
  EXPECT_NEAR(polygon_moment(kTriangle, {0, 0, 0}, kUp, kUp, 0), exact, 1e-14);
}

TEST(PolygonMoment, AgreesWithQuadratureOverTheArea) {
  for (const int n : {1, 2, 5, 20, 41}) {
    for (const Vec3& axis : {kUp, unit(0.3, -0.2, 1), unit(-1, 0.2, 0.8)}) {
      const double exact = polygon_moment(kTriangle, {0.2, 0.1, 0}, kUp, axis, n);
      EXPECT_NEAR(exact, moment_by_area(kTriangle, {0.2, 0.1, 0}, kUp, axis, n),
                  1e-9 * exact + 1e-14)
          << n;
    }
  }
}

TEST(PolygonMoment, CutByTheLobesOwnHorizonAgreesWithQuadrature) {
  const Vec3 axis = unit(1, 0, 0.05);
  const Polygon across{{-1, -1, 1}, {1.5, -1, 1}, {0.3, 1.2, 1}};
  for (const int n : {2, 5}) {
    const double exact = polygon_moment(across, {0, 0, 0}, kUp, axis, n);
    EXPECT_NEAR(exact, moment_by_area(across, {0, 0, 0}, kUp, axis, n), 1e-6 * exact) << n;
  }
}

TEST(ConeMoment, AroundTheLobesAxisIsTheClosedForm) {
  for (const int n : {1, 2, 20, 101}) {
    for (const double tilt : {0.0, 0.5, 1.0}) {
      for (const double theta : {1e-3, 0.1, 0.5}) {
        const Vec3 axis{std::sin(tilt), 0, std::cos(tilt)};
        // 1 − cosⁿ⁺²θ without cancelling.
        const double closed =
            std::cos(tilt) * 2 * pi * -std::expm1((n + 2) * std::log(std::cos(theta))) / (n + 2);
        EXPECT_NEAR(cone_moment(axis, theta, kUp, axis, n), closed, 1e-12 * closed + 1e-15);
      }
    }
  }
}

TEST(ConeMoment, BesideTheAxisAgreesWithQuadratureOverTheCone) {
  const Vec3 center = unit(0.2, 0.3, 1), axis = unit(-0.3, 0.1, 1);
  const Vec3 e1 = normalize(cross(center, {1, 0, 0})), e2 = cross(center, e1);
  const double theta = 0.4;
  for (const int n : {1, 2, 7, 30}) {
    const double by_area = gauss_kronrod<double, 21>::integrate(
        [&](double t) {
          return std::sin(t) * gauss_kronrod<double, 21>::integrate(
                                   [&](double phi) {
                                     const Vec3 u =
                                         center * std::cos(t) +
                                         (e1 * std::cos(phi) + e2 * std::sin(phi)) * std::sin(t);
                                     return std::pow(dot(axis, u), n) * u.z;
                                   },
                                   0.0, 2 * pi, 12, 1e-12);
        },
        0.0, theta, 12, 1e-12);
    EXPECT_NEAR(cone_moment(center, theta, kUp, axis, n), by_area, 1e-10 * by_area) << n;
  }
}

TEST(ConeMoment, RefusesAConeBelowAHorizon) {
  EXPECT_THROW(cone_moment(unit(1, 0, 0.1), 0.3, kUp, kUp, 2), std::invalid_argument);
  EXPECT_THROW(cone_moment(kUp, 0.3, kUp, unit(1, 0, 0), 2), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::analytic
