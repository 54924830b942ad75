#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <plumbline/renderer/core/render/path.h>
#include <plumbline/renderer/core/scene/scene.h>

/// The decisions at a surface point, for whoever traces paths: a student reads here what is drawn
/// and how it is weighed, and in path.cpp in which order. The batched backend takes emission,
/// roulette and ends of paths from here; it draws and weighs light samples in loops of its own,
/// which the tests hold to the bits of `draw_light` and `light_weight`.
namespace plumbline::renderer {

/// A surface point that light is gathered at.
struct Vertex {
  SurfaceHit hit;
  Frame<float> frame;
  Vec3f wo;  ///< local

  /// @param direction  of the ray that ended here
  Vertex(const SurfaceHit& surface, const Vec3f& direction)
      : hit(surface), frame(surface.normal), wo(frame.to_local(-direction)) {}

  /// @param wi  local
  Ray ray_along(const Vec3f& wi) const { return hit.ray_along(frame.to_world(wi)); }
};

inline bool within(const PathOptions& options, int depth) {
  return options.max_depth < 0 || depth <= options.max_depth;
}

/// What the end of a ray emits towards its start.
struct Emission {
  std::uint32_t light = kNoLight;
  Rgbf radiance;  ///< [W/(m² sr)]
};

inline Emission emission_of(const Scene& scene, std::uint32_t light, const Vec3f& direction) {
  if (light == kNoLight) return {};
  return {light, radiance(scene.lights()[light], direction)};
}

inline Emission emission_seen(const Scene& scene, const std::optional<SurfaceHit>& hit,
                              const Vec3f& direction) {
  return emission_of(scene, hit ? hit->light : scene.environment(), direction);
}

/// A point on a light that a vertex sees, and what its MIS weight depends on.
struct LightDraw {
  Rgbf value;       ///< f·radiance towards the vertex
  float cosine;     ///< |cosθ| at the vertex
  float pdf;        ///< pdf_w [1/sr] with which the light was sampled there; the mass of an atom
  float other_pdf;  ///< pdf_w [1/sr] with which the BSDF samples the same direction; 0 for an atom
  bool atom;        ///< no other technique can find it

  /// The weighted estimate of the reflected radiance: f·|cosθ|·radiance·weight/pdf.
  Rgbf estimate(float weight) const { return value * (cosine * weight / pdf); }
};

/// @param u  in [0, 1)²
/// @return   nullopt where nothing is sampled, the BSDF is black, or something lies between
inline std::optional<LightDraw> draw_light(const Scene& scene, const Vertex& vertex, const Vec2f& u,
                                           PathCounters& counters) {
  const auto light = scene.lights().sample(vertex.hit.position, u);
  if (!light) {
    ++counters.rejected;
    return std::nullopt;
  }
  const Vec3f wi = vertex.frame.to_local(light->wi);
  const BsdfValue<float> bsdf = scene.bsdfs().evaluate(vertex.hit.bsdf, vertex.wo, wi);
  if (is_black(bsdf.f)) return std::nullopt;
  ++counters.shadow_rays;
  const Ray ray = shadow_ray(vertex.hit, *light);
  if (ray.t_max > 0 && scene.occluded(ray)) return std::nullopt;
  const bool atom = light->is_atom();
  return LightDraw{bsdf.f * light->radiance, std::abs(wi.z), atom ? light->mass : light->pdf_w,
                   atom ? 0 : bsdf.pdf_w, atom};
}

/// A direction from the BSDF.
inline std::optional<BsdfSample<float>> draw_bsdf(const Scene& scene, const Vertex& vertex,
                                                  const Vec2f& u, PathCounters& counters) {
  const auto next = scene.bsdfs().sample(vertex.hit.bsdf, vertex.wo, u);
  if (!next) ++counters.rejected;
  return next;
}

/// The techniques for direct light at one vertex. `n_…` is the expected number of samples, or the
/// probability of the one: what enters the MIS weight. `draw_…` is the number drawn this time.
struct Techniques {
  float n_bsdf = 0, n_light = 0;
  int draw_bsdf = 0, draw_light = 0;
  bool draw_uniform = false;

  /// As many of each as are expected.
  static Techniques of_counts(int bsdf, int light) {
    return {.n_bsdf = static_cast<float>(bsdf),
            .n_light = static_cast<float>(light),
            .draw_bsdf = bsdf,
            .draw_light = light};
  }

  /// BSDF samples in all: one goes on where no density is asked for, since only it finds atoms.
  int bsdf_samples() const { return std::max(draw_bsdf, 1); }
};

/// MIS weight of one of n samples of a technique, over n.
///
/// @param pdf, pdf_other  pdf_w [1/sr] of this technique and the other at the sample
/// @param atom            no other technique can find it, and the densities do not count
inline float mis_weight_per_sample(const PathOptions& options, float n, float pdf, float n_other,
                                   float pdf_other, bool atom) {
  if (options.strategy == Strategy::average) return 0.5f;
  return (atom ? 1 : mis_weight(options.heuristic, n * pdf, n_other * pdf_other)) / n;
}

inline float light_weight(const PathOptions& options, const Techniques& t, const LightDraw& draw) {
  return mis_weight_per_sample(options, t.n_light, draw.pdf, t.n_bsdf,
                               t.n_bsdf > 0 ? draw.other_pdf : 0, draw.atom);
}

/// The vertex behind the end of a BSDF ray.
struct Arrival {
  Techniques techniques;
  float pdf_w;  ///< [1/sr] of the BSDF sample
  bool atom;    ///< no other technique can find what lies at the end
  Vec3f ref;    ///< what light densities refer to
};

/// Weight of the emission of `light` at the end of a BSDF ray.
inline float emission_weight(const PathOptions& options, const LightSet& lights,
                             const Arrival& arrival, std::uint32_t light, const Vec3f& direction) {
  const Techniques& t = arrival.techniques;
  if (arrival.atom) {
    return mis_weight_per_sample(options, static_cast<float>(t.bsdf_samples()), 0, 0, 0, true);
  }
  if (t.draw_bsdf == 0) return 0;
  const float pdf_light = t.n_light > 0 ? lights.pdf_at_hit(light, arrival.ref, direction) : 0.0f;
  return mis_weight_per_sample(options, t.n_bsdf, arrival.pdf_w, t.n_light, pdf_light, false);
}

/// What emission at the end of a ray adds, weighted against the light sample that could have found
/// it.
///
/// @param arrival  nullptr for a camera ray: its emission counts fully
inline Rgbf weighted_emission(const PathOptions& options, const LightSet& lights,
                              const Emission& seen, const Vec3f& direction,
                              const Arrival* arrival) {
  if (seen.light == kNoLight || arrival == nullptr) return seen.radiance;
  return seen.radiance * emission_weight(options, lights, *arrival, seen.light, direction);
}

/// Whether the continued path could find nothing that counts: emission at its next end only after
/// an atom, and no vertex beyond.
inline bool finds_no_more(const PathOptions& options, const Techniques& techniques,
                          const BsdfParts& parts, int depth) {
  return techniques.draw_bsdf == 0 && !parts.atoms && !within(options, depth + 2);
}

/// Ends paths at random and scales the survivors up, so that the mean stays.
///
/// @param radiance_scale  what refractions alone made of the throughput. It comes back when the
///                        path leaves the glass, so it does not count
/// @param u               in [0, 1)
/// @return                black where the path ends
inline Rgbf after_roulette(const Rgbf& throughput, float radiance_scale, float u) {
  // 0.95 as in Mitsuba: without a cap a path in a white closed room would never end.
  const float survival = std::min(max_component(throughput) / radiance_scale, 0.95f);
  const Rgbf scaled = throughput / survival;
  return u < survival ? scaled : Rgbf{};
}

}  // namespace plumbline::renderer
