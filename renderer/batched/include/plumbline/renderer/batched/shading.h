#pragma once

#include <cstddef>
#include <cstdint>

#include <plumbline/renderer/batched/lanes.h>

namespace plumbline::renderer {

/// Vertices side by side, those of one BSDF and one light together.
struct Shading {
  std::size_t count = 0;
  IndexLanes light, path;
  Vec3Lanes position, normal, wo;  // wo is local
  Lanes<float> offset;
  RgbLanes throughput;
  Lanes<float> scale;  // what refractions alone made of the throughput
  Lanes<float> u, v;   // uniform numbers of the sample that is made next
  Lanes<float> pmf;    // of the light
  RayLanes shadow;     // its direction is world, towards the light
  Lanes<float> distance, cos_light, pdf_light, mass;  // both 0: no light sample
  RgbLanes radiance, f;
  Lanes<float> cosine, pdf_bsdf;  // of shadow.direction
  RgbLanes contribution;
  Lanes<float> shadow_t_max;
  IndexLanes shadow_bin;    // octant of a ray to be cast, or bin_of what stands for it
  Vec3Lanes wi;             // local
  RgbLanes weight;          // of the BSDF sample; black: none
  Lanes<float> pdf_w;       // of a density
  Lanes<float> atom_mass;   // of an atom; 0 for a density
  Lanes<float> refraction;  // radiance_scale of the sample
  RayLanes next;
  IndexLanes next_bin;  // likewise
};

/// Why a ray is not cast.
enum class Uncast : std::uint32_t {
  unblocked,  ///< nothing can stand in the way of its light
  dropped     ///< nothing comes of it
};

/// Rays are sorted into bins: those to be cast by octant, and behind them those that are not.
inline constexpr std::uint32_t bin_of(Uncast why) {
  return kOctants + static_cast<std::uint32_t>(why);
}
inline constexpr std::uint32_t kBins = kOctants + 2;

/// Each works on the vertices [first, end), which are of one BSDF or of one light.
struct Run {
  std::size_t first, end;
};

}  // namespace plumbline::renderer
