#include <plumbline/renderer/core/render/path.h>

#include <cmath>
#include <optional>

#include <plumbline/renderer/core/render/vertex.h>

namespace plumbline::renderer {
namespace {

Techniques choose_techniques(const PathOptions& options, int depth, Sampler& random) {
  switch (options.strategy) {
    case Strategy::bsdf:
      return Techniques::of_counts(1, 0);
    case Strategy::light:
      return Techniques::of_counts(0, 1);
    case Strategy::uniform:
      return {.draw_uniform = true};
    case Strategy::mis:
      return depth == 1 ? Techniques::of_counts(options.bsdf_samples, options.light_samples)
                        : Techniques::of_counts(1, 1);
    case Strategy::one_sample: {
      const float c = options.light_probability;
      const bool light = random.next_1d() < c;
      return {.n_bsdf = 1 - c, .n_light = c, .draw_bsdf = !light, .draw_light = light};
    }
    case Strategy::average:
      return Techniques::of_counts(1, 1);
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
    for (int depth = 1; within(options_, depth); ++depth) {
      ++(arrival ? counters_.bounce_rays : counters_.camera_rays);
      const std::optional<SurfaceHit> hit = scene_.intersect(ray);
      result += throughput * emission(hit, ray.direction, arrival);
      if (!hit || !within(options_, depth + 1)) break;

      const Vertex vertex(*hit, ray.direction);
      const BsdfParts& parts = scene_.bsdfs().parts(hit->bsdf);
      const Techniques techniques = choose_techniques(options_, depth, random_);
      for (int i = 0; parts.density && i < techniques.draw_light; ++i) {
        const auto draw = draw_light(scene_, vertex, random_.next_2d(), counters_);
        if (draw) result += throughput * draw->estimate(light_weight(options_, techniques, *draw));
      }
      for (int i = 1; i < techniques.draw_bsdf; ++i) {
        result += throughput * bsdf_estimate(vertex, techniques);
      }
      if (techniques.draw_uniform && parts.density) {
        result += throughput * uniform_estimate(vertex);
      }
      if (finds_no_more(options_, techniques, parts, depth)) break;

      const auto next = draw_bsdf(scene_, vertex, random_.next_2d(), counters_);
      if (!next) break;
      throughput = throughput * next->weight;
      radiance_scale *= next->radiance_scale;
      if (is_black(throughput)) break;
      if (depth >= options_.rr_depth) {
        throughput = after_roulette(throughput, radiance_scale, random_.next_1d());
        if (is_black(throughput)) break;
      }
      arrival = Arrival{techniques, next->pdf_w, next->is_atom(), hit->position};
      ray = vertex.ray_along(next->wi);
    }
    return result;
  }

 private:
  Rgbf emission(const std::optional<SurfaceHit>& hit, const Vec3f& direction,
                const std::optional<Arrival>& arrival) const {
    return weighted_emission(options_, scene_.lights(), emission_seen(scene_, hit, direction),
                             direction, arrival ? &*arrival : nullptr);
  }

  /// Emission found in a direction from a vertex.
  Rgbf gather(const Vertex& vertex, const Vec3f& wi, const std::optional<Arrival>& arrival) {
    ++counters_.bounce_rays;
    const Ray ray = vertex.ray_along(wi);
    return emission(scene_.intersect(ray), ray.direction, arrival);
  }

  /// Direct light by one more BSDF sample, which the path does not follow further.
  Rgbf bsdf_estimate(const Vertex& vertex, const Techniques& techniques) {
    const auto next = draw_bsdf(scene_, vertex, random_.next_2d(), counters_);
    if (!next) return {};
    return next->weight *
           gather(vertex, next->wi,
                  Arrival{techniques, next->pdf_w, next->is_atom(), vertex.hit.position});
  }

  /// Direct light by one direction uniform on the hemisphere that wo is in, or on the sphere where
  /// light passes through the surface.
  Rgbf uniform_estimate(const Vertex& vertex) {
    const bool sphere = scene_.bsdfs().parts(vertex.hit.bsdf).transmission;
    const Vec2f u = random_.next_2d();
    Vec3f wi = sphere ? square_to_uniform_sphere(u) : square_to_uniform_hemisphere(u);
    const float pdf_w =
        sphere ? square_to_uniform_sphere_pdf_w(wi) : square_to_uniform_hemisphere_pdf_w(wi);
    if (vertex.wo.z < 0) wi.z = -wi.z;
    const Rgbf f = scene_.bsdfs().evaluate(vertex.hit.bsdf, vertex.wo, wi).f;
    if (is_black(f)) return {};
    return f * gather(vertex, wi, std::nullopt) * (std::abs(wi.z) / pdf_w);
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
