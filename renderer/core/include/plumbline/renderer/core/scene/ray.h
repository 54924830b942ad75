#pragma once

#include <limits>

#include <plumbline/renderer/core/math.h>

namespace plumbline::renderer {

/// origin + t·direction for t in (0, t_max); direction is unit, so t is a distance [m].
struct Ray {
  Vec3f origin;
  Vec3f direction;
  float t_max = std::numeric_limits<float>::infinity();
};

}  // namespace plumbline::renderer
