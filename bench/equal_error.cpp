#include "equal_error.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include "publish.h"
#include "scenes.h"
#include "statistics.h"

namespace plumbline::bench {
namespace {

using renderer::Scene;

/// A scene of the comparison, at its full resolution. pbrt-v4's figures and the setting: its
/// `path` integrator, 64 samples per pixel, two threads of a machine like ours, with the better of
/// its samplers first.
struct Comparison {
  const char *scene, *title;
  int width, height;
  double bar;
  const char* pbrt;
};

constexpr Comparison kComparisons[] = {
    {"veach", "Veach's plates", 512, 384, 0.0025, "pbrt-v4: zsobol 0.025, independent 0.078"},
    {"cornell", "Cornell box", 256, 256, 0.0065, "pbrt-v4: independent 0.068, zsobol 0.075"}};

constexpr std::uint32_t kComparedSamples = 64;
constexpr int kThreads = 2;
constexpr int kReplicates = 16;
constexpr std::uint32_t kReferenceSamples = 4 * kComparedSamples;  // in each of two halves

renderer::RenderResult render_once(const Scene& scene, const renderer::PathOptions& path,
                                   std::uint32_t samples, std::uint64_t seed) {
  renderer::RenderOptions options;
  options.path = path;
  options.samples_per_pixel = samples;
  options.seed = seed;
  options.sampler = renderer::SamplerType::sobol;
  options.threads = kThreads;
  return render(scene, options);
}

struct ConvergedImage {
  std::vector<double> image;
  double rel_mse = 0;  ///< of itself, from the difference of its halves
};

/// Two renders with seeds that no replicate has; (a − b)²/4 is an unbiased estimate of the squared
/// error of their mean.
ConvergedImage render_reference(const Scene& scene, const renderer::PathOptions& path) {
  ConvergedImage reference;
  reference.image = luminances(render_once(scene, path, kReferenceSamples, 1001).film);
  std::vector<double> off = luminances(render_once(scene, path, kReferenceSamples, 1002).film);
  for (std::size_t i = 0; i < off.size(); ++i) {
    const double half_difference = (off[i] - reference.image[i]) / 2;
    reference.image[i] += half_difference;
    off[i] = reference.image[i] + half_difference;
  }
  reference.rel_mse = rel_mse(off, reference.image);
  return reference;
}

void measure(const Comparison& comparison, reports::ResultLog& log, bool full) {
  const int shrink = full ? 1 : 4;
  const auto description =
      load_at_size(comparison.scene, comparison.width / shrink, comparison.height / shrink);
  const Scene scene = make_scene(description);
  const renderer::PathOptions path{.max_depth = description.integrator.max_depth,
                                   .rr_depth = description.integrator.rr_depth};
  const ConvergedImage reference = render_reference(scene, path);
  std::vector<double> errors, times;
  for (int i = 0; i < kReplicates; ++i) {
    const renderer::RenderResult result =
        render_once(scene, path, kComparedSamples, static_cast<std::uint64_t>(i) + 1);
    errors.push_back(rel_mse(luminances(result.film), reference.image) - reference.rel_mse);
    times.push_back(result.seconds * shrink * shrink);
  }
  const Estimate error = mean_with_interval(errors);
  std::vector<double> costs;
  for (const double seconds : times) costs.push_back(error.value * seconds);
  keep(log, fmt::format("equal_error/{}{}", comparison.scene, full ? "" : ", small"), "relMSE × s",
       std::move(costs));
  const Estimate time = median_with_interval(std::move(times));

  reports::Bar bar;
  bar.name = fmt::format("Equal error, {}", comparison.title);
  bar.unit = "relMSE × s";
  bar.limit = comparison.bar;
  bar.measured = error.value * time.value;
  bar.low = error.low * time.low;
  bar.high = error.high * time.high;
  bar.indicative = !full;
  bar.comparison = comparison.pbrt;
  bar.note = fmt::format(
      "{}×{}, {} samples per pixel, {} threads{}: relMSE {:.3g} [{:.3g}, {:.3g}] (mean of {} "
      "renders), {:.3g} s [{:.3g}, {:.3g}] (median); the reference's own relMSE, {:.2g}, is "
      "subtracted",
      description.camera.width, description.camera.height, kComparedSamples, kThreads,
      full ? "" : fmt::format(", time × {}", shrink * shrink), error.value, error.low, error.high,
      kReplicates, time.value, time.low, time.high, reference.rel_mse);
  publish(log, bar);
}

}  // namespace

void measure_equal_error(reports::ResultLog& log, bool full) {
  fmt::print("equal error: relMSE × seconds, mis with Owen-scrambled Sobol'\n");
  for (const Comparison& comparison : kComparisons) measure(comparison, log, full);
}

}  // namespace plumbline::bench
