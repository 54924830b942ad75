#include <plumbline/renderer/core/scene/scene.h>

#include <utility>

#include <plumbline/renderer/core/scene/geometry.h>

namespace plumbline::renderer {

Scene::Scene(SceneParts parts) : parts_(std::move(parts)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

std::optional<SurfaceHit> Scene::intersect(const Ray& ray) const {
  return parts_.geometry->intersect(ray);
}

bool Scene::occluded(const Ray& ray) const { return parts_.geometry->occluded(ray); }

}  // namespace plumbline::renderer
