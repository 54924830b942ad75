#pragma once

#include <cstdint>
#include <optional>

#include <plumbline/renderer/render/path.h>
#include <plumbline/renderer/scene/scene.h>

/// What every way of gathering light at a surface point shares.
namespace plumbline::renderer {

/// A surface point that light is gathered at.
struct Vertex {
  SurfaceHit hit;
  BsdfRef bsdf;
  Frame<float> frame;
  Vec3f wo;  ///< local

  /// @param direction  of the ray that ended here
  Vertex(const Scene& scene, const SurfaceHit& surface, const Vec3f& direction)
      : hit(surface),
        bsdf(scene.bsdf(surface.bsdf)),
        frame(surface.normal),
        wo(frame.to_local(-direction)) {}

  /// @param wi  local
  Ray ray_along(const Vec3f& wi) const { return hit.ray_along(frame.to_world(wi)); }
};

/// The light that a ray ends on, if it shows its emitting side; else kNoLight.
inline std::uint32_t light_seen(const Scene& scene, const std::optional<SurfaceHit>& hit,
                                const Vec3f& direction) {
  if (!hit) return scene.environment();
  return dot(hit->normal, direction) < 0 ? hit->light : kNoLight;
}

inline bool is_visible(const Scene& scene, const SurfaceHit& hit, const LightSample<float>& light,
                       PathCounters& counters) {
  ++counters.shadow_rays;
  const Ray ray = shadow_ray(hit, light);
  return !(ray.t_max > 0) || !scene.occluded(ray);
}

}  // namespace plumbline::renderer
