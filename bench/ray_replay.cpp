#include "ray_replay.h"

#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/scene/geometry.h>
#include "backend_speed.h"
#include "clock.h"
#include "publish.h"
#include "ray_calls.h"
#include "scenes.h"
#include "statistics.h"

namespace plumbline::bench {
namespace {

using renderer::Scene;

struct ReplayedScene {
  const char *name, *title;
  int width, height;
  std::uint32_t samples;
};

constexpr ReplayedScene kScenes[] = {{"cornell", "Cornell box", 128, 128, 4},
                                     {"veach", "Veach's plates", 160, 120, 4},
                                     {"displaced_sphere", "1M triangles", 128, 128, 4},
                                     {"many_spheres", "100k spheres", 96, 96, 4}};

struct RayShares {
  double rays_per_path, rays_per_call;
  double render_ns, replay_ns;  // per path, medians
  Estimate share, one_wide;     // of the render: as recorded, and one ray per call
};

RayShares measure(const ReplayedScene& replayed, int repetitions, reports::ResultLog& log) {
  auto description = load_at_size(replayed.name, replayed.width, replayed.height);
  description.accelerator = renderer::Accelerator::embree;  // whose calls are recorded
  const Scene scene = make_scene(description);
  renderer::RenderOptions options;
  options.path.max_depth = description.integrator.max_depth;
  options.path.rr_depth = description.integrator.rr_depth;
  options.sampler = renderer::SamplerType::sobol;
  options.samples_per_pixel = replayed.samples;
  options.threads = 1;  // this one, so that there is one order

  RayCalls recorded;
  renderer::PathCounters counted;
  {
    const RayRecording recording(recorded);
    counted = render(scene, options).counters;
  }
  // Shadow rays of no length are counted and not asked.
  if (recorded.rays() == 0 ||
      recorded.rays() > counted.camera_rays + counted.bounce_rays + counted.shadow_rays) {
    throw std::logic_error("the recording does not hold the rays of the render");
  }
  const RayCalls one_wide = recorded.one_wide();
  std::vector<double> render_times, replay_times, shares, one_wide_shares;
  for (int i = 0; i < repetitions; ++i) {
    render_times.push_back(seconds_of([&] { render(scene, options); }));
    replay_times.push_back(seconds_of([&] { recorded.replay(scene.geometry().embree_scene()); }));
    const double single = seconds_of([&] { one_wide.replay(scene.geometry().embree_scene()); });
    shares.push_back(replay_times.back() / render_times.back());
    one_wide_shares.push_back(single / render_times.back());
  }
  const double paths = static_cast<double>(replayed.width) * replayed.height * replayed.samples;
  const auto rays = static_cast<double>(recorded.rays());
  std::vector<double> render_ns;
  for (const double seconds : render_times) render_ns.push_back(seconds * 1e9 / paths);
  keep(log, fmt::format("ray_replay/{}/render", replayed.name), "ns/path", std::move(render_ns));
  log.append(
      reports::Counter{fmt::format("ray_replay/{}/rays", replayed.name), "rays", recorded.rays()});
  return {rays / paths,
          rays / static_cast<double>(recorded.calls()),
          median_with_interval(std::move(render_times)).value * 1e9 / paths,
          median_with_interval(std::move(replay_times)).value * 1e9 / paths,
          median_with_interval(std::move(shares)),
          median_with_interval(std::move(one_wide_shares))};
}

reports::Bar bar(const std::string& name, double limit, const Estimate& share, std::string note) {
  reports::Bar result;
  result.name = name;
  result.unit = "share";
  result.at_least = true;
  result.limit = limit;
  result.measured = share.value;
  result.low = share.low;
  result.high = share.high;
  result.note = std::move(note);
  return result;
}

}  // namespace

void measure_ray_replay(reports::ResultLog& log, bool full) {
  const int repetitions = full ? 15 : 7;
  reports::Table table;
  table.group = "Ray-replay limit";
  table.title = "Share of Embree in a render";
  table.caption =
      "All rays of a render (mis, Sobol), asked again of Embree alone in the same order and "
      "widths: time of the replay over that of the render, medians of interleaved repetitions with "
      "95 % intervals, CPU time on one thread. One by one: the same with one ray per call; above 1 "
      "the packets of the render beat it.";
  table.columns = {"scene",
                   "rays per path",
                   "rays per call",
                   "render [ns/path]",
                   "replay [ns/path]",
                   "replay / render",
                   "one by one / render"};
  for (const ReplayedScene& scene : kScenes) {
    const RayShares s = measure(scene, repetitions, log);
    table.rows.push_back({scene.title, fmt::format("{:.2f}", s.rays_per_path),
                          fmt::format("{:.1f}", s.rays_per_call),
                          fmt::format("{:.0f}", s.render_ns), fmt::format("{:.0f}", s.replay_ns),
                          text_of(s.share), text_of(s.one_wide)});
    const std::string how = fmt::format("{}×{}, {} samples per pixel, {} repetitions", scene.width,
                                        scene.height, scene.samples, repetitions);
    if (scene.name == std::string("cornell")) {
      publish(log, bar("Ray replay / render, Cornell box", 0.6, s.share, how));
    }
    if (scene.name == std::string("displaced_sphere")) {
      publish(log, bar("Rays one by one / render, 1M triangles", 0.8, s.one_wide, how));
    }
  }
  publish(log, table);
  measure_backend_speed(log, full);
}

}  // namespace plumbline::bench
