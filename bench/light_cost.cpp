#include "light_cost.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include "clock.h"
#include "publish.h"
#include "scenes.h"
#include "statistics.h"

namespace plumbline::bench {
namespace {

/// One strategy's side of the comparison.
struct Side {
  renderer::RenderOptions options;
  renderer::PathCounters counters;
  std::vector<double> ns_per_path;
};

double per_path(std::uint64_t rays, const renderer::PathCounters& counters) {
  return static_cast<double>(rays) / static_cast<double>(counters.camera_rays);
}

double rays_per_path(const renderer::PathCounters& c) {
  return per_path(c.camera_rays + c.bounce_rays + c.shadow_rays, c);
}

std::vector<std::string> measure(const NamedScene& lit, std::uint32_t samples, int repetitions) {
  const auto description = load_at_size(lit.name, 96, 96);
  const renderer::Scene scene = renderer::make_scene(description);
  Side with, without;
  with.options.path = {.strategy = renderer::Strategy::mis,
                       .max_depth = description.integrator.max_depth,
                       .rr_depth = description.integrator.rr_depth};
  with.options.samples_per_pixel = samples;
  with.options.threads = 1;
  without.options = with.options;
  without.options.path.strategy = renderer::Strategy::bsdf;
  std::vector<double> ratios;
  for (int i = 0; i < repetitions; ++i) {
    for (Side* side : {&with, &without}) {
      const double seconds =
          seconds_of([&] { side->counters = render(scene, side->options).counters; });
      side->ns_per_path.push_back(1e9 * seconds / static_cast<double>(side->counters.camera_rays));
    }
    ratios.push_back(with.ns_per_path.back() / without.ns_per_path.back());
  }
  const double with_ns = median_with_interval(std::move(with.ns_per_path)).value;
  const double without_ns = median_with_interval(std::move(without.ns_per_path)).value;
  const double shadow_rays = per_path(with.counters.shadow_rays, with.counters);
  return {lit.title,
          fmt::format("{:.2f}", rays_per_path(without.counters)),
          fmt::format("{:.2f}", rays_per_path(with.counters)),
          fmt::format("+{:.0f} %",
                      100 * (rays_per_path(with.counters) / rays_per_path(without.counters) - 1)),
          fmt::format("{:.2f}", shadow_rays),
          fmt::format("{:.0f}", without_ns),
          fmt::format("{:.0f}", with_ns),
          text_of(median_with_interval(std::move(ratios))),
          fmt::format("{:.0f}", (with_ns - without_ns) / shadow_rays)};
}

}  // namespace

void measure_light_cost(reports::ResultLog& log, bool full) {
  reports::Table table;
  table.group = "What light samples cost";
  table.title = "A path with light samples and without";
  table.caption =
      "Strategy mis against bsdf, the same paths: rays and CPU time per path on one thread, "
      "interleaved. Beside its shadow ray a light sample costs the choice of a point, a BSDF "
      "evaluation and the weights.";
  table.columns = {
      "scene",          "rays without",         "rays with",
      "more rays",      "of which shadow rays", "without [ns/path]",
      "with [ns/path]", "time with / without",  "ns per light sample that asks a shadow ray"};
  for (const NamedScene& scene : kTracedScenes) {
    table.rows.push_back(measure(scene, full ? 8 : 4, full ? 21 : 7));
  }
  publish(log, table);
}

}  // namespace plumbline::bench
