#include <plumbline/renderer/render/path.h>

#include <cmath>
#include <optional>

#include "vertex.h"

namespace plumbline::renderer {
namespace {

Techniques counts(int bsdf, int light) {
  return {.n_bsdf = static_cast<float>(bsdf),
          .n_light = static_cast<float>(light),
          .draw_bsdf = bsdf,
          .draw_light = light};
}

Techniques choose_techniques(const PathOptions& options, int depth, Sampler& random) {
  switch (options.strategy) {
    case Strategy::bsdf:
      return counts(1, 0);
    case Strategy::light:
      return counts(0, 1);
    case Strategy::uniform:
      return {.draw_uniform = true};
    case Strategy::mis:
      return depth == 1 ? counts(options.bsdf_samples, options.light_samples) : counts(1, 1);
    case Strategy::one_sample: {
      const float c = options.light_probability;
      const bool light = random.next_1d() < c;
      return {.n_bsdf = 1 - c, .n_light = c, .draw_bsdf = !light, .draw_light = light};
    }
    case Strategy::average:
      return counts(1, 1);
  }
  return {};
}

class Path {
 public:
  Path(const Scene& scene, const PathOptions& options, Sampler& random, PathCounters& counters)
      : scene_(scene), options_(options), random_(random), counters_(counters) {}

  Rgbf trace(Ray ray) {
    Rgbf result;
    Rgbf throughput{1, 1, 1};
    float radiance_scale = 1;        // what refractions alone made of the throughput
    std::optional<Arrival> arrival;  // none for the camera ray: its emission counts fully
    for (int depth = 1; within(depth); ++depth) {
      ++(arrival ? counters_.bounce_rays : counters_.camera_rays);
      const std::optional<SurfaceHit> hit = scene_.intersect(ray);
      result += throughput * emission(hit, ray.direction, arrival);
      if (!hit || !within(depth + 1)) break;

      const Vertex vertex(scene_, *hit, ray.direction);
      const BsdfParts& parts = vertex.bsdf.parts();
      const Techniques techniques = choose_techniques(options_, depth, random_);
      for (int i = 0; parts.density && i < techniques.draw_light; ++i) {
        result += throughput * light_estimate(vertex, techniques);
      }
      for (int i = 1; i < techniques.draw_bsdf; ++i) {
        result += throughput * bsdf_estimate(vertex, techniques);
      }
      if (techniques.draw_uniform && parts.density) {
        result += throughput * uniform_estimate(vertex);
      }
      // Nothing left that the continued path could find.
      if (techniques.draw_bsdf == 0 && !parts.atoms && !within(depth + 2)) break;

      const auto next = vertex.bsdf.sample(vertex.wo, random_.next_2d());
      if (!next) {
        ++counters_.rejected;
        break;
      }
      throughput = throughput * next->weight;
      radiance_scale *= next->radiance_scale;
      if (is_black(throughput) || !survives_roulette(depth, radiance_scale, throughput)) break;
      arrival = Arrival{techniques, next->is_atom(), next->pdf_w, hit->position};
      ray = vertex.ray_along(next->wi);
    }
    return result;
  }

 private:
  bool within(int depth) const { return options_.max_depth < 0 || depth <= options_.max_depth; }

  /// Emission found by a ray, weighted against the light sample that could have found it.
  Rgbf emission(const std::optional<SurfaceHit>& hit, const Vec3f& direction,
                const std::optional<Arrival>& arrival) const {
    const std::uint32_t light = light_seen(scene_, hit);
    if (light == kNoLight) return {};
    const Rgbf radiance = renderer::radiance(scene_.lights()[light], direction);
    return arrival
               ? radiance * arrival_weight(options_, scene_.lights(), *arrival, light, direction)
               : radiance;
  }

  /// Emission found in a direction from a vertex.
  Rgbf gather(const Vertex& vertex, const Vec3f& wi, const std::optional<Arrival>& arrival) {
    ++counters_.bounce_rays;
    const Ray ray = vertex.ray_along(wi);
    return emission(scene_.intersect(ray), ray.direction, arrival);
  }

  /// Direct light by one more BSDF sample, which the path does not follow further.
  Rgbf bsdf_estimate(const Vertex& vertex, const Techniques& techniques) {
    const auto next = vertex.bsdf.sample(vertex.wo, random_.next_2d());
    if (!next) {
      ++counters_.rejected;
      return {};
    }
    return next->weight *
           gather(vertex, next->wi,
                  Arrival{techniques, next->is_atom(), next->pdf_w, vertex.hit.position});
  }

  /// Direct light by one point on a light.
  Rgbf light_estimate(const Vertex& vertex, const Techniques& t) {
    const auto light = scene_.lights().sample(vertex.hit.position, random_.next_2d());
    if (!light) {
      ++counters_.rejected;
      return {};
    }
    const Vec3f wi = vertex.frame.to_local(light->wi);
    const BsdfValue<float> bsdf = vertex.bsdf.evaluate(vertex.wo, wi);
    if (is_black(bsdf.f) || !is_visible(scene_, vertex.hit, *light, counters_)) return {};
    if (light->is_atom()) {
      return bsdf.f * light->radiance * (std::abs(wi.z) * share(options_, t.n_light) / light->mass);
    }
    const float w = technique_weight(options_, t.n_light, light->pdf_w, t.n_bsdf,
                                     t.n_bsdf > 0 ? bsdf.pdf_w : 0.0f);
    return bsdf.f * light->radiance * (std::abs(wi.z) * w / light->pdf_w);
  }

  /// Direct light by one direction uniform on the hemisphere that wo is in, or on the sphere where
  /// light passes through the surface.
  Rgbf uniform_estimate(const Vertex& vertex) {
    const bool sphere = vertex.bsdf.parts().transmission;
    const Vec2f u = random_.next_2d();
    Vec3f wi = sphere ? square_to_uniform_sphere(u) : square_to_uniform_hemisphere(u);
    const float pdf_w =
        sphere ? square_to_uniform_sphere_pdf_w(wi) : square_to_uniform_hemisphere_pdf_w(wi);
    if (vertex.wo.z < 0) wi.z = -wi.z;
    const Rgbf f = vertex.bsdf.eval(vertex.wo, wi);
    if (is_black(f)) return {};
    return f * gather(vertex, wi, std::nullopt) * (std::abs(wi.z) / pdf_w);
  }

  /// Ends paths at random and scales the survivors up, so that the mean stays.
  bool survives_roulette(int depth, float radiance_scale, Rgbf& throughput) {
    if (depth < options_.rr_depth) return true;
    const float survival = survival_probability(throughput, radiance_scale);
    if (!(random_.next_1d() < survival)) return false;
    throughput = throughput / survival;
    return true;
  }

  const Scene& scene_;
  const PathOptions& options_;
  Sampler& random_;
  PathCounters& counters_;
};

}  // namespace

PathCounters& PathCounters::operator+=(const PathCounters& other) {
  camera_rays += other.camera_rays;
  bounce_rays += other.bounce_rays;
  shadow_rays += other.shadow_rays;
  rejected += other.rejected;
  return *this;
}

Rgbf estimate_radiance(const Scene& scene, const PathOptions& options, Ray ray, Sampler& random,
                       PathCounters& counters) {
  return Path(scene, options, random, counters).trace(ray);
}

}  // namespace plumbline::renderer
