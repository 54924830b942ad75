#pragma once

#include <cstdint>

#include <plumbline/renderer/render/path.h>
#include <plumbline/renderer/scene/scene.h>
#include <plumbline/verify/mean_check.h>

namespace plumbline::tests {

/// Luminance samples of paths through uniformly random film positions: independent and identically
/// distributed, with the mean of the whole image. Drawn in parallel, merged in a fixed order.
///
/// @param scene  must outlive the sampler
verify::MomentSampler path_samples(const renderer::Scene& scene,
                                   const renderer::PathOptions& options, std::uint64_t seed);

}  // namespace plumbline::tests
