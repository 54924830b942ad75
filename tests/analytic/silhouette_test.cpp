#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <boost/math/quadrature/tanh_sinh.hpp>

#include <plumbline/analytic/silhouette.h>

namespace plumbline::analytic {
namespace {

using std::numbers::pi;

struct Case {
  View view;
  FilmSize film;
  Vec3 center;
  double radius;
};

std::vector<Case> cases() {
  return {
      {{{0, -4, 0}, {0.4, 0, 0.2}, {0, 0, 1}, 50}, {40, 30}, {0, 0, 0}, 1},
      {{{0, -4, 0}, {0, 0, 0}, {0, 0, 1}, 90}, {16, 16}, {0, 0, 0}, 1},
      {{{1, 2, 3}, {-1, 0.5, 0}, {0.1, 1, 0.2}, 110}, {25, 40}, {-0.5, 1.2, -0.3}, 1.7},
      {{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 120}, {32, 16}, {1.2, 0.1, 1}, 0.4},
  };
}

/// Whether the ray through film coordinates (x, y) hits the sphere: the discriminant of the
/// ray–sphere equation, with no conic in it.
double discriminant(const Case& c, const Camera& camera, double x, double y) {
  const Vec3 w = normalize(camera.direction(x, y));
  const Vec3 offset = c.center - camera.origin;
  const Vec3 miss = offset - w * dot(offset, w);
  return c.radius * c.radius - dot(miss, miss);
}

/// A zero of f between a (f > 0) and b (f ≤ 0), by bisection.
template <class F>
double root(F f, double a, double b) {
  for (int i = 0; i < 200; ++i) {
    const double m = 0.5 * (a + b);
    (f(m) > 0 ? a : b) = m;
  }
  return 0.5 * (a + b);
}

/// Where along [low, high] a concave-topped function is largest, by ternary search.
template <class F>
double argmax(F f, double low, double high) {
  for (int i = 0; i < 300; ++i) {
    const double a = low + (high - low) / 3;
    const double b = high - (high - low) / 3;
    (f(a) < f(b) ? low : high) = f(a) < f(b) ? a : b;
  }
  return 0.5 * (low + high);
}

/// Length of the chord that the sphere cuts out of row y, within [x0, x1].
double chord(const Case& c, const Camera& camera, double y, double x0, double x1) {
  const auto hit = [&](double x) { return discriminant(c, camera, x, y); };
  const double far = 50.0 * c.film.width;
  const double middle = argmax(hit, -far, far);
  if (!(hit(middle) > 0)) return 0;
  const double left = root(hit, middle, -far);
  const double right = root(hit, middle, far);
  return std::max(0.0, std::min(right, x1) - std::max(left, x0));
}

TEST(UnitDiskPolygonArea, KnownPieces) {
  EXPECT_NEAR(unit_disk_polygon_area({{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}}), pi, 1e-14);
  EXPECT_NEAR(unit_disk_polygon_area({{{0, 0}, {2, 0}, {2, 2}, {0, 2}}}), pi / 4, 1e-15);
  EXPECT_NEAR(unit_disk_polygon_area({{{-.1, -.1}, {.1, -.1}, {.1, .1}, {-.1, .1}}}), 0.04, 1e-16);
  EXPECT_NEAR(unit_disk_polygon_area({{{2, 2}, {3, 2}, {3, 3}, {2, 3}}}), 0, 1e-15);
  // A half plane at distance ½ leaves the segment acos(½) − ½·√3/2.
  EXPECT_NEAR(unit_disk_polygon_area({{{.5, -2}, {2, -2}, {2, 2}, {.5, 2}}}),
              pi / 3 - std::sqrt(3.0) / 4, 1e-15);
  // Turned the other way round, the area is negative.
  EXPECT_NEAR(unit_disk_polygon_area({{{0, 2}, {2, 2}, {2, 0}, {0, 0}}}), -pi / 4, 1e-15);
}

TEST(SphereSilhouette, CoverageAgreesWithIntegratedChords) {
  boost::math::quadrature::tanh_sinh<double> quadrature;
  for (const Case& c : cases()) {
    const Camera camera = make_camera(c.view, c.film);
    const SphereSilhouette silhouette(camera, c.center, c.radius);
    const double w = c.film.width;
    const double h = c.film.height;
    // Rows that the sphere reaches: the chord's length vanishes like a square root at either end,
    // which tanh-sinh takes in its stride.
    const auto best = [&](double y) {
      const double x =
          argmax([&](double t) { return discriminant(c, camera, t, y); }, -50 * w, 50 * w);
      return discriminant(c, camera, x, y);
    };
    const double middle = argmax(best, -10 * h, 10 * h);
    const double top = std::max(0.0, root(best, middle, -10 * h));
    const double bottom = std::min(h, root(best, middle, 10 * h));
    const double area = quadrature.integrate(
        [&](double y) { return chord(c, camera, y, -50 * w, 50 * w); }, top, bottom, 1e-11);
    EXPECT_NEAR(silhouette.coverage({-50 * w, 0, 50 * w, h}) * 100 * w * h, area, 1e-9 * area);
  }
}

TEST(SphereSilhouette, PixelsOnTheOutlineAgreeWithBruteForce) {
  constexpr int kGrid = 500;
  for (const Case& c : cases()) {
    const Camera camera = make_camera(c.view, c.film);
    const SphereSilhouette silhouette(camera, c.center, c.radius);
    int on_outline = 0;
    for (int y = 0; y < c.film.height; y += 5) {
      for (int x = 0; x < c.film.width && on_outline < 8; ++x) {
        const double exact = silhouette.coverage({1.0 * x, 1.0 * y, x + 1.0, y + 1.0});
        if (exact < 0.01 || exact > 0.99) continue;
        ++on_outline;
        int hits = 0;
        for (int i = 0; i < kGrid; ++i) {
          for (int j = 0; j < kGrid; ++j) {
            hits += discriminant(c, camera, x + (i + 0.5) / kGrid, y + (j + 0.5) / kGrid) > 0;
          }
        }
        // A smooth outline crosses about kGrid cells, each wrong by at most one half.
        EXPECT_NEAR(exact, 1.0 * hits / (kGrid * kGrid), 1.0 / kGrid) << x << ' ' << y;
      }
    }
    EXPECT_GE(on_outline, 4);
  }
}

TEST(SphereSilhouette, BoxesAddUp) {
  const Case c = cases()[0];
  const SphereSilhouette silhouette(make_camera(c.view, c.film), c.center, c.radius);
  double sum = 0;
  for (int y = 0; y < c.film.height; ++y) {
    for (int x = 0; x < c.film.width; ++x) {
      sum += silhouette.coverage({1.0 * x, 1.0 * y, x + 1.0, y + 1.0});
    }
  }
  EXPECT_NEAR(sum, silhouette.coverage({0, 0, 40, 30}) * 40 * 30, 1e-11);
}

TEST(SphereSilhouette, SphereOnTheAxisIsACircle) {
  // sin σ = 1/4: the outline has the radius tan σ on the image plane.
  const Camera camera = make_camera({{0, -4, 0}, {0, 0, 0}, {0, 0, 1}, 90}, {2, 2});
  const SphereSilhouette silhouette(camera, {0, 0, 0}, 1);
  const double tan2 = 1.0 / 15;
  EXPECT_NEAR(silhouette.coverage({0, 0, 2, 2}), pi * tan2 / 4, 1e-15);
  EXPECT_NEAR(silhouette.coverage({1, 0, 2, 1}), pi * tan2 / 4, 1e-15);
}

TEST(SphereSilhouette, RefusesASphereThatIsNotWhollyInFront) {
  const Camera camera = make_camera({{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 90}, {2, 2});
  EXPECT_THROW(SphereSilhouette(camera, {0, 0, -3}, 1), std::invalid_argument);
  EXPECT_THROW(SphereSilhouette(camera, {3, 0, 0.5}, 1), std::invalid_argument);
  EXPECT_THROW(SphereSilhouette(camera, {0, 0, 0.5}, 1), std::invalid_argument);
  EXPECT_NO_THROW(SphereSilhouette(camera, {3, 0, 1.5}, 1));
}

TEST(Camera, FollowsMitsubaConventions) {
  const Camera camera = make_camera({{0, -4, 0}, {0, 0, 0}, {0, 0, 1}, 90}, {200, 100});
  // Looking along +y with z up, the right of the image is +x.
  EXPECT_EQ(camera.left, (Vec3{-1, 0, 0}));
  EXPECT_EQ(camera.up, (Vec3{0, 0, 1}));
  EXPECT_EQ(camera.direction(100, 50), (Vec3{0, 1, 0}));
  EXPECT_NEAR(camera.direction(200, 50).x, 1, 1e-15);   // half of 90° across the width
  EXPECT_NEAR(camera.direction(100, 0).z, 0.5, 1e-15);  // square pixels: half of that upwards
}

TEST(Camera, RefusesNonsense) {
  EXPECT_THROW(make_camera({{0, 0, 0}, {0, 0, 1}, {0, 0, 1}, 90}, {2, 2}), std::invalid_argument);
  EXPECT_THROW(make_camera({{0, 0, 0}, {0, 0, 0}, {0, 0, 1}, 90}, {2, 2}), std::invalid_argument);
  EXPECT_THROW(make_camera({{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 180}, {2, 2}), std::invalid_argument);
  EXPECT_THROW(make_camera({{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 90}, {2, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::analytic
