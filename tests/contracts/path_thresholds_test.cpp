#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/render/film.h>
#include <plumbline/renderer/core/render/vertex.h>
#include <plumbline/renderer/core/scene/geometry.h>
#include <plumbline/renderer/loop/render_loop.h>
#include "threshold.h"

/// The thresholds of scene/ and render/. A row names the place in the core.
namespace plumbline::tests {
namespace {

const renderer::Rgbf kOnes{1, 1, 1};
const renderer::Vec3f kFacing{0, 0, 1};

float rounded(double x) { return static_cast<float>(x); }

std::vector<Threshold> ray_thresholds() {
  using namespace renderer;
  const SurfaceHit hit{{1, 0, 0}, kFacing, ray_offset(1), 0, kNoLight};
  const Primitive lamp{0, 1, 2, 1, kFacing};
  return {
      // Two offsets of 2^-20 m: the light's, and that of where the ray starts.
      {"scene/surface_hit.h t_max > 0",
       float_around(0x1p-19),
       [=](double d) {
         const LightSample<float> light{{0, 1, 0}, rounded(d), 1, kOnes, 1};
         return shadow_ray(hit, light).t_max > 0 ? 1.0 : 0.0;
       },
       {0, 0, 1}},
      {"scene/surface_hit.h dot >= 0, where rays start",
       float_around(0),
       [=](double z) {
         return double{hit.origin_towards({1, 0, rounded(z)}).z} * 0x1p20;
       },
       {-1, 1, 1}},
      {"scene/geometry.h dot < 0, the side that emits",
       float_around(0),
       [=](double z) {
         return static_cast<double>(lamp.light_towards(kFacing, {1, 0, rounded(z)}));
       },
       {1, 2, 2}},
      {"render/vertex.h 0.95, what a survivor is scaled by", float_around(0.95),
       [](double x) {
         return double{after_roulette(Rgbf{rounded(x), 0, 0}, 1, 0.5f).r};
       },
       thrice(1), 2e-7},
      {"render/vertex.h 0.95, who survives",
       float_around(0.95),
       [](double u) {
         return is_black(after_roulette(Rgbf{1, 1, 1}, 1, rounded(u))) ? 0.0 : 1.0;
       },
       {1, 0, 0}},
  };
}

std::vector<Threshold> depth_thresholds() {
  using namespace renderer;
  const auto goes_on = [](int max_depth, double depth) {
    PathOptions options;
    options.max_depth = max_depth;
    return within(options, static_cast<int>(depth)) ? 1.0 : 0.0;
  };
  const auto finds_more = [](double depth) {
    PathOptions options;
    options.max_depth = 5;
    return finds_no_more(options, Techniques::of_counts(0, 1), {.density = true},
                         static_cast<int>(depth))
               ? 0.0
               : 1.0;
  };
  const auto one_of = [](double count) {
    const std::vector<Light> lights(static_cast<std::size_t>(count), Light{PointLight{{}, kOnes}});
    return double{LightSet(lights).choose(Vec2f{0.75f, 0.5f}).u.x};
  };
  return {
      {"render/vertex.h depth <= max_depth",
       {3, 4, 5},
       [=](double d) { return goes_on(4, d); },
       {1, 1, 0}},
      {"render/vertex.h max_depth < 0",
       {-1, 0, 1},
       [=](double max) { return goes_on(static_cast<int>(max), 1); },
       {1, 0, 1}},
      {"render/vertex.h depth + 2, light samples only", {2, 3, 4}, finds_more, {1, 1, 0}},
      // One light leaves u as it is, of two the second stretches its half. None is never asked.
      {"light/light.h size < 2", {1, 1, 2}, one_of, {0.75, 0.75, 0.5}, 1e-6},
      {"render/film.cpp count < 2",
       {0, 1, 2},
       [](double count) {
         PixelMoments moments;
         for (int k = 0; k < static_cast<int>(count); ++k) moments.add(kOnes * (2.0f * rounded(k)));
         return moments.variance().g;
       },
       {0, 0, 2}},
      {"loop/render_loop.cpp replicates < 2, an error limit is refused",
       {0, 1, 2},
       [](double replicates) {
         SamplingOptions options;
         options.samples_per_pixel = 1;
         options.sampler = SamplerType::sobol;
         options.relative_error = 1;
         options.replicates = static_cast<std::uint32_t>(replicates);
         try {
           run_render_loop(Camera{}, options, [] { return std::unique_ptr<PixelSampler>(); });
         } catch (const InputError&) {
           return 0.0;
         }
         return 1.0;
       },
       {0, 0, 1}},
  };
}

TEST(Thresholds, OfRays) { expect_all_hold(ray_thresholds()); }
TEST(Thresholds, OfDepthsAndCounts) { expect_all_hold(depth_thresholds()); }

}  // namespace
}  // namespace plumbline::tests
