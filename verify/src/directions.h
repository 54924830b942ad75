#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/pair.h>

namespace plumbline::verify {

/// Uniform on the sphere.
inline Vec3 uniform_direction(Random& random) {
  const double z = 1 - 2 * random.uniform(), phi = 2 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace plumbline::verify
