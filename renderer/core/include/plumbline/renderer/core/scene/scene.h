#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_table.h>
#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/scene/camera.h>
#include <plumbline/renderer/core/scene/surface_hit.h>

namespace plumbline::renderer {

class SceneGeometry;

/// What a scene is made of; see assembly's make_scene.
struct SceneParts {
  std::unique_ptr<SceneGeometry> geometry;  ///< built
  std::shared_ptr<const BsdfTable> bsdfs;
  LightSet lights;
  std::uint32_t environment = kNoLight;  ///< index in `lights`
  Camera camera;
  std::size_t shape_count = 0;  ///< as the user counts them
};

/// A scene ready for rays: Embree's acceleration structure, BSDFs, lights and the camera.
class Scene {
 public:
  explicit Scene(SceneParts parts);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// @return nearest surface along the ray, from either side; nullopt where it escapes
  std::optional<SurfaceHit> intersect(const Ray& ray) const;

  /// @return whether anything lies on the ray before t_max
  bool occluded(const Ray& ray) const;

  const BsdfTable& bsdfs() const { return *parts_.bsdfs; }
  const LightSet& lights() const { return parts_.lights; }
  /// Index of the environment in lights(), or kNoLight.
  std::uint32_t environment() const { return parts_.environment; }
  const Camera& camera() const { return parts_.camera; }
  std::size_t shape_count() const { return parts_.shape_count; }

  /// The surfaces, for those who trace many rays at once or ask Embree directly.
  const SceneGeometry& geometry() const { return *parts_.geometry; }

 private:
  SceneParts parts_;
};

}  // namespace plumbline::renderer
