#include <benchmark/benchmark.h>

#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/direct.h>
#include <plumbline/renderer/assembly/render.h>
#include "allocation.h"
#include "clock.h"

namespace plumbline::bench {
namespace {

double seconds_of_technique(const renderer::Scene& scene, std::size_t technique) {
  constexpr int kSamplesPerPixel = 100;
  renderer::Pcg32 random(1, 0, 0);
  renderer::PathCounters counters;
  const double start = thread_seconds();
  for (int y = 0; y < scene.camera().height(); ++y) {
    for (int x = 0; x < scene.camera().width(); ++x) {
      for (int s = 0; s < kSamplesPerPixel; ++s) {
        const renderer::Vec2f film = random.next_2d();
        const renderer::Ray ray = scene.camera().ray(x, y, film);
        benchmark::DoNotOptimize(
            sample_direct_light(scene, ray, technique, random.next_2d(), counters));
      }
    }
  }
  return thread_seconds() - start;
}

struct Timing {
  double seconds, bsdf_share;
};

Timing time_of_policy(const renderer::Scene& scene, renderer::Allocation policy,
                      double cost_ratio) {
  renderer::RenderOptions options;
  options.path.max_depth = 2;
  options.samples_per_pixel = kIterations * kIterationSamples;
  options.threads = 1;  // this one
  options.allocation = {.policy = policy, .iterations = kIterations, .cost_ratio = cost_ratio};
  const double start = thread_seconds();
  const renderer::RenderResult result = render(scene, options);
  const double seconds = thread_seconds() - start;
  double bsdf = 0;
  for (const std::uint32_t n : result.bsdf_counts) bsdf += n;
  const auto pixels = static_cast<double>(result.film.pixels().size());
  return {seconds, bsdf / (pixels * options.samples_per_pixel)};
}

renderer::Scene load_to_time(const AllocationScene& scene, AllocationWork work) {
  work.width = work.cost_width;
  work.height = work.cost_height;
  return renderer::make_scene(load(scene, work));
}

}  // namespace

Estimate measure_cost_ratio(const AllocationScene& scene, const AllocationWork& work) {
  const renderer::Scene built = load_to_time(scene, work);
  std::vector<double> ratios;
  for (int i = 0; i < 3 * work.cost_repetitions; ++i) {
    const double light = seconds_of_technique(built, renderer::kLightTechnique);
    ratios.push_back(seconds_of_technique(built, renderer::kBsdfTechnique) / light);
  }
  return median_with_interval(std::move(ratios));
}

std::vector<PolicyCost> measure_policy_costs(const AllocationScene& scene,
                                             const AllocationWork& work, double cost_ratio) {
  const renderer::Scene built = load_to_time(scene, work);
  constexpr std::size_t kPolicies = std::size(renderer::kAllocations);
  std::vector<std::vector<double>> ratios(kPolicies);
  std::vector<PolicyCost> costs(kPolicies);
  for (int i = 0; i < work.cost_repetitions; ++i) {
    for (std::size_t p = 0; p < kPolicies; ++p) {
      // Beside each its own `equal`, so that a change of clock hits both.
      const double equal = time_of_policy(built, renderer::Allocation::equal, 1).seconds;
      const Timing timing = time_of_policy(built, renderer::kAllocations[p], cost_ratio);
      ratios[p].push_back(timing.seconds / equal);
      costs[p].bsdf_share = timing.bsdf_share;
    }
  }
  for (std::size_t p = 0; p < kPolicies; ++p) {
    costs[p].method = name(renderer::kAllocations[p]);
    costs[p].ratio = median_with_interval(std::move(ratios[p]));
  }
  return costs;
}

}  // namespace plumbline::bench
