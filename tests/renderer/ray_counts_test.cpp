#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/core/scene/surface_hit.h>
#include "both_backends.h"
#include "scenes.h"

/// Rays and rejected samples of scenes in which all paths take the same number of them.
namespace plumbline::tests {
namespace {

using renderer::PathOptions;
using renderer::SceneDescription;
using renderer::Strategy;

/// Per path.
struct RayCounts {
  std::uint64_t bounce = 0, shadow = 0, rejected = 0;
};

constexpr std::uint64_t kPaths = std::uint64_t{kSmallSamples} * kSmallWidth * kSmallHeight;

void expect_ray_counts(const std::string& what, const SceneDescription& description,
                       const PathOptions& path, const RayCounts& expected) {
  SCOPED_TRACE(what + ", " + std::string(name(path.strategy)));
  renderer::RenderOptions options;
  options.path = path;
  options.samples_per_pixel = kSmallSamples;
  const Pair pair = render_both(renderer::make_scene(description), options);
  for (const renderer::RenderResult* result : {&pair.scalar, &pair.batched}) {
    EXPECT_EQ(result->counters.camera_rays, kPaths);
    EXPECT_EQ(result->counters.bounce_rays, expected.bounce * kPaths);
    EXPECT_EQ(result->counters.shadow_rays, expected.shadow * kPaths);
    EXPECT_EQ(result->counters.rejected, expected.rejected * kPaths);
  }
}

PathOptions to_depth(int depth, Strategy strategy) {
  return {.strategy = strategy, .max_depth = depth, .rr_depth = renderer::kNoRoulette};
}

TEST(RayCounts, DirectlyVisibleLightTakesCameraRaysAlone) {
  for (const Strategy strategy : renderer::kStrategies) {
    expect_ray_counts("closed sphere", closed_sphere(kSmallWidth, kSmallHeight),
                      to_depth(1, strategy), {});
  }
  SceneDescription sky = empty_scene(kSmallWidth, kSmallHeight);
  sky.environment = renderer::Rgbd{1, 1, 1};
  expect_ray_counts("sky alone", sky, to_depth(9, Strategy::light), {});
}

TEST(RayCounts, EachTechniqueTakesOneRayPerSampleAndVertex) {
  const SceneDescription scene = closed_sphere(kSmallWidth, kSmallHeight);
  const auto expect = [&](Strategy strategy, int depth, const RayCounts& expected) {
    expect_ray_counts("closed sphere", scene, to_depth(depth, strategy), expected);
  };
  expect(Strategy::bsdf, 2, {.bounce = 1});
  expect(Strategy::bsdf, 5, {.bounce = 4});
  // The light alone needs no ray to find what is behind the last vertex.
  expect(Strategy::light, 2, {.shadow = 1});
  expect(Strategy::light, 5, {.bounce = 3, .shadow = 4});
  expect(Strategy::uniform, 2, {.bounce = 1});
  expect(Strategy::uniform, 5, {.bounce = 4 + 3});
  expect(Strategy::mis, 5, {.bounce = 4, .shadow = 4});
  expect(Strategy::average, 5, {.bounce = 4, .shadow = 4});
  PathOptions counts = to_depth(5, Strategy::mis);
  counts.bsdf_samples = 4;
  counts.light_samples = 2;
  expect_ray_counts("closed sphere, counts 4,2", scene, counts, {.bounce = 4 + 3, .shadow = 2 + 3});
}

/// A floor under the camera's whole view, which looks along +z; its front faces the camera.
SceneDescription seen_floor(double albedo = 0.5) {
  SceneDescription scene = empty_scene(kSmallWidth, kSmallHeight);
  const auto grey = static_cast<float>(albedo);
  scene.bsdfs = renderer::make_bsdfs({renderer::Lambertian{{grey, grey, grey}}});
  scene.shapes.push_back(
      {renderer::RectangleShape{{-9, -9, 2}, {0, 18, 0}, {18, 0, 0}}, 0, std::nullopt});
  return scene;
}

TEST(RayCounts, ShadowRaysCountWhetherTheyAreBlockedOrNot) {
  SceneDescription scene = seen_floor();
  scene.points.push_back({{0, 0, -1}, {1, 1, 1}});
  expect_ray_counts("in the light", scene, to_depth(2, Strategy::light), {.shadow = 1});
  // A screen behind the camera, before the light.
  scene.shapes.push_back(
      {renderer::RectangleShape{{-9, -9, -0.5}, {18, 0, 0}, {0, 18, 0}}, 0, std::nullopt});
  expect_ray_counts("in shadow", scene, to_depth(2, Strategy::light), {.shadow = 1});
}

TEST(RayCounts, WhatCannotBeSampledOrIsBlackTakesNoShadowRay) {
  SceneDescription behind = seen_floor();
  behind.shapes.push_back(
      {renderer::RectangleShape{{-1, -1, -0.5}, {0, 2, 0}, {2, 0, 0}}, 0, renderer::Rgbd{1, 1, 1}});
  expect_ray_counts("light that faces away", behind, to_depth(2, Strategy::light), {.rejected = 1});
  SceneDescription black = seen_floor(0);
  black.points.push_back({{0, 0, -1}, {1, 1, 1}});
  expect_ray_counts("black floor", black, to_depth(2, Strategy::light), {});
}

TEST(RayCounts, ALightInContactIsAskedForThoughNothingCanLieBetween) {
  // A light before the floor and turned to it, nearer than rays start from either, with the camera
  // in the gap: its visibility is asked for, and needs no tracing.
  constexpr double kGap = 1e-7;
  SceneDescription description = empty_scene(kSmallWidth, kSmallHeight);
  description.shapes.push_back(
      {renderer::RectangleShape{{-9, -9, 0}, {0, 18, 0}, {18, 0, 0}}, 0, std::nullopt});
  description.shapes.push_back({renderer::RectangleShape{{-9, -9, -kGap}, {18, 0, 0}, {0, 18, 0}},
                                0, renderer::Rgbd{1, 1, 1}});
  description.camera.origin = {4, 4, -kGap / 2};
  description.camera.tan_half_fov_x = 1e-3;
  const renderer::Scene scene = renderer::make_scene(description);
  const auto hit = scene.intersect(scene.camera().ray(3, 4, {0.5f, 0.5f}));
  ASSERT_TRUE(hit);
  const auto light = scene.lights().sample(hit->position, renderer::Vec2f{0.25f, 0.5f});
  ASSERT_TRUE(light);
  EXPECT_LE(shadow_ray(*hit, *light).t_max, 0.0f);
  expect_ray_counts("contact", description, to_depth(2, Strategy::light), {.shadow = 1});
}

}  // namespace
}  // namespace plumbline::tests
