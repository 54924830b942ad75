#pragma once

#include <cstdint>
#include <memory>

#include <plumbline/renderer/batched/bsdf_kernels.h>
#include <plumbline/renderer/core/render/path.h>
#include <plumbline/renderer/loop/render_loop.h>

namespace plumbline::renderer {

/// Traces many paths side by side, one stage at a time: rays by octant in packets of sixteen,
/// vertices sorted by BSDF and light, so that each stage is a loop over plain arrays. Every
/// function of BSDFs, lights and heuristics is that of `estimate_radiance`, called with the same
/// numbers in the same order; what is made of a light sample's is written a second time. From equal
/// hits the two give equal bits, which the tests hold them to.
///
/// @param kernels  of the scene's BSDFs; like scene and options kept, not copied
/// @return         nullptr but for `bsdf`, `light`, and `mis` with one sample of each: the stages
///                 are made for these
std::unique_ptr<PixelSampler> make_batched_sampler(const Scene& scene, const BsdfKernels& kernels,
                                                   const PathOptions& options, SamplerType sampler,
                                                   std::uint64_t seed);

}  // namespace plumbline::renderer
