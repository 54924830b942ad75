#include "scaling.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/reports/power_fit.h>
#include "publish.h"
#include "scaling_point.h"
#include "scenes.h"
#include "statistics.h"

namespace plumbline::bench {
namespace {

constexpr const char* kGroup = "Scaling";
constexpr double kMega = 1e6, kGiga = 1e9;

struct Axis {
  const char *name, *title;
  std::vector<std::uint64_t> quick, full;
  /// What a value of the axis counts: pixels come as the length of a side.
  double count(std::uint64_t value) const {
    const auto x = static_cast<double>(value);
    return name == std::string("pixels") ? x * x : x;
  }
};

const std::vector<Axis>& axes() {
  static const std::vector<Axis> all = {
      {"samples", "samples per pixel", {1, 4, 16}, {1, 4, 16, 64, 256}},
      {"pixels", "pixels", {64, 128, 256}, {64, 128, 256, 512, 1024}},
      {"triangles",
       "triangles",
       {100, 10'000, 1'000'000},
       {100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000}},
      {"lights", "lights", {1, 100, 10'000}, {1, 10, 100, 1'000, 10'000}},
      {"depth", "path depth", {2, 5, 17}, {2, 3, 5, 9, 17, 33}}};
  return all;
}

std::string exponent(const std::vector<reports::PowerFitPoint>& points) {
  const reports::PowerFit fit = reports::fit_power(points);
  return fmt::format("{:.2f} ± {:.2f}", fit.exponent, fit.exponent_error);
}

/// The points of one axis: rows, curves, and a row of exponents.
struct Collected {
  reports::Table points, exponents;
  reports::Figure time, memory;
};

Collected empty_collection() {
  Collected all;
  all.points.group = all.exponents.group = all.time.group = all.memory.group = kGroup;
  all.points.title = "Time and memory, point by point";
  all.points.caption =
      "Cornell box, 128 × 128, 4 samples per pixel, Sobol, unless the axis says otherwise; "
      "triangles: a displaced sphere over a floor; lights: small spheres over a floor, direct "
      "light "
      "only; depth: without roulette. Each in a process of its own; CPU time of a render on one "
      "thread, median of 3; peak memory is the largest resident set.";
  all.points.columns = {"axis", "value", "build [s]", "render [s]", "peak [MB]"};
  all.exponents.title = "Fitted exponents";
  all.exponents.caption =
      "y = factor · x^exponent, least squares in log–log, with its standard error; memory above "
      "that "
      "of the smallest process.";
  all.exponents.columns = {"axis", "from", "to", "build time", "render time", "memory"};
  all.time.title = "Time of a render";
  all.time.x = all.memory.x = {"samples, pixels, triangles, lights, depth", true};
  all.time.y = {"CPU time [s]", true};
  all.memory.title = "Peak memory";
  all.memory.y = {"resident set [MB]", true};
  return all;
}

void measure_axis(const Axis& axis, const std::vector<std::uint64_t>& values, double base_bytes,
                  Collected& all) {
  std::vector<reports::PowerFitPoint> build, render, memory;
  reports::FigureSeries time_series{axis.title, {}, {}, {}, {}, {}};
  reports::FigureSeries memory_series = time_series;
  for (const std::uint64_t value : values) {
    const PointCost cost = run_scaling_point(axis.name, value);
    const double x = axis.count(value);
    build.push_back({x, cost.build_seconds});
    render.push_back({x, cost.render_seconds});
    memory.push_back({x, cost.peak_bytes - base_bytes});
    time_series.x.push_back(x);
    time_series.y.push_back(cost.render_seconds);
    memory_series.x.push_back(x);
    memory_series.y.push_back(cost.peak_bytes / kMega);
    all.points.rows.push_back({axis.title, fmt::format("{:.0f}", x),
                               fmt::format("{:.3g}", cost.build_seconds),
                               fmt::format("{:.3g}", cost.render_seconds),
                               fmt::format("{:.1f}", cost.peak_bytes / kMega)});
  }
  all.exponents.rows.push_back({axis.title, fmt::format("{:.0f}", axis.count(values.front())),
                                fmt::format("{:.0f}", axis.count(values.back())), exponent(build),
                                exponent(render), exponent(memory)});
  all.time.series.push_back(std::move(time_series));
  all.memory.series.push_back(std::move(memory_series));
}

/// Speed of two threads over that of one, wall clock, in turn.
void measure_threads(reports::ResultLog& log, bool full) {
  const renderer::Scene scene = renderer::make_scene(load_at_size("cornell", 256, 256));
  renderer::RenderOptions options;
  options.path.max_depth = 7;
  options.sampler = renderer::SamplerType::sobol;
  options.samples_per_pixel = full ? 16 : 4;
  reports::Table table;
  table.group = kGroup;
  table.title = "Threads";
  table.caption = fmt::format("Cornell box, 256 × 256, {} samples per pixel, wall clock, in turn.",
                              options.samples_per_pixel);
  table.columns = {"threads", "speed over one thread"};
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  for (int threads = 2; threads <= std::max(cores, 2); threads *= 2) {
    std::vector<double> ratios;
    for (int i = 0; i < (full ? 15 : 7); ++i) {
      options.threads = 1;
      const double one = render(scene, options).seconds;
      options.threads = threads;
      ratios.push_back(one / render(scene, options).seconds);
    }
    const Estimate ratio = median_with_interval(std::move(ratios));
    table.rows.push_back({std::to_string(threads), text_of(ratio)});
    if (threads != 2) continue;
    reports::Bar bar;
    bar.name = "Two threads over one, Cornell box";
    bar.unit = "times the speed";
    bar.at_least = true;
    bar.limit = 1.9;
    bar.measured = ratio.value;
    bar.low = ratio.low;
    bar.high = ratio.high;
    bar.indicative = cores < 2;
    bar.note = table.caption;
    publish(log, bar);
  }
  publish(log, table);
}

/// Peak memory of a 4k × 4k image, or an extrapolation from 1k × 1k.
void measure_memory(reports::ResultLog& log, double base_bytes, bool full) {
  const std::uint64_t side = full ? 4096 : 1024;
  const PointCost cost = run_scaling_point("image", side);
  const double per_pixel = (cost.peak_bytes - base_bytes) / static_cast<double>(side * side);
  reports::Bar bar;
  bar.name = "Peak memory of a 4k × 4k image";
  bar.unit = "GB";
  bar.limit = 2;
  bar.measured = bar.low = bar.high = (base_bytes + per_pixel * 4096 * 4096) / kGiga;
  bar.indicative = !full;
  bar.note = fmt::format("Cornell box, {0} × {0}, Sobol: {1:.1f} bytes per pixel over {2:.1f} MB",
                         side, per_pixel, base_bytes / kMega);
  publish(log, bar);
}

void measure_first_picture(reports::ResultLog& log, bool full) {
  std::vector<double> times;
  for (int i = 0; i < (full ? 15 : 7); ++i) {
    times.push_back(1e3 * first_picture_seconds());
  }
  keep(log, "first_picture", "ms", times);
  const Estimate time = median_with_interval(std::move(times));
  reports::Bar bar;
  bar.name = "First picture of a small scene";
  bar.unit = "ms";
  bar.limit = 50;
  bar.measured = time.value;
  bar.low = time.low;
  bar.high = time.high;
  bar.note =
      "From the start of `plumbline render` to its end: reads the Cornell box, renders 64 × 64 "
      "pixels with one sample each, writes the image";
  publish(log, bar);
}

}  // namespace

void measure_scaling(reports::ResultLog& log, bool full) {
  measure_first_picture(log, full);
  measure_threads(log, full);
  const double base_bytes = run_scaling_point("image", 1).peak_bytes;
  measure_memory(log, base_bytes, full);
  Collected all = empty_collection();
  for (const Axis& axis : axes()) {
    measure_axis(axis, full ? axis.full : axis.quick, base_bytes, all);
  }
  publish(log, all.exponents);
  publish(log, all.points);
  log.append(all.time);
  log.append(all.memory);
}

}  // namespace plumbline::bench
