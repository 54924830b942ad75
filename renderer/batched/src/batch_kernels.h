#pragma once

#include <plumbline/renderer/batched/shading.h>
#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/render/path.h>

/// The loops over many vertices that the batched backend spends its time in, but for those of the
/// BSDFs (bsdf_kernels.h).
namespace plumbline::renderer {

void to_local(Shading& s);
/// Fills shadow.direction and distance … radiance from u, v and pmf.
void sample_light(const Light& light, Shading& s, Run run);
/// Fills contribution, shadow.origin, shadow_t_max and shadow_bin.
void weigh_lights(const PathOptions& options, Shading& s);
/// Multiplies throughput and scale with what the BSDF samples say.
void apply_samples(Shading& s);
/// Lets paths die at random; `s.u` holds the numbers.
void roulette(Shading& s);
/// Fills next and next_bin.
void go_on(Shading& s);

}  // namespace plumbline::renderer
