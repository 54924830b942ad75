#include "allocated.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <atomic>
#include <cmath>
#include <utility>

#include <plumbline/renderer/assembly/direct.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/loop/tiles.h>

namespace plumbline::renderer {
namespace {

void allocate_pixel(const Scene& scene, const RenderOptions& options, int x, int y,
                    RenderState& state, PathCounters& counters) {
  const std::size_t index = pixel_index(state.width, x, y);
  PixelMoments& pixel = state.moments[index];
  std::uint32_t* bsdf_counts = &state.bsdf_counts[index * options.allocation->iterations];
  Pcg32 random(options.seed, index, 0);
  Rgbf emission;
  const auto draw = [&](std::size_t technique) {
    const Vec2f jitter = random.next_2d();
    const Ray ray = scene.camera().ray(x, y, jitter);
    const DirectSample sample =
        sample_direct_light(scene, ray, technique, random.next_2d(), counters);
    emission = sample.emission;
    return TechniqueSample<Rgbd>{rgb_cast<double>(sample.value), static_cast<double>(sample.pdf),
                                 static_cast<double>(sample.other_pdf)};
  };
  const auto record = [&](std::uint32_t iteration, std::size_t technique, const Rgbd& reflected) {
    if (technique == kBsdfTechnique) ++bsdf_counts[iteration];
    pixel.add(emission + rgb_cast<float>(reflected));
  };
  allocate_samples(*options.allocation, options.samples_per_pixel, draw, record);
  state.drawn[index] = options.samples_per_pixel;
}

}  // namespace

void check_allocation(const RenderOptions& options) {
  const AllocationOptions& allocation = *options.allocation;
  if (options.path.max_depth != 2) {
    throw InputError("sample allocation works on direct light only: set the maximum depth to 2");
  }
  if (options.sampler != SamplerType::independent) {
    throw InputError("sample allocation works with the independent sampler only");
  }
  if (options.seconds > 0 || options.relative_error > 0) {
    throw InputError("sample allocation needs a sample count, not a limit on time or error");
  }
  if (options.adaptive) {
    throw InputError("sample allocation draws as many samples of every pixel: not adaptive");
  }
  if (options.first_sample > 0) {
    throw InputError("sample allocation learns from the first sample on: it cannot begin later");
  }
  if (allocation.iterations < 1 || options.samples_per_pixel / 2 < allocation.iterations) {
    throw InputError("sample allocation needs two samples per pixel in every iteration");
  }
  if (!(allocation.limit > 0 && allocation.limit <= 0.5)) {
    throw InputError("the limit of the sample allocation must lie in (0, 0.5]");
  }
  if (!(allocation.cost_ratio > 0 && std::isfinite(allocation.cost_ratio))) {
    throw InputError("the cost ratio of the sample allocation must be positive");
  }
}

std::vector<float> final_shares(const RenderResult& result, std::uint32_t iterations) {
  const std::uint64_t samples = result.samples_per_pixel;
  const std::uint64_t before_last = samples * (iterations - 1) / iterations;
  const auto last = static_cast<float>(samples - before_last);
  std::vector<float> shares;
  shares.reserve(result.film.pixels().size());
  for (std::size_t i = iterations - 1; i < result.bsdf_counts.size(); i += iterations) {
    shares.push_back(static_cast<float>(result.bsdf_counts[i]) / last);
  }
  return shares;
}

RenderResult render_allocated(const Scene& scene, const RenderOptions& options) {
  const Camera& camera = scene.camera();
  RenderState state = options.interruptions.from
                          ? *options.interruptions.from
                          : fresh_state(camera.width(), camera.height(), options);
  ProgressReport progress(options.progress, state.drawn.size());
  TileThreads threads(options.threads);
  bool stopped = false;
  // Pixel by pixel: a slice takes as many of those that are missing as its time is enough for, and
  // one at least.
  while (!stopped && state.least_drawn() < options.samples_per_pixel) {
    constexpr std::size_t kTileSide = 8;  // pixels are dear: small tiles end together
    const Slice slice(options.interruptions);
    std::atomic<bool> has_begun = false;
    oneapi::tbb::enumerable_thread_specific<PathCounters> counters;
    threads.run(camera.width(), camera.height(), kTileSide, [&](const Tile& tile) {
      tile.for_each_pixel([&](int x, int y) {
        if (state.drawn[pixel_index(state.width, x, y)] > 0) return;
        if (slice.is_over() && has_begun.exchange(true)) return;
        allocate_pixel(scene, options, x, y, state, counters.local());
        progress.advance(1);
      });
    });
    for (const PathCounters& of_thread : counters) state.counters += of_thread;
    state.seconds += slice.seconds();
    const bool is_done = state.least_drawn() >= options.samples_per_pixel;
    stopped = slice.stops() && !is_done;
    if (options.interruptions.keep) options.interruptions.keep(state, stopped || is_done);
  }
  return {{state.take_film(), state.counters, state.least_drawn(), state.seconds, stopped,
           std::move(state.drawn)},
          std::move(state.bsdf_counts)};
}

}  // namespace plumbline::renderer
