#include <plumbline/renderer/render/direct.h>

#include <cmath>
#include <optional>

namespace plumbline::renderer {
namespace {

class DirectLight {
 public:
  DirectLight(const Scene& scene, PathCounters& counters) : scene_(scene), counters_(counters) {}

  DirectSample sample(const Ray& ray, std::size_t technique, float u_light, const Vec2f& u) {
    ++counters_.camera_rays;
    const auto hit = scene_.intersect(ray);
    DirectSample result;
    result.emission = emission(hit, ray.direction).radiance;
    if (!hit) return result;
    const Surface surface{*hit, scene_.bsdf(hit->bsdf), Frame<float>(hit->normal), -ray.direction};
    if (technique == kBsdfTechnique) {
      sample_bsdf(surface, u, result);
    } else if (surface.bsdf.parts().density) {
      sample_light(surface, u_light, u, result);
    }
    return result;
  }

 private:
  struct Surface {
    const SurfaceHit& hit;
    BsdfRef bsdf;
    Frame<float> frame;
    Vec3f wo;  // world space
  };

  struct Emission {
    std::uint32_t light = kNoLight;
    Rgbf radiance;
  };

  /// Of what a ray ends on, if it shows its emitting side.
  Emission emission(const std::optional<SurfaceHit>& hit, const Vec3f& direction) const {
    const std::uint32_t light = !hit                              ? scene_.environment()
                                : dot(hit->normal, direction) < 0 ? hit->light
                                                                  : kNoLight;
    if (light == kNoLight) return {};
    return {light, renderer::radiance(scene_.lights()[light], direction)};
  }

  void sample_bsdf(const Surface& surface, const Vec2f& u, DirectSample& result) {
    const auto next = surface.bsdf.sample(surface.frame.to_local(surface.wo), u);
    if (!next) ++counters_.rejected;
    if (!next || is_black(next->weight)) return;
    const Vec3f direction = surface.frame.to_world(next->wi);
    ++counters_.bounce_rays;
    const auto hit = scene_.intersect({surface.hit.origin_towards(direction), direction});
    const Emission found = emission(hit, direction);
    if (found.light == kNoLight) return;
    result.value = next->weight * found.radiance;
    result.pdf = next->is_atom() ? next->mass : next->pdf_w;
    if (next->is_atom()) return;  // no point on a light is chosen to lie just there
    result.other_pdf = scene_.lights().pdf(found.light, surface.hit.position, direction);
  }

  void sample_light(const Surface& surface, float u_light, const Vec2f& u, DirectSample& result) {
    const auto light = scene_.lights().sample(surface.hit.position, u_light, u);
    if (!light) {
      ++counters_.rejected;
      return;
    }
    const Vec3f wo = surface.frame.to_local(surface.wo);
    const Vec3f wi = surface.frame.to_local(light->wi);
    const Rgbf f = surface.bsdf.eval(wo, wi);
    if (is_black(f)) return;
    ++counters_.shadow_rays;
    const Ray ray = shadow_ray(surface.hit, *light);
    if (ray.t_max > 0 && scene_.occluded(ray)) return;
    result.pdf = light->is_atom() ? light->mass : light->pdf_w;
    result.value = f * light->radiance * (std::abs(wi.z) / result.pdf);
    if (light->is_atom()) return;  // no direction of the BSDF finds it
    result.other_pdf = surface.bsdf.pdf(wo, wi);
  }

  const Scene& scene_;
  PathCounters& counters_;
};

}  // namespace

DirectSample sample_direct_light(const Scene& scene, const Ray& ray, std::size_t technique,
                                 float u_light, const Vec2f& u, PathCounters& counters) {
  return DirectLight(scene, counters).sample(ray, technique, u_light, u);
}

}  // namespace plumbline::renderer
