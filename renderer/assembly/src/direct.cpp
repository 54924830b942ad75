#include <plumbline/renderer/assembly/direct.h>

#include <optional>

#include <plumbline/renderer/core/render/vertex.h>

namespace plumbline::renderer {

DirectSample sample_direct_light(const Scene& scene, const Ray& ray, std::size_t technique,
                                 const Vec2f& u, PathCounters& counters) {
  ++counters.camera_rays;
  const auto hit = scene.intersect(ray);
  DirectSample result;
  result.emission = emission_seen(scene, hit, ray.direction).radiance;
  if (!hit) return result;
  const Vertex vertex(*hit, ray.direction);
  if (technique == kLightTechnique) {
    if (!scene.bsdfs().parts(hit->bsdf).density) return result;
    const auto draw = draw_light(scene, vertex, u, counters);
    if (draw) return {result.emission, draw->estimate(1), draw->pdf, draw->other_pdf};
    return result;
  }
  const auto next = draw_bsdf(scene, vertex, u, counters);
  if (!next || is_black(next->weight)) return result;
  ++counters.bounce_rays;
  const Ray bounce = vertex.ray_along(next->wi);
  const Emission found = emission_seen(scene, scene.intersect(bounce), bounce.direction);
  if (found.light == kNoLight) return result;
  result.value = next->weight * found.radiance;
  result.pdf = next->is_atom() ? next->mass : next->pdf_w;
  if (next->is_atom()) return result;  // no point on a light is chosen to lie just there
  result.other_pdf = scene.lights().pdf_at_hit(found.light, hit->position, bounce.direction);
  return result;
}

}  // namespace plumbline::renderer
