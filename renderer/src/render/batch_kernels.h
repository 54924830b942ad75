#pragma once

#include <cstddef>
#include <cstdint>

#include <plumbline/renderer/render/path.h>
#include <plumbline/renderer/scene/lanes.h>

/// The loops over many vertices that the batched backend spends its time in.
namespace plumbline::renderer {

/// Vertices side by side, those of one BSDF and one light together.
struct Shading {
  std::size_t count = 0;
  IndexLanes bsdf, light, path;
  Vec3Lanes position, normal, wo;  // wo is local
  Lanes<float> offset;
  RgbLanes throughput;
  Lanes<float> scale;  // what refractions alone made of the throughput
  Lanes<float> u, v;   // uniform numbers of the sample that is made next
  Lanes<float> pmf;    // of the light
  RayLanes shadow;     // its direction is world, towards the light
  Lanes<float> distance, cos_light, pdf_light, mass;  // both 0: no light sample
  RgbLanes radiance, f;
  Lanes<float> cosine, pdf_bsdf;  // of shadow.direction
  RgbLanes contribution;
  Lanes<float> shadow_t_max;
  IndexLanes shadow_kind;   // octant, or one of the two below
  Vec3Lanes wi;             // local
  RgbLanes weight;          // of the BSDF sample; black: none
  Lanes<float> pdf_w;       // 0 for an atom
  Lanes<float> refraction;  // radiance_scale of the sample
  RayLanes next;
  IndexLanes next_kind;  // octant, or kDropped
};

inline constexpr std::uint32_t kUnblocked = 8, kDropped = 9, kKinds = 10;

/// Each works on the vertices [first, end), which are of one BSDF or of one light.
struct Run {
  std::size_t first, end;
};

void to_local(Shading& s);
/// Fills shadow.direction and distance … radiance from u, v and pmf.
void sample_light(const Light& light, Shading& s, Run run);
/// Fills f, cosine and pdf_bsdf.
void evaluate(const BsdfSet& bsdfs, std::uint32_t bsdf, Shading& s, Run run);
/// Fills contribution, shadow.origin, shadow_t_max and shadow_kind.
void weigh_lights(const PathOptions& options, Shading& s);
/// Fills wi, weight, pdf_w and refraction from u and v. @return rejected samples
std::size_t sample_bsdf(const BsdfSet& bsdfs, std::uint32_t bsdf, Shading& s, Run run);
/// Multiplies throughput and scale with what the BSDF samples say.
void apply_samples(Shading& s);
/// Lets paths die at random; `s.u` holds the numbers.
void roulette(Shading& s);
/// Fills next and next_kind.
void go_on(Shading& s);

}  // namespace plumbline::renderer
