#include "speed_error.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/assembly/render.h>
#include "clock.h"
#include "publish.h"
#include "scenes.h"
#include "statistics.h"

namespace plumbline::bench {
namespace {

using renderer::RenderOptions;
using renderer::SamplerType;
using renderer::Scene;
using renderer::Strategy;

struct CurveWork {
  int width = 12, height = 12;
  std::uint32_t most_samples = 64;
  std::uint32_t reference_samples = 4096;
};

constexpr int kCurveReplicates = 16;
constexpr std::uint32_t kFewestAllocated = 64;  // samples per pixel that a policy can learn from

/// One way to render a scene, and what it came to at growing numbers of samples.
struct Curve {
  RenderOptions options;
  std::vector<reports::SpeedPoint> points;
  std::vector<double> seconds;  ///< of each replicate of the last point
};

reports::SpeedPoint describe(const std::string& scene, const RenderOptions& options) {
  reports::SpeedPoint point;
  point.scene = scene;
  point.sampler = std::string(renderer::name(options.sampler));
  if (options.allocation) {
    point.strategy = "allocation";
    point.heuristic = std::string(renderer::name(options.allocation->policy));
  } else {
    point.strategy = std::string(renderer::name(options.path.strategy));
    if (uses_heuristic(options.path.strategy)) {
      point.heuristic = std::string(renderer::name(options.path.heuristic.heuristic));
    }
  }
  point.samples_per_pixel = options.samples_per_pixel;
  point.replicates = kCurveReplicates;
  return point;
}

reports::SpeedPoint measure(const std::string& name, const Scene& scene, RenderOptions options,
                            const std::vector<double>& reference, std::vector<double>& seconds) {
  reports::SpeedPoint point = describe(name, options);
  seconds.clear();
  std::vector<double> errors;
  double rays = 0;
  for (int i = 0; i < kCurveReplicates; ++i) {
    options.seed = static_cast<std::uint64_t>(i) + 1;
    const double start = thread_seconds();
    const renderer::RenderResult result = render(scene, options);
    seconds.push_back(thread_seconds() - start);
    point.seconds += seconds.back() / kCurveReplicates;
    errors.push_back(rel_mse(luminances(result.film), reference));
    const renderer::PathCounters& c = result.counters;
    rays += static_cast<double>(c.camera_rays + c.bounce_rays + c.shadow_rays) / kCurveReplicates;
  }
  const Estimate error = mean_with_interval(errors);
  point.rays = static_cast<std::uint64_t>(rays);
  point.rel_mse = error.value;
  point.rel_mse_low = error.low;
  point.rel_mse_high = error.high;
  return point;
}

void measure_curve(const std::string& name, const Scene& scene,
                   const std::vector<double>& reference, const CurveWork& work, Curve& curve) {
  RenderOptions options = curve.options;
  const std::uint32_t fewest = options.allocation ? kFewestAllocated : 1;
  for (std::uint32_t samples = fewest; samples <= work.most_samples; samples *= 4) {
    options.samples_per_pixel = samples;
    if (options.allocation) options.allocation->iterations = std::max(2u, samples / 50);
    curve.points.push_back(measure(name, scene, options, reference, curve.seconds));
  }
}

/// Every strategy with every heuristic and sampler; for direct light also every allocation.
std::vector<Curve> curves_of(const renderer::SceneDescription& description) {
  RenderOptions options;
  options.path.max_depth = description.integrator.max_depth;
  options.path.rr_depth = description.integrator.rr_depth;
  options.threads = 1;  // the caller's: there is one per core
  std::vector<Curve> curves;
  for (const Strategy strategy : renderer::kStrategies) {
    if (strategy == Strategy::average) continue;  // a negative control
    for (const renderer::Heuristic heuristic : renderer::kHeuristics) {
      if (!uses_heuristic(strategy) && heuristic != renderer::kHeuristics.front()) continue;
      options.path.strategy = strategy;
      options.path.heuristic = heuristic;
      for (const SamplerType sampler : renderer::kSamplers) {
        options.sampler = sampler;
        curves.push_back({options, {}, {}});
      }
    }
  }
  if (options.path.max_depth != 2) return curves;
  options.sampler = SamplerType::independent;
  for (const renderer::Allocation policy : renderer::kAllocations) {
    options.allocation = {.policy = policy};
    curves.push_back({options, {}, {}});
  }
  return curves;
}

/// Rays are counted with fixed seeds: the same every night. Times are kept of the estimators that
/// are recommended, lest their number hide what happens to them.
void keep_curve(reports::ResultLog& log, const std::string& scene, Curve& curve) {
  const reports::SpeedPoint& last = curve.points.back();
  const std::string name = fmt::format("speed/{}/{}/{}/{}/{} spp", scene, last.strategy,
                                       last.heuristic, last.sampler, last.samples_per_pixel);
  log.append(reports::Counter{name + "/rays", "rays of a render, mean", last.rays});
  if (last.strategy == "mis") keep(log, name, "s", std::move(curve.seconds));
}

/// One thread per core, each with curves of its own: their times are CPU times.
void measure_scene(const std::string& name, const CurveWork& work, reports::ResultLog& log) {
  const auto description = load_at_size(name, work.width, work.height);
  const Scene scene = make_scene(description);
  const auto reference = reference_luminance(name, description, work.reference_samples);
  std::vector<Curve> curves = curves_of(description);
  std::atomic<std::size_t> next = 0;
  const auto work_off = [&] {
    for (std::size_t i = next++; i < curves.size(); i = next++) {
      measure_curve(name, scene, reference, work, curves[i]);
    }
  };
  std::vector<std::thread> threads(std::max(1u, std::thread::hardware_concurrency()));
  for (std::thread& thread : threads) thread = std::thread(work_off);
  for (std::thread& thread : threads) thread.join();

  for (Curve& curve : curves) {
    for (const reports::SpeedPoint& point : curve.points) log.append(point);
    if (curve.points.empty()) continue;
    keep_curve(log, name, curve);
    const reports::SpeedPoint& last = curve.points.back();
    fmt::print("  {:14} {:10} {:14} {:11} {:4} spp  {:8.4f} s  relMSE {:.3e}  relMSE x s {:.3e}\n",
               name, last.strategy, last.heuristic, last.sampler, last.samples_per_pixel,
               last.seconds, last.rel_mse, last.rel_mse * last.seconds);
  }
}

}  // namespace

void measure_speed_against_error(reports::ResultLog& log, bool full) {
  fmt::print("speed against error: relMSE and CPU time of one render\n");
  CurveWork work;
  if (full) work = {.most_samples = 1024, .reference_samples = 32768};
  for (const char* name : {"veach", "cornell", "sidewalk", "small_light"}) {
    measure_scene(name, work, log);
  }
  if (!full) return;
  for (const char* name : {"large_light", "sphere_light", "rectangle_light", "furnace_cube"}) {
    measure_scene(name, work, log);
  }
}

}  // namespace plumbline::bench
