#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/loop/tiles.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <set>
#include <thread>
#include <vector>

#include "scenes.h"

namespace plumbline::renderer {
namespace {

RenderOptions options_for(Strategy strategy) {
  RenderOptions options;
  options.path.strategy = strategy;
  options.samples_per_pixel = 8;
  options.seed = 7;
  return options;
}

bool same_bits(const Film& a, const Film& b) {
  return a.pixels().size() == b.pixels().size() &&
         std::memcmp(a.pixels().data(), b.pixels().data(),
                     a.pixels().size() * sizeof(PixelMoments)) == 0;
}

/// 3 × 2 pixels with two nets each, with means of i and 10 i + 1.
RenderState state_of_nets() {
  RenderOptions options;
  options.sampler = SamplerType::sobol;
  options.replicates = 2;
  RenderState state = fresh_state(3, 2, options);
  for (std::size_t i = 0; i < state.drawn.size(); ++i) {
    const auto x = static_cast<float>(i);
    state.moments[2 * i].add({x, x, x});
    state.moments[2 * i + 1].add({10 * x, 0, 0});
    state.moments[2 * i + 1].add({10 * x + 2, 0, 0});
  }
  return state;
}

TEST(RenderState, AFilmHasNetsForSamplesInTheMemoryOfTheirMoments) {
  RenderState state = state_of_nets();
  const Film samples = state.samples();
  const PixelMoments* memory = state.moments.data();
  const Film film = state.take_film();
  EXPECT_EQ(film.pixels().data(), memory);
  ASSERT_EQ(film.pixels().size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto x = static_cast<double>(i);
    const PixelMoments &pixel = film.pixels()[i], &of_samples = samples.pixels()[i];
    EXPECT_EQ(pixel.count, 2u);
    EXPECT_DOUBLE_EQ(pixel.mean.r, (11 * x + 1) / 2);
    EXPECT_DOUBLE_EQ(pixel.variance().r, (9 * x + 1) * (9 * x + 1) / 2);
    EXPECT_EQ(of_samples.count, 3u);
    EXPECT_DOUBLE_EQ(of_samples.mean.r, (21 * x + 2) / 3);
  }
  EXPECT_THROW(Film(2, 2, std::vector<PixelMoments>(3)), std::invalid_argument);
}

TEST(RenderState, OfOneNetTakesSixtyBytesAPixel) {
  for (const SamplerType sampler : {SamplerType::independent, SamplerType::sobol}) {
    RenderOptions options;
    options.sampler = sampler;
    const RenderState state = fresh_state(5, 7, options);
    EXPECT_EQ(state.moments.size() * sizeof(PixelMoments) + state.drawn.size() * 4, 5u * 7 * 60);
  }
}

TEST(Render, TheImageDoesNotDependOnTheNumberOfThreads) {
  const Scene scene = make_scene(tests::closed_sphere(33, 17));
  for (const Strategy strategy : kStrategies) {
    for (const Backend backend : kBackends) {
      RenderOptions options = options_for(strategy);
      options.backend = backend;
      options.threads = 1;
      const RenderResult one = render(scene, options);
      for (const int threads : {2, 3, 0}) {
        options.threads = threads;
        const RenderResult many = render(scene, options);
        EXPECT_TRUE(same_bits(one.film, many.film)) << name(strategy) << ", " << threads;
        EXPECT_EQ(one.counters.bounce_rays, many.counters.bounce_rays);
      }
    }
  }
}

TEST(Render, AnotherSeedGivesAnotherImage) {
  const Scene scene = make_scene(tests::closed_sphere(33, 17));
  RenderOptions options = options_for(Strategy::bsdf);
  const RenderResult one = render(scene, options);
  options.seed = 8;
  EXPECT_FALSE(same_bits(one.film, render(scene, options).film));
}

/// 24×16 pixels that all see one point of a wall, lit by a small sphere: what differs between them
/// are their random numbers alone.
SceneDescription one_point_seen_by_all() {
  SceneDescription scene = tests::empty_scene(24, 16);
  scene.camera.tan_half_fov_x = 1e-9;
  scene.shapes.push_back({SphereShape{{0, 0, 0}, 1, true}, 0, {}});
  scene.shapes.push_back({SphereShape{{0, 0.5, 0.5}, 0.3, false}, 0, Rgbd{1, 1, 1}});
  return scene;
}

TEST(RandomNumbers, AreNoTwoPixelsAlike) {
  const Scene scene = make_scene(one_point_seen_by_all());
  for (const SamplerType sampler : {SamplerType::independent, SamplerType::sobol}) {
    for (const Backend backend : kBackends) {
      RenderOptions options = options_for(Strategy::light);
      options.path.max_depth = 2;
      options.samples_per_pixel = 1;
      options.sampler = sampler;
      options.backend = backend;
      const RenderResult result = render(scene, options);
      std::vector<double> values;
      for (const PixelMoments& pixel : result.film.pixels()) values.push_back(pixel.mean.r);
      std::sort(values.begin(), values.end());
      EXPECT_GT(values.back() - values.front(), 0.1 * values.back()) << "all pixels are alike";
      int alike = 0;
      for (std::size_t i = 1; i < values.size(); ++i)
        alike += values[i] - values[i - 1] < 1e-6 * values[i] ? 1 : 0;
      // By chance 384²/2 · 1e-6/0.1 pairs, or fewer.
      EXPECT_LE(alike, 8) << "random numbers of the " << name(sampler)
                          << " sampler come again in other pixels; " << name(backend);
    }
  }
}

/// A limit that no machine reaches ends nothing, and one that has passed ends all after the first
/// pass; what lies between ends by itself.
TEST(Render, EndsWhenItsTimeIsUp) {
  const Scene scene = make_scene(tests::closed_sphere(4, 4));
  RenderOptions options = options_for(Strategy::mis);
  options.samples_per_pixel = 1u << 30;
  for (const double seconds : {1e-9, 0.05}) {
    options.seconds = seconds;
    const RenderResult result = render(scene, options);
    const auto samples = result.film.pixels().front().count;
    EXPECT_GE(samples, 1u);
    EXPECT_LT(samples, options.samples_per_pixel);
    EXPECT_TRUE(seconds > 1e-6 || samples == 1) << samples;
  }
  options.samples_per_pixel = 8;
  options.seconds = 1e6;
  EXPECT_EQ(render(scene, options).film.pixels().front().count, 8u);
}

TEST(TileThreads, AreAsManyAsAskedFor) {
  TileThreads one(1);
  std::set<std::thread::id> seen;
  one.run(64, 64, 8, [&](const Tile&) {
    seen.insert(std::this_thread::get_id());
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  });
  EXPECT_EQ(seen.size(), 1u);
}

TEST(Render, PassesUntilAnErrorIsReachedGiveTheBitsOfOnePass) {
  const Scene scene = make_scene(tests::closed_sphere(33, 17));
  RenderOptions options = options_for(Strategy::mis);
  options.samples_per_pixel = 1000;
  options.relative_error = 0.1;
  const RenderResult passes = render(scene, options);
  EXPECT_LT(passes.samples_per_pixel, 1000u);
  EXPECT_LE(passes.film.relative_error(), 0.1);
  options.relative_error = 0;
  options.samples_per_pixel = passes.samples_per_pixel;
  EXPECT_TRUE(same_bits(passes.film, render(scene, options).film));
}

TEST(Render, DepthCountsAsInMitsuba) {
  // Le Σ ρ^k over k < depth, with Le = ρ = 1/2 exact in every sample: all vertices see the same
  // light.
  const Scene scene = make_scene(tests::closed_sphere(8, 8));
  double expected = 0;
  for (int depth = 0; depth <= 4; ++depth) {
    RenderOptions options = options_for(Strategy::bsdf);
    options.path.max_depth = depth;
    EXPECT_NEAR(render(scene, options).film.mean().g, expected, 1e-6) << depth;
    expected += 0.5 * std::pow(0.5, depth);
  }
}

TEST(Render, RaysAreCounted) {
  const Scene scene = make_scene(tests::closed_sphere(8, 8));
  RenderOptions options = options_for(Strategy::mis);
  options.path.max_depth = 2;
  const RenderResult result = render(scene, options);
  EXPECT_EQ(result.counters.camera_rays, 8u * 8u * 8u);
  EXPECT_EQ(result.counters.bounce_rays, 8u * 8u * 8u);
  EXPECT_EQ(result.counters.shadow_rays, 8u * 8u * 8u);
}

TEST(Render, SobolSamplesAreDealtOutToReplicatesWhateverThePasses) {
  const Scene scene = make_scene(tests::closed_sphere(33, 17));
  RenderOptions options = options_for(Strategy::mis);
  options.sampler = SamplerType::sobol;
  options.replicates = 4;
  options.relative_error = 0.05;
  options.samples_per_pixel = 1000;
  const RenderResult passes = render(scene, options);
  EXPECT_GT(passes.samples_per_pixel, 4u);
  EXPECT_LT(passes.samples_per_pixel, 1000u);
  EXPECT_EQ(passes.film.at(3, 4).count, 4u);
  options.relative_error = 0;
  options.samples_per_pixel = passes.samples_per_pixel;
  options.threads = 1;
  EXPECT_TRUE(same_bits(passes.film, render(scene, options).film));
}

TEST(Render, OneReplicateOfSobolPointsClaimsNoVariance) {
  const Scene scene = make_scene(tests::closed_sphere(8, 8));
  RenderOptions options = options_for(Strategy::light);
  options.sampler = SamplerType::sobol;
  const RenderResult result = render(scene, options);
  EXPECT_EQ(result.film.at(3, 4).count, 1u);
  EXPECT_EQ(result.samples_per_pixel, 8u);
  options.relative_error = 0.1;
  EXPECT_THROW(render(scene, options), InputError);
}

TEST(Render, UnlimitedDepthWithoutRouletteIsRefused) {
  const Scene scene = make_scene(tests::closed_sphere(8, 8));
  RenderOptions options = options_for(Strategy::bsdf);
  options.path.rr_depth = kNoRoulette;
  EXPECT_THROW(render(scene, options), InputError);
}

TEST(Render, ProgressReachesTheEnd) {
  const Scene scene = make_scene(tests::closed_sphere(64, 64));
  RenderOptions options = options_for(Strategy::bsdf);
  options.threads = 1;
  double last = 0;
  options.progress = [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  render(scene, options);
  EXPECT_DOUBLE_EQ(last, 1.0);
}

TEST(Render, SceneFarFromTheOriginGivesTheSameImage) {
  const Vec3d far{1e5, -1e5, 1e5};
  RenderOptions options = options_for(Strategy::mis);
  const RenderResult near_result = render(make_scene(tests::closed_sphere(16, 16)), options);
  const RenderResult far_result = render(make_scene(tests::closed_sphere(16, 16, far)), options);
  EXPECT_TRUE(same_bits(near_result.film, far_result.film));
}

}  // namespace
}  // namespace plumbline::renderer
