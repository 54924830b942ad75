#pragma once

#include <cstdint>
#include <memory>

#include <plumbline/renderer/batched/bsdf_kernels.h>
#include <plumbline/renderer/core/render/path.h>
#include <plumbline/renderer/core/render/render_loop.h>

namespace plumbline::renderer {

/// Traces many paths side by side, one stage at a time: rays by octant in packets of sixteen,
/// vertices sorted by BSDF and light, so that each stage is a loop over plain arrays. Every
/// function of BSDFs, lights and heuristics is that of `estimate_radiance`, called with the same
/// numbers in the same order: from equal hits the two give equal bits.
///
/// @param kernels  of the scene's BSDFs; like scene and options kept, not copied
/// @return         nullptr where the strategy takes more than one sample of a technique, or chooses
///                 between them: the stages are made for at most one of each
std::unique_ptr<PixelSampler> make_batched_sampler(const Scene& scene, const BsdfKernels& kernels,
                                                   const PathOptions& options, SamplerType sampler,
                                                   std::uint64_t seed);

}  // namespace plumbline::renderer
