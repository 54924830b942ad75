#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <plumbline/renderer/core/render/film.h>
#include <plumbline/renderer/core/render/path.h>
#include <plumbline/renderer/core/sampling/sampler.h>
#include <plumbline/renderer/core/scene/scene.h>
#include <plumbline/renderer/loop/render_state.h>

namespace plumbline::renderer {

/// How many samples a pixel gets, of which numbers. Sampling ends at whichever limit is reached
/// first.
struct SamplingOptions {
  std::uint32_t samples_per_pixel = 16;  ///< upper limit, ≥ 1
  /// After a pilot in every pixel the others go where the error is: so many per pixel on average,
  /// as SampleCounts says.
  bool adaptive = false;
  std::uint32_t first_sample = 0;  ///< its number; Sobol: a multiple of what is drawn, no cut net
  double seconds = 0;              ///< time limit [s]; 0: none
  double relative_error = 0;       ///< stop at this Film::relative_error(); 0: none
  std::uint64_t seed = 0;
  SamplerType sampler = SamplerType::independent;
  /// Sobol only: independently scrambled parts that the samples of a pixel are dealt out to, ≥ 1.
  /// The film's variance is that between their means, and `PixelMoments::count` their number, since
  /// the points of one scramble know nothing of their own error. 1: all points in one net, no
  /// variance.
  std::uint32_t replicates = 1;
  int threads = 0;  ///< 0: all cores. The image does not depend on it.
  /// Called now and then from one thread with the fraction done, in [0, 1]. May be empty.
  std::function<void(double)> progress;
  Interruptions interruptions;
};

/// The state of a render that has not begun.
RenderState fresh_state(int width, int height, const SamplingOptions& options);

/// Adaptive: samples of every pixel before needs are known. A power of two in each replicate.
std::uint32_t pilot_samples(const SamplingOptions& options);

/// The counts at which a state's samples are aimed.
SampleCounts sample_counts(const RenderState& state, const SamplingOptions& options);

/// The highest level, up to the limit, whose samples all pixels have; see SampleCounts. Pixels that
/// have more count as little as pixels that another process renders.
std::uint32_t level_of(const RenderState& state, const SamplingOptions& options);

/// Samples that were drawn of every pixel; on average, where their numbers differ.
/// @param state  of all pixels
std::uint32_t samples_per_pixel(const RenderState& state, const SamplingOptions& options);

/// Level at which the limits of samples and error are looked at next: the next power of two, or all
/// where no error is; and the end of a pilot.
/// @param done  level that is reached, below the limit
std::uint32_t next_look(std::uint32_t done, const SamplingOptions& options);

/// Whether the error limit ends a render here. It is looked at at the levels 2, 4, 8, …, however
/// they came about; where a pixel has more, that look is passed, and ended nothing.
bool is_good_enough(const RenderState& state, const SamplingOptions& options);

/// Sets the needs from the pilot of all pixels where that is over, and they are not known.
void learn_needs(RenderState& state, const SamplingOptions& options);

/// Draws samples of pixels; each thread has one of its own.
class PixelSampler {
 public:
  virtual ~PixelSampler() = default;

  /// Draws one sample of the pixel (x, y), whose numbers are those of Sampler(…, net, index), and
  /// adds it to `to`: now or in finish(), but in the order of the calls.
  virtual void sample(int x, int y, std::uint64_t net, std::uint64_t index, PixelMoments& to) = 0;

  /// Ends what is under way.
  virtual void finish() {}

  PathCounters counters;
};

/// Makes a sampler: called once per thread.
using SamplerFactory = std::function<std::unique_ptr<PixelSampler>()>;

/// One path after the other: the reference that other samplers are held against.
/// @param scene, path  kept, not copied
std::unique_ptr<PixelSampler> make_scalar_sampler(const Scene& scene, const PathOptions& path,
                                                  SamplerType sampler, std::uint64_t seed);

struct LoopResult {
  Film film;
  PathCounters counters;
  std::uint32_t samples_per_pixel = 0;  ///< as the function of this name says
  double seconds = 0;
  bool stopped = false;  ///< before the limits were reached: pixels may have more samples
  std::vector<std::uint32_t> drawn;  ///< RenderState's
};

/// A tile holds at least so many samples, for samplers that work on many at once.
inline constexpr std::size_t kSamplesPerTile = 2048;

/// @throws InputError for an error limit on one replicate of Sobol points, whose error is not known
void require_known_error(const SamplingOptions& options);

/// Renders an image. The same samples give the same bits, whatever the number of threads or passes,
/// and however often it was stopped and gone on with.
/// @throws InputError for what `require_known_error` refuses
LoopResult run_render_loop(const Camera& camera, const SamplingOptions& options,
                           const SamplerFactory& make_sampler);

}  // namespace plumbline::renderer
