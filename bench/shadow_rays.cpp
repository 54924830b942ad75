#include "shadow_rays.h"

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/sampling/pcg32.h>
#include <plumbline/renderer/scene/embree.h>
#include <plumbline/renderer/scene/scene.h>
#include "scenes.h"
#include "statistics.h"

namespace plumbline::bench {
namespace {

using renderer::Ray;
using renderer::Scene;

constexpr std::size_t kRays = 1 << 15;
constexpr std::size_t kFewestRays = 1000;  // a class with fewer is not representative

RTCRay embree_ray(const Ray& ray) {
  return {ray.origin.x,
          ray.origin.y,
          ray.origin.z,
          0,
          ray.direction.x,
          ray.direction.y,
          ray.direction.z,
          0,
          ray.t_max,
          ~0u,
          0,
          0};
}

/// Shadow rays of the light samples at camera hits and at one diffuse bounce, as a path has them.
std::vector<Ray> record_shadow_rays(const Scene& scene) {
  std::vector<Ray> rays;
  for (std::uint64_t sample = 0; rays.size() < kRays; ++sample) {
    renderer::Pcg32 random(1, 0, sample);
    const renderer::Vec2f film = random.next_2d();
    Ray ray = scene.camera().ray(film.x * static_cast<float>(scene.camera().width()),
                                 film.y * static_cast<float>(scene.camera().height()));
    for (int bounce = 0; bounce < 2; ++bounce) {
      const auto hit = scene.intersect(ray);
      if (!hit) break;
      const auto light = scene.lights().sample(hit->position, random.next_1d(), random.next_2d());
      if (light && dot(hit->normal, light->wi) > 0) {
        const Ray shadow = shadow_ray(*hit, *light);
        if (shadow.t_max > 0) rays.push_back(shadow);
      }
      const renderer::Vec3f direction =
          renderer::Frame<float>(hit->normal)
              .to_world(square_to_cosine_hemisphere(random.next_2d()));
      ray = hit->ray_along(direction);
    }
    // A scene without shadow rays would never end.
    if (sample > 100 * kRays) break;
  }
  return rays;
}

template <class Query>
double nanoseconds_per_ray(const std::vector<Ray>& rays, const Query& query) {
  const auto start = std::chrono::steady_clock::now();
  for (const Ray& ray : rays) query(ray);
  const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
  return time.count() / static_cast<double>(rays.size());
}

reports::RayCost compare(const Scene& scene, const std::vector<Ray>& rays, int repetitions) {
  const auto intersect = [&](const Ray& ray) {
    RTCRayHit hit{};
    hit.ray = embree_ray(ray);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    renderer::embree::intersect(scene.embree_scene(), hit);
    benchmark::DoNotOptimize(hit.ray.tfar);
  };
  const auto occluded = [&](const Ray& ray) {
    RTCRay r = embree_ray(ray);
    renderer::embree::occluded(scene.embree_scene(), r);
    benchmark::DoNotOptimize(r.tfar);
  };
  std::vector<double> intersect_ns, occluded_ns, ratios;
  for (int i = 0; i < repetitions; ++i) {
    const bool swap = i % 2 == 1;
    double t_occluded = swap ? nanoseconds_per_ray(rays, occluded) : 0;
    const double t_intersect = nanoseconds_per_ray(rays, intersect);
    if (!swap) t_occluded = nanoseconds_per_ray(rays, occluded);
    intersect_ns.push_back(t_intersect);
    occluded_ns.push_back(t_occluded);
    ratios.push_back(t_occluded / t_intersect);
  }
  const Estimate ratio = median_with_interval(std::move(ratios));
  reports::RayCost cost;
  cost.count = rays.size();
  cost.intersect_ns = median_with_interval(std::move(intersect_ns)).value;
  cost.occluded_ns = median_with_interval(std::move(occluded_ns)).value;
  cost.ratio = ratio.value;
  cost.ratio_low = ratio.low;
  cost.ratio_high = ratio.high;
  return cost;
}

void measure_scene(const std::string& name, reports::ResultLog& log, int repetitions) {
  const Scene scene(load_at_size(name, 256, 192));
  const std::vector<Ray> all = record_shadow_rays(scene);
  std::vector<Ray> reaching, blocked;
  for (const Ray& ray : all) (scene.occluded(ray) ? blocked : reaching).push_back(ray);
  const double fraction = static_cast<double>(blocked.size()) / static_cast<double>(all.size());

  const auto measure = [&](const std::vector<Ray>& rays, const char* what, double occluded) {
    if (rays.size() < kFewestRays) return;
    reports::RayCost cost = compare(scene, rays, repetitions);
    cost.scene = name;
    cost.rays = what;
    cost.occluded_fraction = occluded;
    log.append(cost);
    fmt::print("  {:14} {:22} {:5.1f} % occluded: occluded/intersect = {:.3f} [{:.3f}, {:.3f}]\n",
               name, what, 100 * occluded, cost.ratio, cost.ratio_low, cost.ratio_high);
  };
  measure(all, "as rendered", fraction);
  measure(reaching, "that reach the light", 0);
  measure(blocked, "that are blocked", 1);
}

}  // namespace

void measure_shadow_rays(reports::ResultLog& log, bool full) {
  fmt::print("shadow rays, 1-wide: rtcOccluded against rtcIntersect\n");
  const int repetitions = full ? 101 : 25;
  for (const char* name : {"cornell", "sphere_light", "small_light", "furnace_sphere"}) {
    measure_scene(name, log, repetitions);
  }
}

}  // namespace plumbline::bench
