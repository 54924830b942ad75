#include "speed_error.h"

#include <fmt/core.h>

#include <array>
#include <string>
#include <vector>

#include <plumbline/renderer/render/render.h>
#include "scenes.h"
#include "statistics.h"

namespace plumbline::bench {
namespace {

using renderer::Heuristic;
using renderer::SamplerType;
using renderer::Scene;
using renderer::Strategy;

constexpr std::array kHeuristics{Heuristic::balance, Heuristic::power};

struct Work {
  int width = 64, height = 48;
  int replicates = 16;
  std::uint32_t most_samples = 64;
  std::uint32_t reference_samples = 4096;
};

reports::SpeedPoint measure(const Scene& scene, renderer::RenderOptions options,
                            const std::vector<double>& reference, int replicates) {
  std::vector<double> errors;
  double seconds = 0;
  std::uint64_t rays = 0;
  for (int i = 0; i < replicates; ++i) {
    options.seed = static_cast<std::uint64_t>(i) + 1;
    const renderer::RenderResult result = render(scene, options);
    errors.push_back(rel_mse(luminances(result.film), reference));
    seconds += result.seconds / replicates;
    rays += result.counters.camera_rays + result.counters.bounce_rays + result.counters.shadow_rays;
  }
  const Estimate error = mean_with_interval(errors);
  reports::SpeedPoint point;
  point.sampler = std::string(renderer::name(options.sampler));
  point.samples_per_pixel = options.samples_per_pixel;
  point.seconds = seconds;
  point.rays = rays / static_cast<std::uint64_t>(replicates);
  point.rel_mse = error.value;
  point.rel_mse_low = error.low;
  point.rel_mse_high = error.high;
  point.replicates = static_cast<std::uint64_t>(replicates);
  return point;
}

/// Error at growing numbers of samples.
void measure_curve(const std::string& name, const Scene& scene, renderer::RenderOptions options,
                   const std::vector<double>& reference, const Work& work,
                   reports::ResultLog& log) {
  const Strategy strategy = options.path.strategy;
  for (std::uint32_t samples = 1; samples <= work.most_samples; samples *= 4) {
    options.samples_per_pixel = samples;
    reports::SpeedPoint point = measure(scene, options, reference, work.replicates);
    point.scene = name;
    point.strategy = std::string(renderer::name(strategy));
    if (uses_heuristic(strategy)) {
      point.heuristic = std::string(renderer::name(options.path.heuristic.heuristic));
    }
    log.append(point);
    if (samples == work.most_samples) {
      fmt::print("  {:14} {:10} {:8} {:11} {:4} spp  {:8.4f} s  relMSE {:.3e}  relMSE x s {:.3e}\n",
                 name, point.strategy, point.heuristic, point.sampler, samples, point.seconds,
                 point.rel_mse, point.rel_mse * point.seconds);
    }
  }
}

void measure_scene(const std::string& name, const Work& work, reports::ResultLog& log) {
  const auto description = load_at_size(name, work.width, work.height);
  const Scene scene(description);
  const auto reference = reference_luminance(name, description, work.reference_samples);
  for (const Strategy strategy : renderer::kStrategies) {
    if (strategy == Strategy::average) continue;  // a negative control
    for (const Heuristic heuristic : kHeuristics) {
      if (!uses_heuristic(strategy) && heuristic != kHeuristics.front()) continue;
      for (const SamplerType sampler : renderer::kSamplers) {
        // Sobol for the strategy of everyday use only: the minutes are short.
        if (sampler == SamplerType::sobol && strategy != Strategy::mis) continue;
        renderer::RenderOptions options;
        options.path = {strategy, heuristic, description.integrator.max_depth,
                        description.integrator.rr_depth};
        options.sampler = sampler;
        measure_curve(name, scene, options, reference, work, log);
      }
    }
  }
}

}  // namespace

void measure_speed_against_error(reports::ResultLog& log, bool full) {
  fmt::print("speed against error: relMSE and seconds of one render\n");
  Work work;
  if (full) {
    work = {.width = 128,
            .height = 96,
            .replicates = 32,
            .most_samples = 1024,
            .reference_samples = 65536};
  }
  for (const char* name : {"sphere_light", "furnace_cube", "small_light", "large_light"}) {
    measure_scene(name, work, log);
  }
}

}  // namespace plumbline::bench
