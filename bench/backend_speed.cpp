#include "backend_speed.h"

#include <fmt/format.h>

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

struct BackendWork {
  int side = 96;
  std::uint32_t samples = 4;  ///< per pixel
  int repetitions = 7;
};

struct BackendComparison {
  double batched_ns, scalar_ns;  // per path, medians
  Estimate speed;                // of the batches over the plain loop
};

BackendComparison compare(const NamedScene& named, const BackendWork& work,
                          reports::ResultLog& log) {
  const auto description = load_at_size(named.name, work.side, work.side);
  const renderer::Scene scene = renderer::make_scene(description);
  renderer::RenderOptions options;
  options.path.max_depth = description.integrator.max_depth;
  options.path.rr_depth = description.integrator.rr_depth;
  options.sampler = renderer::SamplerType::sobol;
  options.samples_per_pixel = work.samples;
  options.threads = 1;  // this one
  const auto ns_per_path = [&](renderer::Backend backend) {
    options.backend = backend;
    const double paths = static_cast<double>(work.side) * work.side * work.samples;
    return 1e9 * seconds_of([&] { render(scene, options); }) / paths;
  };
  std::vector<double> batched, scalar, ratios;
  for (int i = 0; i < work.repetitions; ++i) {
    batched.push_back(ns_per_path(renderer::Backend::batched));
    scalar.push_back(ns_per_path(renderer::Backend::scalar));
    ratios.push_back(scalar.back() / batched.back());
  }
  const std::string name = fmt::format("backend_speed/{}/{} spp", named.name, work.samples);
  keep(log, name + "/batched", "ns/path", batched);
  keep(log, name + "/scalar", "ns/path", scalar);
  return {median_with_interval(std::move(batched)).value,
          median_with_interval(std::move(scalar)).value, median_with_interval(std::move(ratios))};
}

}  // namespace

void measure_backend_speed(reports::ResultLog& log, bool full) {
  const BackendWork work = full ? BackendWork{128, 8, 21} : BackendWork{};
  reports::Table table;
  table.group = "Ray-replay limit";
  table.title = "Batches of paths against one path after the other";
  table.caption = fmt::format(
      "render() with both backends in turn, mis with Sobol points, {0} × {0} pixels, {1} samples "
      "each: CPU time on one thread, medians of {2} repetitions with 95 % intervals.",
      work.side, work.samples, work.repetitions);
  table.columns = {"scene", "batched [ns/path]", "plain loop [ns/path]", "plain / batched"};
  for (const NamedScene& scene : kTracedScenes) {
    const BackendComparison c = compare(scene, work, log);
    table.rows.push_back({scene.title, fmt::format("{:.0f}", c.batched_ns),
                          fmt::format("{:.0f}", c.scalar_ns), text_of(c.speed)});
    if (scene.name != std::string("cornell")) continue;
    reports::Bar bar;
    bar.name = "Batched over plain loop, Cornell box";
    bar.unit = "times the speed";
    bar.at_least = true;
    bar.limit = 2;
    bar.measured = c.speed.value;
    bar.low = c.speed.low;
    bar.high = c.speed.high;
    bar.note = fmt::format(
        "render() alone, {0}×{0}, {1} samples per pixel, one thread, {2} "
        "repetitions in turn",
        work.side, work.samples, work.repetitions);
    publish(log, bar);
  }
  publish(log, table);
}

}  // namespace plumbline::bench
