#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/core/render/path.h>
#include <plumbline/verify/mean.h>
#include <plumbline_tests/support.h>
#include "scenes.h"

/// Point lights, sun and sky and environment maps as the path tracer sees them, against closed
/// forms.
namespace plumbline::tests {
namespace {

using renderer::PathOptions;
using renderer::Rgbd;
using renderer::Rgbf;
using renderer::Scene;
using renderer::SceneDescription;
using renderer::Strategy;
using renderer::Vec3d;
using renderer::Vec3f;

constexpr double kAlbedo = 0.5;  // of empty_scene's BSDF

/// A floor, z = 0, facing up.
SceneDescription floor_scene() {
  SceneDescription scene = empty_scene(1, 1);
  scene.shapes.push_back(
      {renderer::RectangleShape{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, 0, std::nullopt});
  return scene;
}

/// Luminance that one path from above brings back from the floor below (x, y).
double look_down(const Scene& scene, Strategy strategy, double x, double y,
                 renderer::Sampler& random) {
  PathOptions options;
  options.strategy = strategy;
  options.max_depth = 2;
  renderer::PathCounters counters;
  const renderer::Ray ray{{static_cast<float>(x), static_cast<float>(y), 0.5f}, {0, 0, -1}};
  return static_cast<double>(luminance(estimate_radiance(scene, options, ray, random, counters)));
}

TEST(PointLightPaths, EverySampleIsTheClosedFormAndNothingElseTakesAShareOfIt) {
  SceneDescription description = floor_scene();
  description.points.push_back({{1, 2, 3}, {9, 9, 9}});
  const Scene scene = make_scene(description);
  for (const auto& [x, y] : {std::pair(1.0, 2.0), std::pair(-2.0, 1.0), std::pair(20.0, 0.0)}) {
    // ρ/π I cosθ/d²
    const double d2 = (x - 1) * (x - 1) + (y - 2) * (y - 2) + 9;
    const double expected = kAlbedo / renderer::pi<double>() * 9 * (3 / std::sqrt(d2)) / d2;
    int bright = 0;
    for (std::uint64_t sample = 0; sample < 100; ++sample) {
      renderer::Sampler random(renderer::SamplerType::independent, 1, 0, sample);
      EXPECT_NEAR(look_down(scene, Strategy::light, x, y, random), expected, 1e-5 * expected);
      EXPECT_NEAR(look_down(scene, Strategy::mis, x, y, random), expected, 1e-5 * expected);
      EXPECT_EQ(look_down(scene, Strategy::bsdf, x, y, random), 0);
      // Light or BSDF with probability 1/2: twice the light, or nothing.
      const double one = look_down(scene, Strategy::one_sample, x, y, random);
      EXPECT_TRUE(one == 0 || std::abs(one / expected - 2) < 2e-5) << one / expected;
      bright += one > 0 ? 1 : 0;
    }
    // Of 100 with probability 1/2: outside with 1e-9.
    EXPECT_GE(bright, 20);
    EXPECT_LE(bright, 80);
  }
}

TEST(PointLightPaths, AnythingBetweenCastsAShadow) {
  SceneDescription description = floor_scene();
  description.points.push_back({{0, 0, 3}, {9, 9, 9}});
  description.shapes.push_back({renderer::SphereShape{{0, 0, 2}, 0.5}, 0, std::nullopt});
  const Scene scene = make_scene(description);
  renderer::Sampler random(renderer::SamplerType::independent, 1, 0, 0);
  EXPECT_EQ(look_down(scene, Strategy::light, 0, 0, random), 0);
  EXPECT_GT(look_down(scene, Strategy::light, 5, 0, random), 0);
}

void expect_mean(const Scene& scene, Strategy strategy, const std::string& subject,
                 double reference, verify::Verdict expected = verify::Verdict::pass) {
  verify::MeanOptions options;
  options.subject = subject;
  options.subject.append("/").append(name(strategy));
  options.reference = reference;
  options.tolerance = 0.005;
  options.expected = expected;
  options.seed = check_seed(options.subject);
  expect_verdict(check_mean(options, [&](std::uint64_t first, std::uint64_t count) {
    verify::Moments moments;
    for (std::uint64_t i = first; i < first + count; ++i) {
      renderer::Sampler random(renderer::SamplerType::independent, options.seed, 0, i);
      moments.add(look_down(scene, strategy, 0, 0, random));
    }
    return moments;
  }));
}

TEST(SunAndSkyPaths, TheSidewalkHasItsClosedForm) {
  SceneDescription description = floor_scene();
  const double cos_zenith = 0.8, angle = 0.2665 * renderer::pi<double>() / 180;
  description.sun = renderer::SunDescription{{0.6, 0, cos_zenith}, angle, {2e4, 2e4, 2e4}};
  description.environment = Rgbd{1, 1, 1};
  const Scene scene = make_scene(description);
  // ρ/π E with E = π L_sky + π sin²α cosθ L_sun: a cone above the horizon projects to an ellipse.
  const double reference = kAlbedo * (1 + std::sin(angle) * std::sin(angle) * cos_zenith * 2e4);
  for (const Strategy strategy : {Strategy::light, Strategy::mis, Strategy::one_sample}) {
    expect_mean(scene, strategy, "sun and sky", reference);
  }
  expect_mean(scene, Strategy::mis, "control/sun and sky, sun off by 2 %",
              kAlbedo * (1 + 1.02 * std::sin(angle) * std::sin(angle) * cos_zenith * 2e4),
              verify::Verdict::fail);
}

constexpr int kMapWidth = 16, kMapHeight = 8;

/// Grey values without symmetry, one of them bright.
float map_value(int column, int row) {
  if (column == 5 && row == 1) return 40;
  return static_cast<float>((3 * column + 5 * row) % 7);
}

/// Irradiance of a floor facing up under the map turned by `up`: map +y to world +z, by the
/// midpoint rule in latitude and longitude as Mitsuba defines them.
double irradiance_under_map() {
  constexpr int kSteps = 512;  // a multiple of both sides: no step lies across two pixels
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps / 2; ++j) {  // the northern half is above the floor
      const double theta = (j + 0.5) * renderer::pi<double>() / kSteps;
      sum += static_cast<double>(map_value(i * kMapWidth / kSteps, j * kMapHeight / kSteps)) *
             std::cos(theta) * std::sin(theta);
    }
  }
  return sum * 2 * renderer::pi<double>() / kSteps * renderer::pi<double>() / kSteps;
}

Scene map_scene(bool compensation) {
  std::vector<Rgbf> pixels;
  for (int row = 0; row < kMapHeight; ++row) {
    for (int column = 0; column < kMapWidth; ++column) {
      const float grey = map_value(column, row);
      pixels.push_back({grey, grey, grey});
    }
  }
  SceneDescription description = floor_scene();
  description.environment_map =
      renderer::EnvironmentMap{std::make_shared<renderer::EnvironmentTable>(
                                   kMapWidth, kMapHeight, std::move(pixels), compensation),
                               {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}},
                               1};
  return make_scene(description);
}

TEST(EnvironmentMapPaths, AFloorHasTheIrradianceOfTheHemisphere) {
  const double reference = kAlbedo / renderer::pi<double>() * irradiance_under_map();
  for (const bool compensation : {false, true}) {
    const Scene scene = map_scene(compensation);
    const std::string subject = compensation ? "environment map, compensated" : "environment map";
    for (const Strategy strategy : {Strategy::light, Strategy::bsdf, Strategy::mis,
                                    Strategy::one_sample, Strategy::uniform}) {
      // Compensation leaves dark pixels to the other techniques: light alone misses them.
      const bool misses = compensation && strategy == Strategy::light;
      expect_mean(scene, strategy, subject, reference,
                  misses ? verify::Verdict::fail : verify::Verdict::pass);
    }
  }
}

}  // namespace
}  // namespace plumbline::tests
