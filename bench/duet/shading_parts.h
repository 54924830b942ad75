#pragma once

#include <vector>

#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/core/sampling/warps.h>

#include "parts.h"

namespace plumbline::duet {

/// Directions and numbers that no branch predictor learns by heart.
struct Inputs {
  std::vector<renderer::Vec3f> wo, wi;
  std::vector<renderer::Vec2f> u;

  explicit Inputs(Size size) {
    renderer::Pcg32 random(1, 0, 0);
    for (int i = 0; i < (size == Size::timed ? 2048 : 64); ++i) {
      wo.push_back(renderer::square_to_uniform_hemisphere(random.next_2d()));
      wi.push_back(renderer::square_to_uniform_hemisphere(random.next_2d()));
      u.push_back(random.next_2d());
    }
  }
};

}  // namespace plumbline::duet
