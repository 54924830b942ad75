#include <plumbline/renderer/loop/render_loop.h>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/loop/tiles.h>

namespace plumbline::renderer {
namespace {

class ScalarSampler final : public PixelSampler {
 public:
  ScalarSampler(const Scene& scene, const PathOptions& path, SamplerType sampler,
                std::uint64_t seed)
      : scene_(scene), path_(path), sampler_(sampler), seed_(seed) {}

  void sample(int x, int y, std::uint64_t net, std::uint64_t index, PixelMoments& to) override {
    Sampler random(sampler_, seed_, net, index);
    const Ray ray = scene_.camera().ray(x, y, random.next_2d());
    to.add(estimate_radiance(scene_, path_, ray, random, counters));
  }

 private:
  const Scene& scene_;
  const PathOptions& path_;
  SamplerType sampler_;
  std::uint64_t seed_;
};

bool has_all(const RenderState& state, const SampleCounts& counts) {
  for (std::size_t i = 0; i < state.drawn.size(); ++i) {
    if (state.drawn[i] < counts.of(i)) return false;
  }
  return true;
}

class RenderLoop {
 public:
  RenderLoop(const Camera& camera, const SamplingOptions& options,
             const SamplerFactory& make_sampler)
      : options_(options),
        threads_(options.threads),
        state_(options.interruptions.from ? *options.interruptions.from
                                          : fresh_state(camera.width(), camera.height(), options)),
        before_{state_.counters, state_.seconds},
        progress_(options.progress, state_.drawn.size() * options.samples_per_pixel),
        samplers_(make_sampler),
        counts_(sample_counts(state_, options)),
        done_(level_of(state_, options)) {}

  LoopResult run() {
    bool stopped = false;
    while (!stopped && done_ < options_.samples_per_pixel && !is_good_enough(state_, options_)) {
      const bool is_known = !state_.needs.empty();
      learn_needs(state_, options_);
      if (!is_known) counts_ = sample_counts(state_, options_);
      const std::uint32_t target = next_look_in_time(done_);
      if (target == done_) break;
      stopped = !render_up_to(target);
    }
    stopped = stopped && done_ < options_.samples_per_pixel;
    keep(true);
    const std::uint32_t samples = samples_per_pixel(state_, options_);
    return {state_.take_film(), state_.counters, samples,
            state_.seconds,     stopped,         std::move(state_.drawn)};
  }

 private:
  struct Costs {
    PathCounters counters;
    double seconds = 0;
  };

  double seconds() const {
    return before_.seconds +
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  /// Costs are those of what was rendered before, and here.
  void keep(bool is_last) {
    state_.seconds = seconds();
    state_.counters = before_.counters;
    for (const auto& sampler : samplers_) state_.counters += sampler->counters;
    if (options_.interruptions.keep) options_.interruptions.keep(state_, is_last);
  }

  /// No further than what the time that is left is enough for. `done` ends the render.
  std::uint32_t next_look_in_time(std::uint32_t done) const {
    const std::uint32_t look = next_look(done, options_);
    if (!(options_.seconds > 0) || done == 0) return look;
    const double so_far = seconds();
    const double left = (options_.seconds - so_far) / so_far * done;
    const double samples = std::min<double>(look - done, left);
    return samples >= 1 ? done + static_cast<std::uint32_t>(samples) : done;
  }

  /// @return false where it was stopped
  bool render_up_to(std::uint32_t target) {
    const Interruptions& interruptions = options_.interruptions;
    while (done_ < target) {
      const std::uint32_t left = target - done_;
      const std::uint32_t samples = interruptions.any() ? std::min(left, samples_of_slice_) : left;
      const Slice slice(interruptions);
      counts_.set_level(done_ + samples);
      render_slice(samples, slice);
      if (has_all(state_, counts_)) done_ += samples;
      if (slice.seconds() < interruptions.slice / 2) {
        samples_of_slice_ = std::min(2 * samples_of_slice_, 1u << 30);
      } else if (slice.seconds() > 2 * interruptions.slice) {
        samples_of_slice_ = std::max(samples_of_slice_ / 2, 1u);
      }
      keep(false);
      if (slice.stops()) return false;
    }
    return true;
  }

  /// @param samples  of a pixel, on average
  void render_slice(std::uint32_t samples, const Slice& slice) {
    threads_.run(state_.width, state_.height, tile_side(samples), [&](const Tile& tile) {
      if (slice.is_cut()) return;
      PixelSampler& sampler = *samplers_.local();
      tile.for_each_pixel([&](int x, int y) { render_pixel(x, y, sampler); });
      sampler.finish();
      progress_.advance(tile.pixels() * samples);
    });
  }

  /// Small enough that threads end together.
  static std::size_t tile_side(std::uint32_t samples) {
    std::size_t side = 8;
    while (side * side * samples < kSamplesPerTile) side *= 2;
    return side;
  }

  /// Of a slice that was cut, some pixels have their samples already.
  void render_pixel(int x, int y, PixelSampler& sampler) {
    const std::size_t pixel = pixel_index(state_.width, x, y);
    const std::uint32_t target = counts_.of(pixel);
    const std::uint32_t nets = state_.moments_per_pixel();
    for (std::uint32_t& drawn = state_.drawn[pixel]; drawn < target; ++drawn) {
      const std::uint32_t s = options_.first_sample + drawn;
      const std::size_t net = pixel * nets + s % nets;
      sampler.sample(x, y, net, s / nets, state_.moments[net]);
    }
  }

  const SamplingOptions& options_;
  TileThreads threads_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  RenderState state_;
  Costs before_;
  std::uint32_t samples_of_slice_ = 1;
  ProgressReport progress_;
  oneapi::tbb::enumerable_thread_specific<std::unique_ptr<PixelSampler>> samplers_;
  SampleCounts counts_;
  std::uint32_t done_;  // the level that all pixels have
};

}  // namespace

std::uint32_t pilot_samples(const SamplingOptions& options) {
  const std::uint32_t nets = options.sampler == SamplerType::sobol ? options.replicates : 1;
  return nets * std::bit_ceil((kLeastPilot + nets - 1) / nets);
}

SampleCounts sample_counts(const RenderState& state, const SamplingOptions& options) {
  return {state.needs, pilot_samples(options)};
}

std::uint32_t level_of(const RenderState& state, const SamplingOptions& options) {
  const std::uint32_t limit = options.samples_per_pixel;
  if (state.needs.empty()) return std::min(state.least_drawn(), limit);
  SampleCounts counts = sample_counts(state, options);
  std::uint32_t low = std::min(pilot_samples(options), limit), high = limit + 1;
  while (high - low > 1) {
    const std::uint32_t level = low + (high - low) / 2;
    counts.set_level(level);
    (has_all(state, counts) ? low : high) = level;
  }
  return low;
}

std::uint32_t samples_per_pixel(const RenderState& state, const SamplingOptions& options) {
  if (state.needs.empty()) return level_of(state, options);
  std::uint64_t sum = 0;
  for (const std::uint32_t drawn : state.drawn) sum += drawn;
  const std::uint64_t pixels = state.drawn.size();
  return static_cast<std::uint32_t>((sum + pixels / 2) / pixels);
}

std::uint32_t next_look(std::uint32_t done, const SamplingOptions& options) {
  const std::uint32_t all = options.samples_per_pixel, pilot = pilot_samples(options);
  const std::uint32_t end = options.adaptive && done < pilot ? std::min(pilot, all) : all;
  if (!(options.seconds > 0) && !(options.relative_error > 0)) return end;
  return std::min(done == 0 ? 1 : std::bit_ceil(done + 1), end);
}

bool is_good_enough(const RenderState& state, const SamplingOptions& options) {
  if (!(options.relative_error > 0)) return false;
  const std::uint32_t level = std::bit_floor(level_of(state, options));
  if (level < 2) return false;
  SampleCounts counts = sample_counts(state, options);
  counts.set_level(level);
  for (std::size_t i = 0; i < state.drawn.size(); ++i) {
    if (state.drawn[i] != counts.of(i)) return false;
  }
  return state.film().relative_error() <= options.relative_error;
}

void learn_needs(RenderState& state, const SamplingOptions& options) {
  if (!options.adaptive || !state.needs.empty()) return;
  if (level_of(state, options) < pilot_samples(options)) return;
  state.needs = needs_from_neighbours(state.samples());
}

std::uint32_t RenderState::least_drawn() const {
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  for (const std::uint32_t samples : drawn) least = std::min(least, samples);
  return least;
}

PixelMoments RenderState::pixel(std::size_t index) const {
  if (nets == 0) return moments[index];
  PixelMoments of_nets;
  for (std::size_t k = 0; k < nets; ++k) of_nets.add_replicate(moments[index * nets + k]);
  return of_nets;
}

Film RenderState::film() const {
  Film film(width, height);
  for (std::size_t i = 0; i < film.pixels().size(); ++i) film.pixels()[i] = pixel(i);
  return film;
}

Film RenderState::take_film() {
  const std::size_t pixels = moments.size() / moments_per_pixel();
  for (std::size_t i = 0; i < pixels; ++i) moments[i] = pixel(i);  // no later one reads there
  moments.resize(pixels);
  return {width, height, std::move(moments)};
}

Film RenderState::samples() const {
  Film all(width, height);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    all.pixels()[i / moments_per_pixel()].merge(moments[i]);
  }
  return all;
}

RenderState fresh_state(int width, int height, const SamplingOptions& options) {
  RenderState state;
  state.width = width;
  state.height = height;
  if (options.sampler == SamplerType::sobol) state.nets = options.replicates;
  state.drawn.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  state.moments.resize(state.drawn.size() * state.moments_per_pixel());
  return state;
}

Slice::Slice(const Interruptions& interruptions)
    : interruptions_(interruptions), start_(std::chrono::steady_clock::now()) {}

double Slice::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

std::unique_ptr<PixelSampler> make_scalar_sampler(const Scene& scene, const PathOptions& path,
                                                  SamplerType sampler, std::uint64_t seed) {
  return std::make_unique<ScalarSampler>(scene, path, sampler, seed);
}

void require_known_error(const SamplingOptions& options) {
  if (options.sampler == SamplerType::sobol && options.relative_error > 0 &&
      options.replicates < 2) {
    throw InputError("an error limit needs at least 2 replicates of Sobol points to see an error");
  }
}

LoopResult run_render_loop(const Camera& camera, const SamplingOptions& options,
                           const SamplerFactory& make_sampler) {
  require_known_error(options);
  return RenderLoop(camera, options, make_sampler).run();
}

}  // namespace plumbline::renderer
