#include <plumbline/renderer/core/render/render_loop.h>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/core/render/tiles.h>

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

class RenderLoop {
 public:
  RenderLoop(const Camera& camera, const SamplingOptions& options,
             const SamplerFactory& make_sampler)
      : options_(options),
        threads_(options.threads),
        film_(camera.width(), camera.height()),
        dealt_(options.sampler == SamplerType::sobol ? film_.pixels().size() * options.replicates
                                                     : 0),
        progress_(options.progress, film_.pixels().size() * options.samples_per_pixel),
        samplers_(make_sampler) {}

  LoopResult run() {
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    std::uint32_t done = 0;
    while (done < options_.samples_per_pixel) {
      const std::uint32_t samples = next_pass(done, elapsed());
      if (samples == 0) break;
      render_pass(done, samples);
      done += samples;
      if (options_.relative_error > 0 && done > 1 &&
          film_.relative_error() <= options_.relative_error) {
        break;
      }
    }
    LoopResult result{std::move(film_), {}, done, elapsed()};
    for (const auto& sampler : samplers_) result.counters += sampler->counters;
    return result;
  }

 private:
  /// Samples per pixel of the next pass: all at once without a limit to look at, else doubling,
  /// with the last pass cut to the time that is left. 0 ends the render.
  std::uint32_t next_pass(std::uint32_t done, double seconds) const {
    const std::uint32_t left = options_.samples_per_pixel - done;
    if (!(options_.seconds > 0) && !(options_.relative_error > 0)) return left;
    if (done == 0) return 1;
    double samples = std::min<double>(done, left);
    if (options_.seconds > 0) {
      samples = std::min(samples, (options_.seconds - seconds) / seconds * done);
    }
    return samples >= 1 ? static_cast<std::uint32_t>(samples) : 0;
  }

  void render_pass(std::uint32_t first_sample, std::uint32_t samples) {
    threads_.run(film_.width(), film_.height(), tile_side(samples), [&](const Tile& tile) {
      PixelSampler& sampler = *samplers_.local();
      tile.for_each_pixel(
          [&](int x, int y) { render_pixel(x, y, first_sample, samples, sampler); });
      sampler.finish();
      if (!dealt_.empty()) tile.for_each_pixel([&](int x, int y) { sum_replicates(x, y); });
      progress_.advance(tile.pixels() * samples);
    });
  }

  /// Small enough that threads end together.
  static std::size_t tile_side(std::uint32_t samples) {
    std::size_t side = 8;
    while (side * side * samples < kSamplesPerTile) side *= 2;
    return side;
  }

  void render_pixel(int x, int y, std::uint32_t first_sample, std::uint32_t samples,
                    PixelSampler& sampler) {
    const std::size_t pixel = film_.index(x, y);
    const std::uint32_t replicates = dealt_.empty() ? 1 : options_.replicates;
    for (std::uint32_t s = first_sample; s < first_sample + samples; ++s) {
      const std::uint64_t net = pixel * replicates + s % replicates;
      PixelMoments& moments = dealt_.empty() ? film_.pixels()[pixel] : dealt_[net];
      sampler.sample(x, y, net, s / replicates, moments);
    }
  }

  void sum_replicates(int x, int y) {
    const std::size_t index = film_.index(x, y);
    PixelMoments& pixel = film_.pixels()[index];
    pixel = {};
    const auto dealt = std::span(dealt_).subspan(index * options_.replicates, options_.replicates);
    for (const PixelMoments& replicate : dealt) pixel.add_replicate(replicate);
  }

  const SamplingOptions& options_;
  TileThreads threads_;
  Film film_;
  std::vector<PixelMoments> dealt_;  // under Sobol: the replicates of each pixel
  ProgressReport progress_;
  oneapi::tbb::enumerable_thread_specific<std::unique_ptr<PixelSampler>> samplers_;
};

}  // namespace

std::unique_ptr<PixelSampler> make_scalar_sampler(const Scene& scene, const PathOptions& path,
                                                  SamplerType sampler, std::uint64_t seed) {
  return std::make_unique<ScalarSampler>(scene, path, sampler, seed);
}

LoopResult run_render_loop(const Camera& camera, const SamplingOptions& options,
                           const SamplerFactory& make_sampler) {
  if (options.sampler == SamplerType::sobol && options.relative_error > 0 &&
      options.replicates < 2) {
    throw InputError("an error limit needs at least 2 replicates of Sobol points to see an error");
  }
  return RenderLoop(camera, options, make_sampler).run();
}

}  // namespace plumbline::renderer
