#pragma once

#include <cstdint>
#include <limits>

#include <plumbline/renderer/core/mis/heuristics.h>
#include <plumbline/renderer/core/render/strategy.h>
#include <plumbline/renderer/core/sampling/sampler.h>
#include <plumbline/renderer/core/scene/scene.h>

namespace plumbline::renderer {

struct PathOptions {
  Strategy strategy = Strategy::mis;
  Weighting heuristic = Heuristic::power;
  /// As in Mitsuba: 1 is directly visible emission, 2 adds direct light, −1 no limit.
  int max_depth = -1;
  int rr_depth = 5;  ///< Russian roulette from this depth on, > 0; kNoRoulette turns it off
  /// Of `mis`, at the first vertex: samples n ≥ 0 of each technique, not both 0, which together
  /// must find all light. Later vertices take one of each.
  int bsdf_samples = 1, light_samples = 1;
  float light_probability = 0.5f;  ///< of `one_sample`: that of the light, in (0, 1)
};

inline constexpr int kNoRoulette = std::numeric_limits<int>::max();

/// What a set of paths cost and lost.
struct PathCounters {
  std::uint64_t camera_rays = 0;
  std::uint64_t bounce_rays = 0;  ///< rays that look for the nearest surface after the first vertex
  std::uint64_t shadow_rays = 0;  ///< also those too short to be cast, to a light in contact
  std::uint64_t rejected = 0;     ///< samples that a BSDF or light could not make

  PathCounters& operator+=(const PathCounters& other);
};

/// Estimate of the radiance that arrives along a camera ray, by one path.
///
/// @param ray  from Camera::ray
/// @return     RGB radiance [W/(m² sr)]; its expected value is the truth (truncated at max_depth)
///             for every strategy with sufficient support
/// @source     Veach 1997, Section 9.2 (multi-sample and one-sample model); the order of the loop
///             from RayON's
Rgbf estimate_radiance(const Scene& scene, const PathOptions& options, Ray ray, Sampler& random,
                       PathCounters& counters);

}  // namespace plumbline::renderer
