#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <plumbline/renderer/estimators/allocation.h>
#include <plumbline/renderer/loop/render_loop.h>

namespace plumbline::renderer {

/// How paths are traced. Both ask the same functions of BSDFs, lights and heuristics, for the same
/// random numbers.
enum class Backend {
  batched,  ///< many side by side, in packets, where the strategy allows, else as `scalar`
  scalar    ///< one path after the other: the reference
};

/// What of, by which paths, and how they are traced.
struct RenderOptions : SamplingOptions {
  PathOptions path;
  Backend backend = Backend::batched;
  /// Direct light only, BSDF samples (technique 1) and light samples shared out pixel by pixel,
  /// balanced: takes the place of strategy and heuristic. Needs a depth of 2, a sample count that
  /// gives every iteration two, independent samples, and no other limit.
  std::optional<AllocationOptions> allocation;
};

struct RenderResult : LoopResult {
  /// With an allocation: BSDF samples drawn in each iteration, pixel after pixel, the iterations of
  /// a pixel side by side. Else empty. The film's variances are those of random mixtures then,
  /// which the counts, being fixed within an iteration, undercut.
  std::vector<std::uint32_t> bsdf_counts;
};

/// Share of BSDF samples of each pixel in its last iteration: what the allocation came to.
///
/// @param iterations  as rendered with
std::vector<float> final_shares(const RenderResult& result, std::uint32_t iterations);

/// Makes the samplers of `render` without an allocation: of the backend that is asked for, or of
/// `scalar` where the batched one does not know the strategy.
///
/// @param scene, options  kept, not copied
SamplerFactory pixel_samplers(const Scene& scene, const RenderOptions& options);

/// @throws InputError for an infinite path depth without Russian roulette, which may never end,
///         for an error limit on one replicate of Sobol points, whose error is not known, and for
///         an allocation that the other options do not fit
void require_renderable(const RenderOptions& options);

/// Renders an image. The same scene, path options, seed and sample count give the same bits,
/// whatever the number of threads or passes.
///
/// @throws InputError for what `require_renderable` refuses
RenderResult render(const Scene& scene, const RenderOptions& options);

/// The state of a render that has not begun.
RenderState fresh_state(int width, int height, const RenderOptions& options);

struct NonFinite {
  int x = 0, y = 0;                     ///< pixel, from the upper left one
  std::optional<std::uint32_t> sample;  ///< from 0; not told of allocated ones
};

/// The first sample of an image that was left out because it was not finite, by pixels row by row:
/// the samples of that pixel are drawn again.
///
/// @param scene, options  that `result` was rendered with
std::optional<NonFinite> first_non_finite(const Scene& scene, const RenderOptions& options,
                                          const RenderResult& result);

}  // namespace plumbline::renderer
