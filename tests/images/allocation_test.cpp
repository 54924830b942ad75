#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include <plumbline/verify/mean.h>
#include <plumbline_tests/support.h>
#include "colour_check.h"

/// Sample allocation in the renderer: the image that it converges to, and what it refuses.
namespace plumbline::tests {
namespace {

using renderer::Allocation;
using renderer::Scene;

renderer::SceneDescription small_scene(const std::string& name, int width = 8, int height = 6) {
  auto description = renderer::load_scene(analytic::scene_file(name));
  description.camera.width = width;
  description.camera.height = height;
  return description;
}

/// Of so few pixels that the fewest images that a check takes decide most of them.
Scene tiny_scene() { return make_scene(small_scene("sphere_light", 4, 3)); }

renderer::RenderOptions allocated(Allocation policy, std::uint64_t seed) {
  renderer::RenderOptions options;
  options.path.max_depth = 2;
  options.samples_per_pixel = 40;
  options.seed = seed;
  options.allocation = {.policy = policy, .iterations = 4, .cost_ratio = 1.2};
  return options;
}

/// One sample is one image. Their numbers come from the seed of the check, counted up.
ColourSampler allocated_images(const Scene& scene, Allocation policy, std::uint64_t seed) {
  return [&scene, policy, seed](std::uint64_t first, std::uint64_t count) {
    ColourMoments moments;
    for (std::uint64_t i = first; i < first + count; ++i) {
      const renderer::Rgbd mean = render(scene, allocated(policy, seed + i)).film.mean();
      for (std::size_t k = 0; k < moments.size(); ++k) {
        moments[k].add(mean.*kChannels[k].rendered);
      }
    }
    return moments;
  };
}

class AllocatedImage : public testing::TestWithParam<Allocation> {};

TEST_P(AllocatedImage, MeanIsTheClosedFormForEveryPolicy) {
  const Scene scene = tiny_scene();
  verify::MeanOptions options;
  options.subject = "sphere_light/allocation ";
  options.subject.append(name(GetParam()));
  options.seed = check_seed(options.subject);
  options.max_samples = 1 << 16;
  const analytic::Colour answer =
      make_oracle(analytic::known_scene("sphere_light"))->image_mean().value;
  for (const verify::CheckResult& result : check_channels(
           for_each_channel(options, answer), allocated_images(scene, GetParam(), options.seed))) {
    expect_verdict(result);
  }
}

INSTANTIATE_TEST_SUITE_P(Policies, AllocatedImage, testing::ValuesIn(renderer::kAllocations),
                         [](const auto& param) {
                           std::string text(name(param.param));
                           std::replace(text.begin(), text.end(), '-', '_');
                           return text;
                         });

TEST(AllocatedImageControl, AnswerOffByOnePercentFails) {
  const Scene scene = tiny_scene();
  verify::MeanOptions options;
  options.subject = "control/sphere_light, allocation root-v2, answer off by 1 %";
  options.seed = check_seed(options.subject);
  options.max_samples = 1 << 16;
  options.expected = verify::Verdict::fail;
  const analytic::Colour answer =
      1.01 * make_oracle(analytic::known_scene("sphere_light"))->image_mean().value;
  for (const verify::CheckResult& result :
       check_channels(for_each_channel(options, answer),
                      allocated_images(scene, Allocation::root_v2, options.seed))) {
    expect_verdict(result);
  }
}

TEST(AllocatedRender, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = make_scene(small_scene("sphere_light"));
  auto options = allocated(Allocation::root_nodes, 7);
  options.threads = 1;
  const renderer::RenderResult one = render(scene, options);
  options.threads = 3;
  const renderer::RenderResult three = render(scene, options);
  EXPECT_EQ(one.bsdf_counts, three.bsdf_counts);
  ASSERT_EQ(one.film.pixels().size(), 48u);
  for (std::size_t i = 0; i < one.film.pixels().size(); ++i) {
    EXPECT_EQ(one.film.pixels()[i].mean, three.film.pixels()[i].mean);
    EXPECT_EQ(one.film.pixels()[i].count, options.samples_per_pixel);
  }
}

TEST(AllocatedRender, NotesTheCountsDrawnInEveryIterationAndItsTime) {
  const Scene scene = make_scene(small_scene("sphere_light"));
  const auto options = allocated(Allocation::root_v2, 7);
  const renderer::RenderResult result = render(scene, options);
  const std::size_t pixels = result.film.pixels().size();
  EXPECT_GT(result.seconds, 0);
  ASSERT_EQ(result.bsdf_counts.size(), 4 * pixels);
  const std::vector<float> shares = final_shares(result, 4);
  ASSERT_EQ(shares.size(), pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    EXPECT_EQ(result.bsdf_counts[4 * i], 5u);  // half of ten
    EXPECT_EQ(shares[i], static_cast<float>(result.bsdf_counts[4 * i + 3]) / 10);
    EXPECT_GE(shares[i], 0.1f);
    EXPECT_LE(shares[i], 0.9f);
  }
}

/// A diffuse floor under a small light: points on the light must get most of the samples.
TEST(AllocatedRender, SmallLightGetsTheLightSamples) {
  auto description = renderer::load_scene(source_file("bench/scenes/small_light.xml"));
  description.camera.width = 8;
  description.camera.height = 6;
  auto options = allocated(Allocation::root_nodes, 7);
  options.samples_per_pixel = 400;
  EXPECT_EQ(final_shares(render(make_scene(description), options), 4),
            std::vector<float>(48, 0.1f));
}

TEST(AllocatedRender, RefusesWhatDoesNotFit) {
  const Scene scene = make_scene(small_scene("sphere_light"));
  const auto refused = [&](const auto& change) {
    auto options = allocated(Allocation::equal, 0);
    change(options);
    EXPECT_THROW(render(scene, options), renderer::InputError);
  };
  refused([](auto& o) { o.path.max_depth = 3; });
  refused([](auto& o) { o.seconds = 1; });
  refused([](auto& o) { o.relative_error = 0.1; });
  refused([](auto& o) { o.sampler = renderer::SamplerType::sobol; });
  refused([](auto& o) { o.samples_per_pixel = 7; });
  refused([](auto& o) { o.allocation->iterations = 0; });
  refused([](auto& o) { o.allocation->limit = 0; });
  refused([](auto& o) { o.allocation->limit = 0.6; });
  refused([](auto& o) { o.allocation->cost_ratio = 0; });
}

}  // namespace
}  // namespace plumbline::tests
