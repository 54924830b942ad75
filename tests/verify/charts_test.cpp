#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/detail/domain.h>

#include "lattice.h"
#include "turns.h"
#include "vec3.h"

/// Charts by what makes them ones: there and back, area by differences, steps of the length that is
/// asked for, and how far beside the domain a point lies.
namespace plumbline::verify {
namespace {

using std::numbers::pi;

Domain paraboloid() {
  return Domain::surface(
      [](const Point2& p) {
        return Vec3{p[0], 2 * p[1], p[0] * p[0]};
      },
      [](const Vec3& x) {
        return Point2{x[0], x[1] / 2};
      },
      [](const Point2& p) { return 2 * std::sqrt(1 + 4 * p[0] * p[0]); });
}

std::vector<Domain> all_domains() {
  return {Domain::interval(-2, 5),   Domain::half_line(3),
          Domain::line(1, 2),        Domain::unit_square(),
          Domain::disk(2.5),         Domain::triangle(),
          Domain::sphere(),          Domain::hemisphere(),
          Domain::hemisphere(false), Domain::equirectangular(8, 4, {0, 1, 0}, {0, 0, 1}),
          Domain::octahedral(4),     paraboloid()};
}

TEST(Charts, LeadThereAndBack) {
  for (const Domain& d : all_domains()) {
    for (const Point2& p : even_points(50)) {
      const Vec3 x = d.chart().from_square(p);
      const Point2 back = d.chart().to_square(x);
      EXPECT_NEAR(back[0], p[0], 1e-12) << d.name();
      EXPECT_NEAR(back[1], d.dimension() == 2 ? p[1] : 0.5, 1e-12) << d.name();
      EXPECT_LT(d.chart().distance(x), 1e-12) << d.name();
    }
  }
}

long double exact_turns(double y, double x) {
  const long double phi = std::atan2(static_cast<long double>(y), static_cast<long double>(x)) /
                          (2 * std::numbers::pi_v<long double>);
  return phi < 0 ? phi + 1 : phi;
}

TEST(Turns, AreThoseOfTheArcTangent) {
  // Each octant's polynomial: at its ends, and dense between.
  for (int i = 0; i <= 100'000; ++i) {
    const double phi = 2 * pi * i / 100'000, x = std::cos(phi), y = std::sin(phi);
    ASSERT_NEAR(turns(y, x), static_cast<double>(exact_turns(y, x)), 2.3e-16) << i;
  }
  for (const double small : {1e-300, 1e-17, 1e-8, 0.41421356237309503, 0.41421356237309510, 1.0}) {
    for (const double sx : {-1.0, 1.0}) {
      for (const double sy : {-1.0, 1.0}) {
        EXPECT_NEAR(turns(sy, sx * small), static_cast<double>(exact_turns(sy, sx * small)),
                    2.3e-16);
        EXPECT_NEAR(turns(sy * small, sx), static_cast<double>(exact_turns(sy * small, sx)),
                    2.3e-16);
      }
    }
  }
}

TEST(Turns, KeepTheDigitsOfASmallAngle) {
  for (const double y : {1e-3, 1e-9, 1e-200}) {
    EXPECT_NEAR(turns(y, 1) / static_cast<double>(exact_turns(y, 1)), 1, 5e-16) << y;
  }
}

TEST(Turns, OfTheAxesAreQuarters) {
  EXPECT_EQ(turns(0, 0), 0);
  EXPECT_EQ(turns(0, 3), 0);
  EXPECT_EQ(turns(3, 0), 0.25);
  EXPECT_EQ(turns(0, -3), 0.5);
  EXPECT_EQ(turns(-3, 0), 0.75);
  EXPECT_EQ(turns(2, 2), 0.125);
  EXPECT_EQ(turns(-1e-30, 1), 1);
}

TEST(Charts, HaveTheAreaElementOfTheirMap) {
  constexpr double kStep = 1e-6;
  for (const Domain& d : all_domains()) {
    for (const Point2& p : even_points(50)) {
      const auto along = [&](std::size_t i) {
        Point2 a = p, b = p;
        a[i] += kStep;
        b[i] -= kStep;
        const Vec3 there = d.chart().from_square(a), here = d.chart().from_square(b);
        return scaled(sum(there, scaled(here, -1)), 1 / (2 * kStep));
      };
      const double by_differences =
          d.dimension() == 2 ? length(cross(along(0), along(1))) : length(along(0));
      // Third derivatives near the ends of a line, times the squared step.
      EXPECT_NEAR(d.chart().element(p) / by_differences, 1, 2e-6) << d.name();
    }
  }
}

/// In units of the domain's size: of a disk its radius, of a line what rounding is in proportion
/// to.
TEST(Charts, StepAsFarAsIsAskedFor) {
  constexpr double kFar = 1e-3;
  for (const Domain& d : all_domains()) {
    if (d.name() == "surface") continue;
    for (const double angle : {0.3, 2.0, 3.5, 5.5}) {
      const Vec3 x = d.chart().from_square({0.4, 0.3});
      const Vec3 step = sum(d.chart().near(x, kFar, angle), scaled(x, -1));
      const double size = d.name() == "disk"        ? 2.5
                          : d.name() == "half-line" ? 3 + x[0]
                          : d.name() == "line"      ? 2 + std::abs(x[0])
                                                    : 1;
      EXPECT_NEAR(length(step) / (kFar * size), 1, 1e-6) << d.name();
      if (d.dimension() == 1) {
        EXPECT_EQ(step[0] > 0, std::cos(angle) > 0) << d.name();
      }
      if (!d.directions() && d.dimension() == 2) {
        EXPECT_NEAR(std::remainder(std::atan2(step[1], step[0]) - angle, 2 * pi), 0, 1e-9);
      }
    }
    // A quarter of a turn later it goes at right angles.
    if (d.dimension() < 2) continue;
    const Vec3 x = d.chart().from_square({0.4, 0.3});
    const Vec3 a = sum(d.chart().near(x, kFar, 0.3), scaled(x, -1));
    const Vec3 b = sum(d.chart().near(x, kFar, 0.3 + pi / 2), scaled(x, -1));
    EXPECT_LT(std::abs(dot(a, b)), 1e-3 * length(a) * length(b)) << d.name();
  }
  const Domain domain = paraboloid();
  const Chart& surface = domain.chart();
  const Vec3 moved = surface.near({0.5, 1, 0.25}, 0.1, pi / 6);
  EXPECT_NEAR(moved[0], 0.5 + 0.1 * std::sqrt(3) / 2, 1e-15);
  EXPECT_NEAR(moved[1], 2 * (0.5 + 0.05), 1e-15);
  EXPECT_EQ(surface.near({0.5, 1, 0.25}, 2, 0), (Vec3{1, 1, 1})) << "not beyond the border";
}

TEST(Charts, SayHowFarOutsideAPointLies) {
  const auto outside = [](const Domain& d, const Vec3& x) { return d.chart().distance(x); };
  EXPECT_EQ(outside(Domain::interval(-2, 5), {-2.5, 0, 0}), 0.5);
  EXPECT_EQ(outside(Domain::interval(-2, 5), {5.25, 0, 0}), 0.25);
  EXPECT_EQ(outside(Domain::half_line(4), {-1, 0, 0}), 0.25);
  EXPECT_EQ(outside(Domain::line(0, 1), {-1e9, 0, 0}), 0);
  EXPECT_EQ(outside(Domain::unit_square(), {1.25, -0.5, 0}), 0.5);
  EXPECT_EQ(outside(Domain::unit_square(), {0.5, 1.125, 0}), 0.125);
  EXPECT_EQ(outside(Domain::disk(2), {0, -3, 0}), 0.5);
  EXPECT_EQ(outside(Domain::triangle(), {0.75, 0.5, 0}), 0.25);
  EXPECT_EQ(outside(Domain::triangle(), {-0.25, 0.5, 0}), 0.25);
  EXPECT_EQ(outside(Domain::triangle(), {0.5, -0.25, 0}), 0.25);
  EXPECT_EQ(outside(Domain::sphere(), {0, 0, 1.5}), 0.5);
  EXPECT_EQ(outside(Domain::sphere(), {0, 0.5, 0}), 0.5);
  EXPECT_NEAR(outside(Domain::hemisphere(), {0.96, 0, -0.28}), 0.28, 1e-15);
  EXPECT_NEAR(outside(Domain::hemisphere(false), {0.96, 0, 0.28}), 0.28, 1e-15);
  EXPECT_NEAR(outside(paraboloid(), {0.5, 1, 0.5}), 0.25, 1e-15);
}

/// A point beside the domain is one of its border.
TEST(Charts, ClampWhatLiesOutside) {
  const auto inside = [](const Domain& d, const Vec3& x) { return d.chart().to_square(x); };
  EXPECT_EQ(inside(Domain::interval(-2, 5), {-3, 0, 0}), (Point2{0, 0.5}));
  EXPECT_EQ(inside(Domain::interval(-2, 5), {6, 0, 0}), (Point2{1, 0.5}));
  EXPECT_EQ(inside(Domain::half_line(1), {-0.5, 0, 0}), (Point2{0, 0.5}));
  EXPECT_EQ(inside(Domain::unit_square(), {-1, 2, 0}), (Point2{0, 1}));
  EXPECT_EQ(inside(Domain::disk(2), {0, 3, 0}), (Point2{1, 0.25}));
  EXPECT_EQ(inside(Domain::triangle(), {0, 0, 0}), (Point2{0, 0.5}));
  EXPECT_EQ(inside(Domain::triangle(), {0, 2, 0}), (Point2{1, 1}));
  EXPECT_EQ(inside(Domain::hemisphere(), {0.6, 0, -0.8})[0], 1);
  EXPECT_EQ(inside(Domain::hemisphere(false), {0.6, 0, 0.8})[0], 0);
}

/// Where a density may jump: between the pixels of a map, once each.
TEST(Domains, KnowTheirLines) {
  using Lines = std::vector<double>;
  const Domain map = Domain::equirectangular(4, 2, {0, 0, 1}, {1, 0, 0});
  EXPECT_EQ(map.breaks()[0], (Lines{0.5}));
  EXPECT_EQ(map.breaks()[1], (Lines{0.25, 0.5, 0.75}));
  const Domain octahedral = Domain::octahedral(4);
  EXPECT_EQ(octahedral.breaks()[0], (Lines{0.25, 0.5, 0.75}));
  EXPECT_EQ(octahedral.breaks()[1], (Lines{0.25, 0.5, 0.75}));
  EXPECT_EQ(Domain::octahedral(1).breaks()[0], (Lines{0.5}));
  EXPECT_EQ(Domain::sphere().breaks()[0], (Lines{0.5}));
  EXPECT_EQ(Domain::unit_square().with_breaks({0.5, 0.2}, {0.3}).with_breaks({0.2}).breaks()[0],
            (Lines{0.2, 0.5}));
}

TEST(Domains, RefuseSizesThatAreNone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double size : {0.0, -1.0, kNan})
    EXPECT_THROW(Domain::disk(size), std::invalid_argument);
  EXPECT_THROW(Domain::interval(1, 1), std::invalid_argument);
  EXPECT_THROW(Domain::discrete(0), std::invalid_argument);
  EXPECT_THROW(Domain::octahedral(0), std::invalid_argument);
  EXPECT_THROW(Domain::equirectangular(0, 1, {0, 0, 1}, {1, 0, 0}), std::invalid_argument);
  EXPECT_THROW(Domain::equirectangular(1, 0, {0, 0, 1}, {1, 0, 0}), std::invalid_argument);
  EXPECT_THROW(Domain::equirectangular(1, 1, {0, 0, 2}, {1, 0, 0}), std::invalid_argument);
  EXPECT_THROW(Domain::equirectangular(1, 1, {0, 0, 1}, {2, 0, 0}), std::invalid_argument);
  EXPECT_THROW(Domain::equirectangular(1, 1, {0, 0, 1}, {0.6, 0, 0.8}), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::verify
