#include <plumbline/renderer/render/direct.h>

#include <cmath>
#include <optional>

#include "vertex.h"

namespace plumbline::renderer {
namespace {

class DirectLight {
 public:
  DirectLight(const Scene& scene, PathCounters& counters) : scene_(scene), counters_(counters) {}

  DirectSample sample(const Ray& ray, std::size_t technique, const Vec2f& u) {
    ++counters_.camera_rays;
    const auto hit = scene_.intersect(ray);
    DirectSample result;
    result.emission = emission(hit, ray.direction).radiance;
    if (!hit) return result;
    const Vertex vertex(scene_, *hit, ray.direction);
    if (technique == kBsdfTechnique) {
      sample_bsdf(vertex, u, result);
    } else if (vertex.bsdf.parts().density) {
      sample_light(vertex, u, result);
    }
    return result;
  }

 private:
  struct Emission {
    std::uint32_t light = kNoLight;
    Rgbf radiance;
  };

  Emission emission(const std::optional<SurfaceHit>& hit, const Vec3f& direction) const {
    const std::uint32_t light = light_seen(scene_, hit);
    if (light == kNoLight) return {};
    return {light, renderer::radiance(scene_.lights()[light], direction)};
  }

  void sample_bsdf(const Vertex& vertex, const Vec2f& u, DirectSample& result) {
    const auto next = vertex.bsdf.sample(vertex.wo, u);
    if (!next) ++counters_.rejected;
    if (!next || is_black(next->weight)) return;
    ++counters_.bounce_rays;
    const Ray ray = vertex.ray_along(next->wi);
    const Emission found = emission(scene_.intersect(ray), ray.direction);
    if (found.light == kNoLight) return;
    result.value = next->weight * found.radiance;
    result.pdf = next->is_atom() ? next->mass : next->pdf_w;
    if (next->is_atom()) return;  // no point on a light is chosen to lie just there
    result.other_pdf = scene_.lights().pdf_at_hit(found.light, vertex.hit.position, ray.direction);
  }

  void sample_light(const Vertex& vertex, const Vec2f& u, DirectSample& result) {
    const auto light = scene_.lights().sample(vertex.hit.position, u);
    if (!light) {
      ++counters_.rejected;
      return;
    }
    const Vec3f wi = vertex.frame.to_local(light->wi);
    const BsdfValue<float> bsdf = vertex.bsdf.evaluate(vertex.wo, wi);
    if (is_black(bsdf.f) || !is_visible(scene_, vertex.hit, *light, counters_)) return;
    result.pdf = light->is_atom() ? light->mass : light->pdf_w;
    result.value = bsdf.f * light->radiance * (std::abs(wi.z) / result.pdf);
    if (light->is_atom()) return;  // no direction of the BSDF finds it
    result.other_pdf = bsdf.pdf_w;
  }

  const Scene& scene_;
  PathCounters& counters_;
};

}  // namespace

DirectSample sample_direct_light(const Scene& scene, const Ray& ray, std::size_t technique,
                                 const Vec2f& u, PathCounters& counters) {
  return DirectLight(scene, counters).sample(ray, technique, u);
}

}  // namespace plumbline::renderer
