#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include <plumbline/renderer/mis/allocation.h>
#include <plumbline/renderer/render/film.h>
#include <plumbline/renderer/render/path.h>
#include <plumbline/renderer/scene/scene.h>

namespace plumbline::renderer {

/// How paths are traced. Both ask the same functions of BSDFs, lights and heuristics, for the same
/// random numbers.
enum class Backend {
  batched,  ///< many side by side, in packets, where the strategy allows, else as `scalar`
  scalar    ///< one path after the other: the reference
};

inline constexpr std::array kBackends{Backend::batched, Backend::scalar};

/// The name on the command line: "batched", "scalar".
constexpr std::string_view name(Backend backend) {
  return backend == Backend::batched ? "batched" : "scalar";
}

/// When to stop and how to start. Sampling ends at whichever limit is reached first.
struct RenderOptions {
  PathOptions path;
  std::uint32_t samples_per_pixel = 16;  ///< upper limit, ≥ 1
  double seconds = 0;                    ///< time limit [s]; 0: none
  double relative_error = 0;             ///< stop at this Film::relative_error(); 0: none
  std::uint64_t seed = 0;
  SamplerType sampler = SamplerType::independent;
  /// Sobol only: independently scrambled parts that the samples of a pixel are dealt out to, ≥ 1.
  /// The film's variance is that between their means, and `PixelMoments::count` their number, since
  /// the points of one scramble know nothing of their own error. 1: all points in one net, no
  /// variance.
  std::uint32_t replicates = 1;
  Backend backend = Backend::batched;
  int threads = 0;  ///< 0: all cores. The image does not depend on it.
  /// Direct light only, BSDF samples (technique 1) and light samples shared out pixel by pixel,
  /// balanced: takes the place of strategy and heuristic. Needs a depth of 2, a sample count that
  /// gives every iteration two, independent samples, and no other limit.
  std::optional<AllocationOptions> allocation;
  /// Called now and then from one thread with the fraction done, in [0, 1]. May be empty.
  std::function<void(double)> progress;
};

struct RenderResult {
  Film film;
  PathCounters counters;
  std::uint32_t samples_per_pixel = 0;  ///< drawn
  double seconds = 0;
  /// With an allocation: BSDF samples drawn in each iteration, pixel after pixel, the iterations of
  /// a pixel side by side. Else empty. The film's variances are those of random mixtures then,
  /// which the counts, being fixed within an iteration, undercut.
  std::vector<std::uint32_t> bsdf_counts;
};

/// Share of BSDF samples of each pixel in its last iteration: what the allocation came to.
///
/// @param iterations  as rendered with
std::vector<float> final_shares(const RenderResult& result, std::uint32_t iterations);

/// Renders an image. The same scene, path options, seed and sample count give the same bits,
/// whatever the number of threads or passes.
///
/// @throws InputError for an infinite path depth without Russian roulette, which may never end,
///         for an error limit on one replicate of Sobol points, whose error is not known, and for
///         an allocation that the other options do not fit
RenderResult render(const Scene& scene, const RenderOptions& options);

}  // namespace plumbline::renderer
