#pragma once

#include <cstdint>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/render/path.h>
#include <plumbline/verify/mean.h>
#include "colour_check.h"

namespace plumbline::tests {

/// The scene with a film of one pixel, as large as the whole film was: what is drawn of it are
/// independent, identically distributed samples with the mean of the whole image.
renderer::SceneDescription one_pixel(renderer::SceneDescription scene);

/// Samples of paths through the one pixel, channel by channel, by the backend that users get
/// unless another is asked for. Drawn in parallel, merged in a fixed order.
///
/// Under Sobol one sample is the mean over a net of kNetSize paths with a scramble of its own: the
/// paths of one net depend on each other, nets do not.
///
/// @param scene  of `one_pixel`; must outlive the sampler
ColourSampler path_samples(const renderer::Scene& scene, const renderer::PathOptions& path,
                           std::uint64_t seed,
                           renderer::SamplerType sampler = renderer::SamplerType::independent,
                           renderer::Backend backend = renderer::Backend::batched);

/// The luminance of the same samples.
verify::MomentSampler luminance_samples(
    const renderer::Scene& scene, const renderer::PathOptions& path, std::uint64_t seed,
    renderer::SamplerType sampler = renderer::SamplerType::independent);

/// Large enough that the net's order pays, small enough that the fewest nets a check takes do not:
/// of pairs of numbers that are ordered each by itself, 16 paths show all but a few percent of what
/// 1,024 do, but where one pair is all there is, as under a point light.
inline constexpr std::uint32_t kNetSize = 32;

}  // namespace plumbline::tests
