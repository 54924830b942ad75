#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

/// Comparisons of the renderer's core with constants, each tried at its place, at the number before
/// it and at the one after. The rows of the files *_thresholds_test.cpp are the list; held
/// elsewhere are
///
/// - scene/geometry.h kNearest and ray offsets: renderer/self_intersection_test.cpp
/// - bsdf/reflectance_table.h kTolerance: bsdf/stability_test.cpp, float against quad precision
/// - sampling/discrete.cpp, a unit for every positive weight: lights_test.cpp
/// - light/triangle_light.h, rounding at an edge: lights_test.cpp, renderer/light_test.cpp
/// - render/path.cpp depth >= rr_depth: path_choice_test.cpp
/// - loop/render_loop.cpp passes and kSamplesPerTile, which may not show: renderer/render_test
/// - clamps to 1 and 0 of what rounding exceeds them by, which have no other side to be on.
namespace plumbline::tests {

/// A comparison, and what must hold on its sides.
struct Threshold {
  std::string where;            ///< "light/sphere_light.h d > r, pdf along the axis"
  std::array<double, 3> tried;  ///< just below, at, just above
  std::function<double(double)> value;
  std::array<double, 3> expected;  ///< three alike where the comparison must not show
  double tolerance = 0;            ///< absolute
};

/// The floats around a place. A test of doubles takes `double_around`.
inline std::array<double, 3> float_around(double at) {
  const auto x = static_cast<float>(at);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return {double{std::nextafter(x, -kInfinity)}, double{x}, double{std::nextafter(x, kInfinity)}};
}

inline std::array<double, 3> double_around(double at) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {std::nextafter(at, -kInfinity), at, std::nextafter(at, kInfinity)};
}

inline std::array<double, 3> thrice(double value) { return {value, value, value}; }

inline void expect_holds(const Threshold& threshold) {
  constexpr std::array kSides{"just below", "at", "just above"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(threshold.value(threshold.tried[i]), threshold.expected[i], threshold.tolerance)
        << threshold.where << ", " << kSides[i];
  }
}

inline void expect_all_hold(const std::vector<Threshold>& thresholds) {
  for (const Threshold& threshold : thresholds) expect_holds(threshold);
}

}  // namespace plumbline::tests
