#pragma once

#include <algorithm>
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

/// The light that a ray ends on, or kNoLight.
inline std::uint32_t light_seen(const Scene& scene, const std::optional<SurfaceHit>& hit) {
  return hit ? hit->light : scene.environment();
}

inline bool is_visible(const Scene& scene, const SurfaceHit& hit, const LightSample<float>& light,
                       PathCounters& counters) {
  ++counters.shadow_rays;
  const Ray ray = shadow_ray(hit, light);
  return !(ray.t_max > 0) || !scene.occluded(ray);
}

/// The techniques for direct light at one vertex. `n_…` is the expected number of samples, or the
/// probability of the one: what enters the MIS weight. `draw_…` is the number drawn this time.
struct Techniques {
  float n_bsdf = 0, n_light = 0;
  int draw_bsdf = 0, draw_light = 0;
  bool draw_uniform = false;

  /// BSDF samples in all: one goes on where no density is asked for, since only it finds atoms.
  int directions() const { return std::max(draw_bsdf, 1); }
};

/// What the weight of emission at the end of a BSDF ray depends on: the vertex behind it.
struct Arrival {
  Techniques techniques;
  bool by_atom;  ///< no other technique can find what lies at the end
  float pdf_w;   ///< of the BSDF sample, if it was no atom
  Vec3f ref;     ///< what light densities refer to
};

/// The share of one of n samples that no other technique can draw.
inline float share(const PathOptions& options, float n) {
  return options.strategy == Strategy::average ? 0.5f : 1 / n;
}

/// MIS weight of one sample of a technique over the number of its samples.
inline float technique_weight(const PathOptions& options, float n, float pdf, float n_other,
                              float pdf_other) {
  if (options.strategy == Strategy::average) return 0.5f;
  return mis_weight(options.heuristic, n * pdf, n_other * pdf_other) / n;
}

/// Weight of the emission of `light` at the end of a BSDF ray.
inline float arrival_weight(const PathOptions& options, const LightSet& lights,
                            const Arrival& arrival, std::uint32_t light, const Vec3f& direction) {
  const Techniques& t = arrival.techniques;
  if (arrival.by_atom) return share(options, static_cast<float>(t.directions()));
  if (t.draw_bsdf == 0) return 0;
  const float pdf_light = t.n_light > 0 ? lights.pdf_at_hit(light, arrival.ref, direction) : 0.0f;
  return technique_weight(options, t.n_bsdf, arrival.pdf_w, t.n_light, pdf_light);
}

/// Probability with which roulette lets a path live that is as deep as rr_depth. What counts is the
/// throughput without the scale of refractions: it comes back when the path leaves the glass.
inline float survival_probability(const Rgbf& throughput, float radiance_scale) {
  // 0.95 as in Mitsuba: without a cap a path in a white closed room would never end.
  return std::min(max_component(throughput) / radiance_scale, 0.95f);
}

}  // namespace plumbline::renderer
