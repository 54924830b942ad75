#pragma once

#include <cmath>
#include <numbers>

#include <plumbline/verify/detail/domain.h>

namespace plumbline::tests {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Unit vector at an angle [degrees] from the normal, z, on the side that it points to or behind.
///
/// @param azimuth  [rad]
inline verify::Vec3 direction_at(double degrees, double azimuth, bool front = true) {
  const double theta = radians(degrees), sine = std::sin(theta);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth),
          front ? std::cos(theta) : -std::cos(theta)};
}

}  // namespace plumbline::tests
