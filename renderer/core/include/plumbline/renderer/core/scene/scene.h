#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_table.h>
#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/scene/camera.h>
#include <plumbline/renderer/core/scene/description.h>
#include <plumbline/renderer/core/scene/surface_hit.h>

namespace plumbline::renderer {

class SceneGeometry;

/// A scene ready for rays: Embree's acceleration structure, BSDFs, lights and the camera.
///
/// All geometry is moved in double so that the centre of its bounding box is the origin, and only
/// then rounded to float: a scene at 1e5 keeps the digits that it would otherwise lose.
class Scene {
 public:
  /// @throws InputError where Embree refuses the geometry, std::invalid_argument without BSDFs
  explicit Scene(const SceneDescription& description);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// @return nearest surface along the ray, from either side; nullopt where it escapes
  std::optional<SurfaceHit> intersect(const Ray& ray) const;

  /// @return whether anything lies on the ray before t_max
  bool occluded(const Ray& ray) const;

  const BsdfTable& bsdfs() const { return *bsdfs_; }
  const LightSet& lights() const { return lights_; }
  /// Index of the environment in lights(), or kNoLight.
  std::uint32_t environment() const { return environment_; }
  const Camera& camera() const { return camera_; }
  std::size_t shape_count() const { return shape_count_; }

  /// The surfaces, for those who trace many rays at once or ask Embree directly.
  const SceneGeometry& geometry() const { return *geometry_; }

 private:
  std::unique_ptr<SceneGeometry> geometry_;
  std::shared_ptr<const BsdfTable> bsdfs_;
  LightSet lights_;
  std::uint32_t environment_ = kNoLight;
  Camera camera_;
  std::size_t shape_count_ = 0;
};

}  // namespace plumbline::renderer
