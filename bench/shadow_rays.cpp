#include "shadow_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/core/scene/geometry.h>
#include <plumbline/renderer/core/scene/scene.h>
#include "clock.h"
#include "light_cost.h"
#include "publish.h"
#include "ray_calls.h"
#include "scenes.h"
#include "statistics.h"

namespace plumbline::bench {
namespace {

using renderer::Ray;
using renderer::Scene;

constexpr std::size_t kRays = 1 << 15;
constexpr std::size_t kFewestRays = 1000;  // a class with fewer is not representative
constexpr std::array kWidths{1, 8, 16};

/// Shadow rays of the light samples at camera hits and at one diffuse bounce. Those of a depth
/// stand together, pixel after pixel: the order in which packets are filled.
std::vector<Ray> record_shadow_rays(const Scene& scene) {
  std::array<std::vector<Ray>, 2> rays;
  const int width = scene.camera().width(), height = scene.camera().height();
  for (std::uint64_t sample = 0; rays[0].size() + rays[1].size() < kRays && sample < 64; ++sample) {
    for (int pixel = 0; pixel < width * height; ++pixel) {
      renderer::Pcg32 random(1, static_cast<std::uint64_t>(pixel), sample);
      const renderer::Vec2f film = random.next_2d();
      const int x = pixel % width, y = pixel / width;
      Ray ray = scene.camera().ray(x, y, film);
      for (std::vector<Ray>& of_depth : rays) {
        const auto hit = scene.intersect(ray);
        if (!hit) break;
        const auto light = scene.lights().sample(hit->position, random.next_2d());
        if (light && dot(hit->normal, light->wi) > 0) {
          const Ray shadow = shadow_ray(*hit, *light);
          if (shadow.t_max > 0) of_depth.push_back(shadow);
        }
        const renderer::Vec3f direction =
            renderer::Frame<float>(hit->normal)
                .to_world(square_to_cosine_hemisphere(random.next_2d()));
        ray = {hit->origin_towards(direction), direction};
      }
    }
  }
  rays[0].insert(rays[0].end(), rays[1].begin(), rays[1].end());
  return rays[0];
}

/// As many of the ones as of the others, in the order of their chance.
std::vector<Ray> half_of_each(const std::vector<Ray>& reaching, const std::vector<Ray>& blocked) {
  const std::size_t n = std::min(reaching.size(), blocked.size());
  std::vector<Ray> mixed;
  std::size_t a = 0, b = 0;
  renderer::Pcg32 random(1, 0, 0);
  while (a < n && b < n) {
    mixed.push_back(random.next_1d() < 0.5f ? reaching[a++] : blocked[b++]);
  }
  return mixed;
}

/// What the same rays cost, with the repetitions of rtcOccluded.
struct MeasuredCost {
  reports::RayCost cost;
  std::vector<double> occluded_ns;
};

MeasuredCost compare(const Scene& scene, const std::vector<Ray>& rays, int width, int repetitions) {
  const RayCalls nearest = RayCalls::pack(rays, Query::nearest, width);
  const RayCalls occluded = RayCalls::pack(rays, Query::occluded, width);
  const auto time = [&](const RayCalls& calls) {
    return 1e9 * seconds_of([&] { calls.replay(scene.geometry().embree_scene()); }) /
           static_cast<double>(rays.size());
  };
  std::vector<double> intersect_ns, occluded_ns, ratios;
  for (int i = 0; i < repetitions; ++i) {
    const bool swap = i % 2 == 1;
    double t_occluded = swap ? time(occluded) : 0;
    const double t_intersect = time(nearest);
    if (!swap) t_occluded = time(occluded);
    intersect_ns.push_back(t_intersect);
    occluded_ns.push_back(t_occluded);
    ratios.push_back(t_occluded / t_intersect);
  }
  const Estimate ratio = median_with_interval(std::move(ratios));
  reports::RayCost cost;
  cost.width = width;
  cost.count = rays.size();
  cost.intersect_ns = median_with_interval(std::move(intersect_ns)).value;
  cost.occluded_ns = median_with_interval(occluded_ns).value;
  cost.ratio = ratio.value;
  cost.ratio_low = ratio.low;
  cost.ratio_high = ratio.high;
  return {cost, std::move(occluded_ns)};
}

/// What the rays that a renderer asks say about "a shadow ray costs 40 to 60 % of a full one".
const char* judge_claim(const reports::RayCost& cost) {
  if (cost.ratio_low >= 0.4 && cost.ratio_high <= 0.6) return "holds";
  if (cost.ratio_low > 0.6) return "no: dearer";
  if (cost.ratio_high < 0.4) return "no: cheaper";
  return "open";
}

/// @return of the rays as rendered, by width
std::vector<reports::RayCost> measure_scene(const NamedScene& named, reports::ResultLog& log,
                                            int repetitions) {
  const Scene scene = make_scene(load_at_size(named.name, 128, 128));
  const std::vector<Ray> all = record_shadow_rays(scene);
  std::vector<Ray> reaching, blocked;
  for (const Ray& ray : all) (scene.occluded(ray) ? blocked : reaching).push_back(ray);
  const double fraction = static_cast<double>(blocked.size()) / static_cast<double>(all.size());

  const auto measure = [&](const std::vector<Ray>& rays, const char* what, double occluded,
                           int width) {
    reports::RayCost cost;
    if (rays.size() < kFewestRays) return cost;
    MeasuredCost measured = compare(scene, rays, width, repetitions);
    if (&rays == &all) {
      keep(log, fmt::format("shadow_rays/{}/{}-wide", named.name, width), "ns/ray",
           std::move(measured.occluded_ns));
    }
    cost = measured.cost;
    cost.scene = named.title;
    cost.rays = what;
    cost.occluded_fraction = occluded;
    log.append(cost);
    fmt::print("  {:14} {:2}-wide {:20} {:5.1f} % occluded: {:.3f} [{:.3f}, {:.3f}]\n", named.title,
               width, what, 100 * occluded, cost.ratio, cost.ratio_low, cost.ratio_high);
    return cost;
  };
  std::vector<reports::RayCost> as_rendered;
  for (const int width : kWidths) {
    as_rendered.push_back(measure(all, "as rendered", fraction, width));
    measure(reaching, "that reach the light", 0, width);
    measure(half_of_each(reaching, blocked), "half of each", 0.5, width);
    measure(blocked, "that are blocked", 1, width);
  }
  return as_rendered;
}

}  // namespace

void measure_shadow_rays(reports::ResultLog& log, bool full) {
  fmt::print("shadow rays: rtcOccluded over rtcIntersect\n");
  reports::Table claim;
  claim.group = "What light samples cost";
  claim.title = "The claim that a shadow ray costs 40 to 60 % of a full one";
  claim.caption =
      "rtcOccluded over rtcIntersect on the shadow rays as rendered, by rays per call, with 95 % "
      "intervals. Holds: the whole interval lies in 0.4 to 0.6.";
  claim.columns = {"scene", "occluded"};
  for (const int width : kWidths) {
    claim.columns.push_back(fmt::format("{}-wide", width));
    claim.columns.emplace_back("claim");
  }
  for (const NamedScene& scene : kTracedScenes) {
    const auto costs = measure_scene(scene, log, full ? 31 : 7);
    std::vector<std::string> row{scene.title,
                                 fmt::format("{:.0f} %", 100 * costs[0].occluded_fraction)};
    for (const reports::RayCost& cost : costs) {
      row.push_back(text_of({cost.ratio, cost.ratio_low, cost.ratio_high}));
      row.emplace_back(judge_claim(cost));
    }
    claim.rows.push_back(std::move(row));
  }
  publish(log, claim);
  measure_light_cost(log, full);
}

}  // namespace plumbline::bench
