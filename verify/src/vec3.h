#pragma once

#include <cmath>

#include <plumbline/verify/detail/vector_access.h>

namespace plumbline::verify {

inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double length(const Vec3& a) { return std::hypot(a[0], a[1], a[2]); }

inline Vec3 scaled(const Vec3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

inline Vec3 sum(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

inline Vec3 normalized(const Vec3& a) { return scaled(a, 1 / length(a)); }

/// @param axis   unit
/// @param angle  [rad]
inline Vec3 turned_around(const Vec3& x, const Vec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return sum(sum(scaled(x, c), scaled(cross(axis, x), s)), scaled(axis, dot(axis, x) * (1 - c)));
}

}  // namespace plumbline::verify
