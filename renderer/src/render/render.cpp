#include <plumbline/renderer/render/render.h>

#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <span>

#include <plumbline/renderer/render/direct.h>
#include "batch.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace plumbline::renderer {
namespace {

/// Flush-to-zero and denormals-are-zero while in scope, as Embree asks for; render threads only.
class FlushToZero {
 public:
#if defined(__SSE2__)
  FlushToZero() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
  ~FlushToZero() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
#endif
};

/// Reports progress from whichever thread is free to, one at a time.
class Progress {
 public:
  Progress(const std::function<void(double)>& report, std::uint64_t total)
      : report_(report), total_(total) {}

  void advance(std::uint64_t samples) {
    const std::uint64_t done = done_.fetch_add(samples, std::memory_order_relaxed) + samples;
    if (!report_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) report_(static_cast<double>(done) / static_cast<double>(total_));
  }

 private:
  const std::function<void(double)>& report_;
  std::uint64_t total_;
  std::atomic<std::uint64_t> done_ = 0;
  std::mutex mutex_;
};

/// What one thread works with.
struct Worker {
  PathCounters counters;
  std::unique_ptr<BatchTracer> batch;  // none: one path after the other
  std::vector<PixelMoments*> targets;  // of the paths in it
};

class Renderer {
  using Range = oneapi::tbb::blocked_range2d<int>;

 public:
  Renderer(const Scene& scene, const RenderOptions& options)
      : scene_(scene),
        options_(options),
        thread_limit_(oneapi::tbb::global_control::max_allowed_parallelism,
                      static_cast<std::size_t>(thread_count(options.threads))),
        arena_(thread_count(options.threads)),
        film_(scene.camera().width(), scene.camera().height()),
        dealt_(options.sampler == SamplerType::sobol ? film_.pixels().size() * options.replicates
                                                     : 0),
        progress_(options.progress, film_.pixels().size() * options.samples_per_pixel) {
    if (options.allocation) {
      bsdf_counts_.resize(film_.pixels().size() * options.allocation->iterations);
    }
  }

  RenderResult run() {
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
    RenderResult result{std::move(film_), {}, done, elapsed(), std::move(bsdf_counts_)};
    for (const Worker& worker : workers_) result.counters += worker.counters;
    return result;
  }

 private:
  static int thread_count(int requested) {
    return requested > 0 ? requested : oneapi::tbb::info::default_concurrency();
  }

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
    const std::size_t side = tile_side(samples);
    const Range tiles(0, film_.height(), side, 0, film_.width(), side);
    arena_.execute([&] {
      oneapi::tbb::parallel_for(tiles, [&](const Range& tile) {
        const FlushToZero flush_to_zero;
        Worker& worker = local_worker();
        for_each_pixel(tile, [&](int x, int y) {
          if (options_.allocation) {
            allocate_pixel(x, y, worker.counters);
          } else {
            render_pixel(x, y, first_sample, samples, worker);
          }
        });
        if (worker.batch) finish(worker);
        if (!dealt_.empty()) for_each_pixel(tile, [&](int x, int y) { sum_replicates(x, y); });
        progress_.advance(tile.rows().size() * tile.cols().size() * samples);
      });
    });
  }

  template <class Function>
  static void for_each_pixel(const Range& tile, const Function& function) {
    for (int y = tile.rows().begin(); y < tile.rows().end(); ++y) {
      for (int x = tile.cols().begin(); x < tile.cols().end(); ++x) function(x, y);
    }
  }

  /// Small enough that threads end together, large enough that a pass of few samples fills a batch.
  static std::size_t tile_side(std::uint32_t samples) {
    std::size_t side = 8;
    while (side * side * samples < kBatch) side *= 2;
    return side;
  }

  Worker& local_worker() {
    bool exists = false;
    Worker& worker = workers_.local(exists);
    if (!exists && options_.backend == Backend::batched && !options_.allocation) {
      worker.batch = BatchTracer::make(scene_, options_.path, options_.sampler, options_.seed);
    }
    return worker;
  }

  void render_pixel(int x, int y, std::uint32_t first_sample, std::uint32_t samples,
                    Worker& worker) {
    const std::size_t pixel = film_.index(x, y);
    const std::uint32_t replicates = dealt_.empty() ? 1 : options_.replicates;
    for (std::uint32_t s = first_sample; s < first_sample + samples; ++s) {
      const std::uint64_t net = pixel * replicates + s % replicates, index = s / replicates;
      PixelMoments& moments = dealt_.empty() ? film_.pixels()[pixel] : dealt_[net];
      if (worker.batch) {
        if (worker.batch->size() == kBatch) finish(worker);
        worker.batch->start(x, y, net, index);
        worker.targets.push_back(&moments);
      } else {
        Sampler random(options_.sampler, options_.seed, net, index);
        const Ray ray = scene_.camera().ray(x, y, random.next_2d());
        moments.add(estimate_radiance(scene_, options_.path, ray, random, worker.counters));
      }
    }
  }

  /// Ends the paths of a batch; their samples arrive in the order in which they were started.
  static void finish(Worker& worker) {
    const std::span<const Rgbf> radiance = worker.batch->trace(worker.counters);
    for (std::size_t i = 0; i < radiance.size(); ++i) worker.targets[i]->add(radiance[i]);
    worker.targets.clear();
  }

  void sum_replicates(int x, int y) {
    const std::size_t index = film_.index(x, y);
    PixelMoments& pixel = film_.pixels()[index];
    pixel = {};
    const auto dealt = std::span(dealt_).subspan(index * options_.replicates, options_.replicates);
    for (const PixelMoments& replicate : dealt) pixel.add_replicate(replicate);
  }

  void allocate_pixel(int x, int y, PathCounters& counters) {
    const std::size_t index = film_.index(x, y);
    PixelMoments& pixel = film_.pixels()[index];
    std::uint32_t* bsdf_counts = &bsdf_counts_[index * options_.allocation->iterations];
    Pcg32 random(options_.seed, index, 0);
    Rgbf emission;
    const auto draw = [&](std::size_t technique) {
      const Vec2f jitter = random.next_2d();
      const Ray ray = scene_.camera().ray(x, y, jitter);
      const DirectSample sample =
          sample_direct_light(scene_, ray, technique, random.next_2d(), counters);
      emission = sample.emission;
      return TechniqueSample<Rgbd>{rgb_cast<double>(sample.value), static_cast<double>(sample.pdf),
                                   static_cast<double>(sample.other_pdf)};
    };
    const auto record = [&](std::uint32_t iteration, std::size_t technique, const Rgbd& reflected) {
      if (technique == kBsdfTechnique) ++bsdf_counts[iteration];
      pixel.add(emission + rgb_cast<float>(reflected));
    };
    allocate_samples(*options_.allocation, options_.samples_per_pixel, draw, record);
  }

  const Scene& scene_;
  const RenderOptions& options_;
  oneapi::tbb::global_control thread_limit_;  // an arena alone cannot exceed the number of cores
  oneapi::tbb::task_arena arena_;
  Film film_;
  std::vector<PixelMoments> dealt_;  // under Sobol: the replicates of each pixel
  Progress progress_;
  oneapi::tbb::enumerable_thread_specific<Worker> workers_;
  std::vector<std::uint32_t> bsdf_counts_;
};

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

}  // namespace

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

RenderResult render(const Scene& scene, const RenderOptions& options) {
  if (options.path.max_depth < 0 && options.path.rr_depth == kNoRoulette) {
    throw InputError(
        "paths of unlimited depth without Russian roulette may never end: set a maximum depth or a "
        "roulette depth");
  }
  if (options.sampler == SamplerType::sobol && options.relative_error > 0 &&
      options.replicates < 2) {
    throw InputError("an error limit needs at least 2 replicates of Sobol points to see an error");
  }
  if (options.allocation) check_allocation(options);
  return Renderer(scene, options).run();
}

}  // namespace plumbline::renderer
