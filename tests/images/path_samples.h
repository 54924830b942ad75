#pragma once

#include <cstdint>

#include <plumbline/renderer/core/render/path.h>
#include <plumbline/renderer/core/scene/scene.h>
#include <plumbline/verify/mean.h>

namespace plumbline::tests {

/// Luminance samples of paths through uniformly random film positions: independent and identically
/// distributed, with the mean of the whole image. Drawn in parallel, merged in a fixed order.
///
/// Under Sobol one sample is the mean over a net of kNetSize paths with a scramble of its own: the
/// paths of one net depend on each other, nets do not.
///
/// @param scene  must outlive the sampler
verify::MomentSampler path_samples(
    const renderer::Scene& scene, const renderer::PathOptions& options, std::uint64_t seed,
    renderer::SamplerType sampler = renderer::SamplerType::independent);

/// Large enough that the net's order pays, small enough that the fewest nets a check takes do not.
inline constexpr std::uint32_t kNetSize = 64;

}  // namespace plumbline::tests
