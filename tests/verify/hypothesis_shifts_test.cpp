#include "diagnosis/shifts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "moved_arguments.h"

/// A function that is asked a cell, a row or half of one beside is named by that.
namespace plumbline::verify {
namespace {

TEST(Shifts, ByACellAreNamed) {
  const OfPoint wave = [](const Vec3& x) {
    return 2 + std::sin(2 * std::numbers::pi * x[0]) + 0.3 * x[1];
  };
  const auto named = [&](const Domain& domain, const OfPoint& samples) {
    return said_of_moved_points(domain, wave, samples).words;
  };
  const Domain square = Domain::unit_square();
  EXPECT_EQ(named(square,
                  [&](auto& x) {
                    return wave({std::fmod(x[0] + 1 / 16.0, 1), x[1], 0});
                  }),
            "pdf() is that of samples moved by 0.0625 of the first extent (a cell or half of one)");
  EXPECT_EQ(named(square,
                  [&](auto& x) {
                    return wave({x[0], std::fmod(x[1] + 0.75, 1), 0});
                  }),
            "pdf() is that of samples moved by -0.25 of the second extent (a cell or half of one)");
  EXPECT_EQ(named(square,
                  [&](auto& x) {
                    return wave({std::fmod(x[0] + 0.1, 1), std::fmod(x[1] + 0.9, 1), 0});
                  }),
            "pdf() is that of samples moved by 0.1 of the extents, along the diagonal (a cell or "
            "half of one)");
  EXPECT_EQ(named(Domain::interval(0, 1),
                  [&](auto& x) {
                    return wave({x[0] + 0.02, 0, 0});
                  }),
            "pdf() is that of samples moved by 0.02 of the interval (a cell or half of one)");
  // A shift that is none of a cell.
  EXPECT_EQ(named(square, [&](auto& x) { return wave({x[0] + 0.0173, x[1], 0}); }), "");
}

/// Of a map of directions: columns are turned around its pole, rows lie along the latitudes.
TEST(Shifts, OnAMapAreNamed) {
  const auto named = [](const OfPoint& samples) {
    SeenRatios seen(Domain::sphere(), lopsided, even_directions(kRatiosPerView, true),
                    [&](const Vec3& x) { return samples(x) / lopsided(x); });
    return simplest(Observations::of_density(seen.evidence()),
                    shift_hypotheses(seen.evidence(), of_pdf(), false));
  };
  EXPECT_EQ(named([](auto& x) { return lopsided(turned_by(x, 360 / 64.0)); }).words,
            "pdf() is that of directions turned by 0.015625 of a turn around the z axis (a column "
            "or half of one)");
  const auto lower = [](const Vec3& x, double by) {
    const double theta = std::acos(x[2]) + by, phi = std::atan2(x[1], x[0]);
    return Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  };
  const std::string row =
      "pdf() is that of directions moved by 0.03125 of the latitudes around the z axis (a row or "
      "half of one)";
  const auto inside = [](const Vec3& x, double by) {
    return std::acos(x[2]) + by < std::numbers::pi;
  };
  const Said density = named([&](auto& x) {
    return inside(x, std::numbers::pi / 32) ? lopsided(lower(x, std::numbers::pi / 32)) : 1.0;
  });
  EXPECT_EQ(density.words, row);
  // As a table's: the density per direction has the sine of where it is looked up.
  const Said table = named([&](auto& x) {
    const Vec3 there = lower(x, std::numbers::pi / 32);
    const double sines = std::sqrt((1 - there[2] * there[2]) / (1 - x[2] * x[2]));
    return inside(x, std::numbers::pi / 32) ? lopsided(there) * sines : 1.0;
  });
  EXPECT_EQ(table.words, row);
  EXPECT_NEAR(table.cost - density.cost, 0.1, 1e-12);
  // sinθ of the middle of a row for that of the direction, and the reverse.
  const auto middle = [](const Vec3& x) {
    const double theta = std::acos(x[2]);
    return std::sin((std::floor(theta / std::numbers::pi * 8) + 0.5) * std::numbers::pi / 8) /
           std::sin(theta);
  };
  EXPECT_EQ(named([&](auto& x) { return lopsided(x) * middle(x); }).words,
            "pdf() has sinθ of the direction where samples have that of the middle of a row (8 "
            "rows)");
  EXPECT_EQ(named([&](auto& x) { return lopsided(x) / middle(x); }).words,
            "pdf() has sinθ of the middle of a row where samples have that of the direction (8 "
            "rows)");
}

}  // namespace
}  // namespace plumbline::verify
