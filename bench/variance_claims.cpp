#include "variance_claims.h"

#include <fmt/core.h>

#include <cstdint>
#include <utility>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include "clock.h"
#include "scenes.h"

namespace plumbline::bench {
namespace {

using renderer::Scene;

struct ClaimWork {
  int width = 24, height = 18;
  std::uint64_t replicates = 16;  // the fewest that the interval takes
  std::uint32_t samples_per_pixel = 16;
};

renderer::SceneDescription load(const ClaimScene& scene, const ClaimWork& work) {
  auto description = renderer::load_scene(scene_path(scene.name), scene.parameters);
  description.camera.width = work.width;
  description.camera.height = work.height;
  return description;
}

/// Films of one strategy, to be judged when the mean over all of them is known.
struct Replicates {
  std::vector<renderer::Film> films;
  StrategyRuns runs;
};

void render_replicate(const Scene& scene, const renderer::RenderOptions& options,
                      Replicates& replicates) {
  const double start = thread_seconds();
  renderer::RenderResult result = render(scene, options);
  replicates.runs.seconds.push_back(thread_seconds() - start);
  const auto paths = static_cast<double>(result.counters.camera_rays);
  const auto shadow = static_cast<double>(result.counters.shadow_rays);
  replicates.runs.rays.push_back(1 + (static_cast<double>(result.counters.bounce_rays) + shadow) /
                                         paths);
  replicates.runs.shadow_rays.push_back(shadow / paths);
  replicates.films.push_back(std::move(result.film));
}

std::vector<double> mean_luminance(const std::vector<renderer::Film>& films) {
  std::vector<double> mean(films.front().pixels().size());
  for (const renderer::Film& film : films) {
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean[i] += luminance(film.pixels()[i].mean) / static_cast<double>(films.size());
    }
  }
  return mean;
}

void judge(Replicates& replicates, const std::vector<double>& reference) {
  const auto pixels = static_cast<double>(reference.size());
  double image_mean = 0;
  for (const double r : reference) image_mean += r / pixels;
  for (const renderer::Film& film : replicates.films) {
    double variance = 0, relative = 0, fireflies = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const double v = luminance(film.pixels()[i].variance());
      variance += v / pixels;
      relative += v / (reference[i] * reference[i] + 0.01) / pixels;
      fireflies += luminance(film.pixels()[i].mean) > reference[i] + image_mean ? 1 : 0;
    }
    replicates.runs.variance.push_back(variance);
    replicates.runs.relative_variance.push_back(relative);
    replicates.runs.fireflies.push_back(fireflies);
  }
}

SceneRuns measure_scene(const ClaimScene& claim, const ClaimWork& work) {
  const auto description = load(claim, work);
  const Scene scene = make_scene(description);
  std::array<Replicates, kClaimStrategies.size()> all;
  // The strategies take turns, so that a change of clock hits all of them.
  for (std::uint64_t replicate = 0; replicate < work.replicates; ++replicate) {
    for (std::size_t s = 0; s < all.size(); ++s) {
      renderer::RenderOptions options;
      options.path.strategy = kClaimStrategies[s];
      options.path.max_depth = description.integrator.max_depth;
      options.path.rr_depth = description.integrator.rr_depth;
      options.samples_per_pixel = work.samples_per_pixel;
      options.seed = replicate * all.size() + s + 1;
      options.threads = 1;  // this one
      render_replicate(scene, options, all[s]);
    }
  }
  const std::vector<double> reference = mean_luminance(all.back().films);
  SceneRuns runs{claim, {}};
  for (std::size_t s = 0; s < all.size(); ++s) {
    judge(all[s], reference);
    runs.strategies[s] = std::move(all[s].runs);
  }
  return runs;
}

}  // namespace

const std::vector<ClaimScene>& claim_scenes() {
  // "None" is read as: within 5 %.
  static const std::vector<ClaimScene> scenes = {
      {"interior", "Interior, panels of 24 cm", {}, "10–50×", {10, 50}, false},
      {"interior", "Interior, panels of 1 m", {{"panel", "0.5"}}, "10–50×", {10, 50}, false},
      {"mixed", "Mixed diffuse and specular", {}, "5–20×", {5, 20}, false},
      {"outdoor", "Outdoor HDR, clear", {{"sky", "outdoor_clear.exr"}}, "2–3×", {2, 3}, false},
      {"outdoor", "Outdoor HDR, hazy", {{"sky", "outdoor_hazy.exr"}}, "2–3×", {2, 3}, false},
      {"outdoor",
       "Outdoor HDR, overcast",
       {{"sky", "outdoor_overcast.exr"}},
       "2–3×",
       {2, 3},
       false},
      {"mirror_glass", "Pure mirror and glass", {}, "none", {1 / 1.05, 1.05}, true},
      {"chapel", "Caustics room", {}, "", {0, 0}, false}};
  return scenes;
}

void measure_variance_claims(reports::ResultLog& log, bool full) {
  fmt::print("variance claims: MIS against BSDF sampling and light sampling\n");
  ClaimWork work;
  if (full) work = {.width = 48, .height = 36, .replicates = 32, .samples_per_pixel = 48};
  std::vector<SceneRuns> runs;
  for (const ClaimScene& scene : claim_scenes()) runs.push_back(measure_scene(scene, work));
  report_variance_claims(log, runs);
}

}  // namespace plumbline::bench
