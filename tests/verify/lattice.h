#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <plumbline/verify/detail/vector_access.h>

/// Points that are spread evenly and are the same in every run: what is worked out at them needs no
/// seed.
namespace plumbline::verify {

/// In the unit square, none on its border. @source Roberts 2018, "The unreasonable effectiveness of
/// quasirandom sequences": multiples of the inverse of the plastic number and of its square
inline std::vector<Point2> even_points(int count) {
  std::vector<Point2> points;
  for (int i = 1; i <= count; ++i) {
    const double a = i * 0.7548776662466927, b = i * 0.5698402909980532;
    points.push_back({a - std::floor(a), b - std::floor(b)});
  }
  return points;
}

/// Unit vectors, evenly over the sphere, or over what lies above the horizon.
inline std::vector<Vec3> even_directions(int count, bool whole_sphere) {
  std::vector<Vec3> directions;
  for (const Point2& p : even_points(count)) {
    const double z = whole_sphere ? 2 * p[0] - 1 : p[0], r = std::sqrt(1 - z * z);
    const double phi = 2 * std::numbers::pi * p[1];
    directions.push_back({r * std::cos(phi), r * std::sin(phi), z});
  }
  return directions;
}

}  // namespace plumbline::verify
