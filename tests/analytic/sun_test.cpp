#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <plumbline/analytic/known_scene.h>

/// The sidewalk and the point light, whose answers are made of closed forms, against quadrature of
/// the same integrals at points of the film.
namespace plumbline::analytic {
namespace {

using std::numbers::pi;

using boost::math::quadrature::gauss_kronrod;

/// ∫ of f(w, cos of the angle to the axis, for which w is unit) over the cone around `axis` [sr].
template <class F>
double over_cone(const Vec3& axis, double half_angle, const F& f) {
  const Vec3 s = normalize(cross(axis, std::abs(axis.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
  const Vec3 t = cross(axis, s);
  return gauss_kronrod<double, 31>::integrate(
      [&](double a) {
        return std::sin(a) * gauss_kronrod<double, 31>::integrate(
                                 [&](double phi) {
                                   return f(axis * std::cos(a) + s * (std::sin(a) * std::cos(phi)) +
                                            t * (std::sin(a) * std::sin(phi)));
                                 },
                                 0, 2 * pi, 3, 1e-12);
      },
      0, half_angle, 3, 1e-12);
}

/// The image at a point: its mean over a box far smaller than anything in it.
double at(const PixelOracle& oracle, double x, double y) {
  constexpr double kHalf = 1e-4;
  return oracle.box_mean({x - kHalf, y - kHalf, x + kHalf, y + kHalf}).value.g;
}

constexpr std::array<std::pair<double, double>, 5> kFilmPoints{
    {{32, 24}, {0.5, 0.5}, {63, 5}, {3, 40}, {50, 47}}};

/// The sidewalk at a film point: the camera is 1 above the origin, looks down, and +y is up.
Vec3 sidewalk_point(double x, double y) {
  const double scale = std::tan(25 * pi / 180) / 32;
  return {(x - 32) * scale, (24 - y) * scale, 0};
}

/// How high the black wall in the plane x = −1, |y| ≤ 2, stands in an azimuth: tangent of the
/// elevation of its upper edge, 0 beside it.
double wall_tangent(const Vec3& p, double phi) {
  const double cosine = std::cos(phi);
  if (cosine >= 0) return 0;
  const double distance = (p.x + 1) / -cosine;
  return std::abs(p.y + distance * std::sin(phi)) <= 2 ? 3 / distance : 0;
}

/// ∫ cosθ over the sky that the wall leaves: cos²/2 of the elevation from which on it is seen.
double sky_irradiance(const Vec3& p) {
  const auto open = [&](double phi) {
    const double tangent = wall_tangent(p, phi);
    return 0.5 / (1 + tangent * tangent);
  };
  // The wall's vertical edges, between which it stands.
  const double first = std::atan2(2 - p.y, -1 - p.x);
  const double last = std::atan2(-2 - p.y, -1 - p.x) + 2 * pi;
  return gauss_kronrod<double, 31>::integrate(open, first, last, 10, 1e-12) +
         (2 * pi - (last - first)) / 2;
}

/// ∫ cosθ over the part of the sun that the wall leaves, direction by direction.
double sun_irradiance(const Vec3& p, const Vec3& to_sun) {
  return over_cone(to_sun, 0.2665 * pi / 180, [&](const Vec3& w) {
    const double tangent = w.z / std::hypot(w.x, w.y);
    return tangent < wall_tangent(p, std::atan2(w.y, w.x)) ? 0.0 : w.z;
  });
}

void expect_sidewalk_by_quadrature(double sun_x) {
  const auto oracle = make_oracle(known_scene("sidewalk"), {{"sun_x", sun_x}});
  const Vec3 to_sun = normalize({-sun_x, 0.2, 1});
  for (const auto& [x, y] : kFilmPoints) {
    const Vec3 p = sidewalk_point(x, y);
    const double expected =
        0.5 / pi * (0.5 * sky_irradiance(p) + 20000 * sun_irradiance(p, to_sun));
    EXPECT_NEAR(at(*oracle, x, y) / expected, 1, 1e-8) << x << " " << y;
  }
}

TEST(Sidewalk, InTheSunIsTheQuadratureOfSunAndOpenSky) { expect_sidewalk_by_quadrature(-0.5); }

TEST(Sidewalk, InTheShadeIsTheQuadratureOfTheOpenSkyAlone) {
  expect_sidewalk_by_quadrature(0.8);
  // In the shade the answer does not know of the sun.
  const ParameterValues dark{{"sun_x", 0.8}, {"sun", 0}};
  EXPECT_EQ(at(*make_oracle(known_scene("sidewalk"), {{"sun_x", 0.8}}), 10, 10),
            at(*make_oracle(known_scene("sidewalk"), dark), 10, 10));
}

TEST(Sidewalk, RefusesTheEdgeOfTheShadow) {
  EXPECT_THROW(make_oracle(known_scene("sidewalk"), {{"sun_x", 1.0 / 3}}), std::invalid_argument);
}

/// The floor at a film point of point_glossy: from (−1.2, 0, 1.2) to the origin, 40° wide.
Vec3 glossy_point(double x, double y) {
  const double scale = std::tan(20 * pi / 180) / 32;
  const double h = std::sqrt(0.5);
  const Vec3 d =
      Vec3{h, 0, -h} + Vec3{0, -1, 0} * ((x - 32) * scale) + Vec3{h, 0, h} * ((24 - y) * scale);
  return Vec3{-1.2, 0, 1.2} + d * (1.2 / -d.z);
}

TEST(PointGlossy, IsTheLimitOfASmallSphereThatEmitsAsMuch) {
  constexpr double kRadius = 1e-4, kIntensity = 5, kExponent = 20;
  const auto oracle = make_oracle(known_scene("point_glossy"));
  for (const auto& [x, y] : kFilmPoints) {
    const Vec3 p = glossy_point(x, y);
    const Vec3 to_light = Vec3{1.2, 0, 1.2} - p, from_camera = p - Vec3{-1.2, 0, 1.2};
    const double distance = std::sqrt(dot(to_light, to_light));
    const Vec3 mirrored = normalize({from_camera.x, from_camera.y, -from_camera.z});
    const double radiance = kIntensity / (pi * kRadius * kRadius);
    const double expected =
        over_cone(normalize(to_light), std::asin(kRadius / distance), [&](const Vec3& w) {
          const double lobe = std::pow(std::max(dot(w, mirrored), 0.0), kExponent);
          return (kExponent + 2) / (2 * pi) * lobe * radiance * w.z;
        });
    // What the sphere's extent changes is of the order of n² R²/d².
    EXPECT_NEAR(at(*oracle, x, y) / expected, 1, 1e-5) << x << " " << y;
  }
  // In the middle the light lies in the mirror direction: 11/π · I cos45°/d².
  EXPECT_NEAR(at(*oracle, 32, 24), 11 / pi * kIntensity * std::sqrt(0.5) / 2.88, 1e-6);
}

}  // namespace
}  // namespace plumbline::analytic
