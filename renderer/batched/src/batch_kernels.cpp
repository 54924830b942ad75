#include "batch_kernels.h"

#include <type_traits>
#include <variant>

#include <plumbline/renderer/batched/bsdf_kernels.h>
#include <plumbline/renderer/core/render/vertex.h>

namespace plumbline::renderer {
namespace {

/// @param sample_of  sample(ref, u) of one light
template <class Sample>
void sample_lanes(const Sample& sample_of, Shading& s, Run run) {
  for (std::size_t k = run.first; k < run.end; ++k) {
    const auto sample = sample_of(s.position[k], Vec2f{s.u[k], s.v[k]});
    const bool found = sample.has_value();
    const LightSample<float> l = found ? *sample : LightSample<float>{};
    s.shadow.direction.set(k, l.wi);
    s.distance[k] = l.distance;
    s.cos_light[k] = l.cos_light;
    s.pdf_light[k] = l.pdf_w * s.pmf[k];
    s.mass[k] = l.mass * s.pmf[k];
    s.radiance.set(k, l.radiance);
  }
}

/// What tells which of its two ways of sampling a light goes, if it has two.
template <class L>
auto way_of() {
  if constexpr (requires { &L::by_solid_angle; }) return &L::by_solid_angle;
  if constexpr (requires { &L::inward; }) return &L::inward;
}

/// The light with its way of sampling as a constant: no other is left in the loop.
template <bool way, class L>
auto sampled_by(L light) {
  light.*way_of<L>() = way;
  return [light](const Vec3f& ref, const Vec2f& u) { return light.sample(ref, u); };
}

template <class L>
PLUMBLINE_KERNEL void sample_light_of_type(const L& shared, Shading& s, Run run) {
  if constexpr (!std::is_void_v<decltype(way_of<L>())>) {
    if (shared.*way_of<L>()) return sample_lanes(sampled_by<true>(shared), s, run);
    return sample_lanes(sampled_by<false>(shared), s, run);
  }
  const Local<L> light = shared;
  sample_lanes([&](const Vec3f& ref, const Vec2f& u) { return light.sample(ref, u); }, s, run);
}

}  // namespace

PLUMBLINE_KERNEL void to_local(Shading& s) {
  for (std::size_t k = 0; k < s.count; ++k) {
    s.wo.set(k, Frame<float>(s.normal[k]).to_local(-s.wo[k]));
  }
}

void sample_light(const Light& light, Shading& s, Run run) {
  std::visit([&](const auto& l) { sample_light_of_type(l, s, run); }, light);
}

namespace {

/// @param n_bsdf  0 or 1
template <class Weight>
PLUMBLINE_KERNEL void weigh(Shading& s, float n_bsdf, const Weight& weight) {
  for (std::size_t k = 0; k < s.count; ++k) {
    const float pdf = s.pdf_light[k], mass = s.mass[k];
    const float w = weight(pdf, n_bsdf * s.pdf_bsdf[k]);
    const float scale = s.cosine[k] * (mass > 0 ? 1.0f : w) / (mass > 0 ? mass : pdf);
    s.contribution.set(k, s.throughput[k] * (s.f[k] * s.radiance[k] * scale));
  }
}

PLUMBLINE_KERNEL void aim_shadow_rays(Shading& s) {
  for (std::size_t k = 0; k < s.count; ++k) {
    const SurfaceHit hit{s.position[k], s.normal[k], s.offset[k], 0, 0};
    const Ray ray =
        shadow_ray(hit, {s.shadow.direction[k], s.distance[k], s.cos_light[k], {}, 0, 0});
    s.shadow.origin.set(k, ray.origin);
    s.shadow_t_max[k] = ray.t_max;
  }
}

void choose_bins(Shading& s) {
  for (std::size_t k = 0; k < s.count; ++k) {
    const bool lit = (s.pdf_light[k] > 0 || s.mass[k] > 0) && !is_black(s.f[k]);
    s.shadow_bin[k] = !lit                    ? bin_of(Uncast::dropped)
                      : s.shadow_t_max[k] > 0 ? octant(s.shadow.direction[k])
                                              : bin_of(Uncast::unblocked);
  }
}

}  // namespace

void weigh_lights(const PathOptions& options, Shading& s) {
  const float n_bsdf = options.strategy == Strategy::light ? 0.0f : 1.0f;
  const Weighting& h = options.heuristic;
  if (h.heuristic == Heuristic::power && h.parameter == 2) {
    weigh(s, n_bsdf, [](float a, float b) { return mis_weight(Heuristic::power, a, b); });
  } else if (h.heuristic == Heuristic::balance) {
    weigh(s, n_bsdf, [](float a, float b) { return mis_weight(Heuristic::balance, a, b); });
  } else {
    weigh(s, n_bsdf, [&](float a, float b) { return mis_weight(h, a, b); });
  }
  aim_shadow_rays(s);
  choose_bins(s);
}

PLUMBLINE_KERNEL void apply_samples(Shading& s) {
  for (std::size_t k = 0; k < s.count; ++k) {
    s.throughput.set(k, s.throughput[k] * s.weight[k]);
    s.scale[k] = s.scale[k] * s.refraction[k];
  }
}

PLUMBLINE_KERNEL void roulette(Shading& s) {
  for (std::size_t k = 0; k < s.count; ++k) {
    s.throughput.set(k, after_roulette(s.throughput[k], s.scale[k], s.u[k]));
  }
}

PLUMBLINE_KERNEL void go_on(Shading& s) {
  for (std::size_t k = 0; k < s.count; ++k) {
    const SurfaceHit hit{s.position[k], s.normal[k], s.offset[k], 0, 0};
    const Vec3f direction = Frame<float>(s.normal[k]).to_world(s.wi[k]);
    s.next.direction.set(k, direction);
    s.next.origin.set(k, hit.origin_towards(direction));
    s.next_bin[k] = is_black(s.throughput[k]) ? bin_of(Uncast::dropped) : octant(direction);
  }
}

}  // namespace plumbline::renderer
