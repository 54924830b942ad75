#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <plumbline/renderer/core/light/light_sample.h>
#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/scene/ray.h>

namespace plumbline::renderer {

inline constexpr std::uint32_t kNoLight = std::numeric_limits<std::uint32_t>::max();

/// A point on a surface. Coordinates are relative to the scene's centre.
struct SurfaceHit {
  Vec3f position;       ///< on the surface to the last bit that float has
  Vec3f normal;         ///< unit, of the front side
  float offset;         ///< distance from the surface at which rays may start [m]
  std::uint32_t bsdf;   ///< index into Scene::bsdfs()
  std::uint32_t light;  ///< index into Scene::lights(), or kNoLight where the side hit is dark

  /// Where rays that leave towards the side of `w` start.
  Vec3f origin_towards(const Vec3f& w) const {
    return position + normal * (dot(normal, w) >= 0 ? offset : -offset);
  }

  Ray ray_along(const Vec3f& direction) const { return {origin_towards(direction), direction}; }
};

/// How far from a surface point rays must start so that they neither hit the surface again nor skip
/// what lies close before it: 16 units of float rounding of `magnitude`, the largest coordinate
/// that enters the point's own rounding error.
inline float ray_offset(float magnitude) { return 16 * 0x1p-24f * magnitude; }

/// Largest absolute coordinate.
inline float max_norm(const Vec3f& v) {
  return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

/// The ray that asks whether a light sampled from `hit.position` is visible from there. It stops at
/// the plane one ray offset before the light, so that the light does not shadow itself.
///
/// @return t_max ≤ 0 where nothing can lie between
inline Ray shadow_ray(const SurfaceHit& hit, const LightSample<float>& light) {
  Ray ray = hit.ray_along(light.wi);
  if (std::isfinite(light.distance)) {
    const Vec3f end = hit.position + light.wi * light.distance;
    // One offset before the light, and the start is up to one offset nearer to it than the point
    // that the distance counts from; along the ray both are longer by 1/cosθ.
    const float light_offset = ray_offset(std::max(max_norm(end), max_norm(hit.position)));
    ray.t_max = light.distance - (light_offset + hit.offset) / light.cos_light;
  }
  return ray;
}

}  // namespace plumbline::renderer
