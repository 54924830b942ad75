#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <plumbline/renderer/bsdf/bsdf.h>
#include <plumbline/renderer/light/light.h>
#include <plumbline/renderer/math.h>
#include <plumbline/renderer/scene/camera.h>
#include <plumbline/renderer/scene/description.h>
#include <plumbline/renderer/scene/lanes.h>
#include <plumbline/renderer/scene/ray.h>

struct RTCSceneTy;  // Embree's, so that its header stays out of this one

namespace plumbline::renderer {

inline constexpr std::uint32_t kNoLight = std::numeric_limits<std::uint32_t>::max();

/// A point on a surface. Coordinates are relative to the scene's centre.
struct SurfaceHit {
  Vec3f position;       ///< on the surface to the last bit that float has
  Vec3f normal;         ///< unit, of the front side
  float offset;         ///< distance from the surface at which rays may start [m]
  std::uint32_t bsdf;   ///< index for Scene::bsdf
  std::uint32_t light;  ///< index into Scene::lights, or kNoLight where the side hit is dark

  /// Where rays that leave towards the side of `w` start.
  Vec3f origin_towards(const Vec3f& w) const {
    return position + normal * (dot(normal, w) >= 0 ? offset : -offset);
  }

  Ray ray_along(const Vec3f& direction) const { return {origin_towards(direction), direction}; }
};

class SceneGeometry;

/// A scene ready for rays: Embree's acceleration structure, BSDFs, lights and the camera.
///
/// All geometry is moved in double so that the centre of its bounding box is the origin, and only
/// then rounded to float: a scene at 1e5 keeps the digits that it would otherwise lose.
class Scene {
 public:
  /// @throws InputError if the description holds no camera-visible geometry that Embree can build
  explicit Scene(const SceneDescription& description);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// @return nearest surface along the ray, from either side; nullopt where it escapes
  std::optional<SurfaceHit> intersect(const Ray& ray) const;

  /// @return whether anything lies on the ray before t_max
  bool occluded(const Ray& ray) const;

  /// The same for the rays order[0] … order[count − 1], sixteen at a time: fastest where neighbours
  /// in that order point alike. Results stand in that order too; `blocked` is 1 or 0.
  void intersect(const RayLanes& rays, const IndexLanes& order, std::size_t count,
                 HitLanes& hits) const;
  void occluded(const RayLanes& rays, const Lanes<float>& t_max, const IndexLanes& order,
                std::size_t count, Lanes<std::uint8_t>& blocked) const;

  BsdfRef bsdf(std::uint32_t index) const { return {bsdfs_, index}; }
  const BsdfSet& bsdfs() const { return bsdfs_; }
  const LightSet& lights() const { return lights_; }
  /// Index of the environment in lights(), or kNoLight.
  std::uint32_t environment() const { return environment_; }
  const Camera& camera() const { return camera_; }
  std::size_t shape_count() const { return shape_count_; }

  /// Embree's handle (an RTCScene), for benchmarks that ask it directly.
  RTCSceneTy* embree_scene() const;

 private:
  std::unique_ptr<SceneGeometry> geometry_;
  BsdfSet bsdfs_;
  LightSet lights_;
  std::uint32_t environment_ = kNoLight;
  Camera camera_;
  std::size_t shape_count_ = 0;
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
