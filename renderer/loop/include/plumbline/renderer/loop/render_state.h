#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <plumbline/renderer/adaptive/sample_counts.h>
#include <plumbline/renderer/core/render/film.h>
#include <plumbline/renderer/core/render/path.h>

namespace plumbline::renderer {

/// What a render has done so far: enough to go on from it as if it had never stopped.
struct RenderState {
  int width = 0, height = 0;
  std::uint32_t nets = 0;  ///< of Sobol points, of each pixel; 0: its samples are independent
  std::vector<PixelMoments> moments;       ///< of each pixel, or of each of its nets, side by side
  std::vector<std::uint32_t> drawn;        ///< samples of each pixel, whichever they became
  std::vector<std::uint32_t> bsdf_counts;  ///< with an allocation: RenderResult's
  std::vector<SampleNeed> needs;           ///< adaptive, once the pilot is over: of each pixel
  PathCounters counters;
  double seconds = 0;  ///< in all

  /// Samples that every pixel has; without pixels, the largest number.
  std::uint32_t least_drawn() const;

  std::uint32_t moments_per_pixel() const { return nets > 0 ? nets : 1; }

  /// Of the image. The mean of a net is one sample of it: what its points share says nothing of the
  /// error.
  PixelMoments pixel(std::size_t index) const;
  Film film() const;
  /// The same in the memory of the moments, which are gone then.
  Film take_film();

  /// Moments of each pixel's samples, whichever net they are in: not of what they say of the
  /// error, which is the film's.
  Film samples() const;
};

/// How a render is stopped, kept, and gone on with. All may be empty. What is asked for is looked
/// at several times a second; the samples are the same without it.
struct Interruptions {
  /// Asked from any thread: whether to end before the limits are reached, with what is done.
  std::function<bool()> stop;
  /// Called between samples, in the thread that renders, with what is done so far, and at the end.
  std::function<void(const RenderState& state, bool is_last)> keep;
  /// What is done already: kept of the same scene and options, but for threads and limits, which
  /// may be no lower than what is drawn.
  std::shared_ptr<const RenderState> from;
  double slice = 0.1;  ///< [s] between looks, about

  bool any() const { return stop || keep; }
};

/// A slice of a render, after which it can be kept. In one that takes long, tiles are left out when
/// it is to stop.
class Slice {
 public:
  explicit Slice(const Interruptions& interruptions);

  /// Whether the rest is to be left to later: from any thread.
  bool is_cut() const { return seconds() > interruptions_.slice && stops(); }

  bool is_over() const { return interruptions_.any() && seconds() > interruptions_.slice; }
  bool stops() const { return interruptions_.stop && interruptions_.stop(); }
  double seconds() const;

 private:
  const Interruptions& interruptions_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace plumbline::renderer
