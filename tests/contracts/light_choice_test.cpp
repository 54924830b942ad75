#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/sampling/discrete.h>
#include "light_examples.h"

/// Lights, and parts of lights, are chosen with the weights that they are said to have: by value,
/// from areas and powers written down here. A weight that is off costs variance and nothing else.
namespace plumbline::tests {
namespace {

using renderer::LightSelection;
using renderer::LightSet;
using renderer::Rgbf;
using renderer::Vec3f;

constexpr double kPi = 3.14159265358979323846;

/// Probabilities are multiples of 2^-24. Each of n choices gets one for certain, which the others
/// give up, and the rest is rounded to one.
constexpr double rounding(std::size_t n) { return static_cast<double>(n + 1) * 0x1p-24; }

/// Rec. 709 luminance of kRadiance.
constexpr double kLuminance = 0.2126 * 1 + 0.7152 * 2 + 0.0722 * 3;

struct WeighedLight {
  std::string name;
  renderer::Light light;
  std::uint32_t group;
  double area;   // [m²]
  double power;  // by luminance [W]
};

constexpr double kSceneRadius = 1.5;  // [m]

/// Power of an infinite light that passes through the scene's cross-section, by ∫ L dω of its
/// luminance.
double infinite_power(double luminous) { return kPi * kSceneRadius * kSceneRadius * luminous; }

/// cosθ between the edges of a row of a map, which is 2π of solid angle.
double height_of_row(int row, int rows) {
  return std::cos(kPi * row / rows) - std::cos(kPi * (row + 1) / rows);
}

/// ∫ L dω of the small map in units of kRadiance.
double integral_of_small_map() {
  const std::vector<double> greys = small_map_greys();
  double sum = 0;
  for (int i = 0; i < kSmallMapWidth * kSmallMapHeight; ++i) {
    sum += greys[static_cast<std::size_t>(i)] * 2 * kPi / kSmallMapWidth *
           height_of_row(i / kSmallMapWidth, kSmallMapHeight);
  }
  return sum;
}

/// One light of every kind, and a mesh of two triangles.
std::vector<WeighedLight> weighed_lights() {
  using namespace renderer;
  const RectangleLight one_sided{{0, 0, 2}, {2, 0, 0}, {0, 1.5f, 0}, {0, 0, 1}, kRadiance};
  RectangleLight two_sided = one_sided;
  two_sided.two_sided = true;
  const double half_angle = 0.25;
  return {
      {"sphere", SphereLight{{0, 0, 3}, 0.5f, false, kRadiance}, 0, kPi, kPi * kPi * kLuminance},
      {"rectangle", one_sided, 1, 3, 3 * kPi * kLuminance},
      {"two-sided rectangle", two_sided, 2, 3, 2 * 3 * kPi * kLuminance},
      {"disk", DiskLight{{0, 0, 1}, {0, 0, 1}, 0.75f, kRadiance}, 3, kPi * 0.5625,
       kPi * kPi * 0.5625 * kLuminance},
      {"triangle", TriangleLight{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, kRadiance}, 4, 0.5,
       0.5 * kPi * kLuminance},
      {"second triangle of a mesh",
       TriangleLight{{0, 0, 0}, {0, 3, 0}, {0, 0, 1}, {1, 0, 0}, kRadiance}, 4, 1.5,
       1.5 * kPi * kLuminance},
      {"point", PointLight{{1, 2, 3}, kRadiance * 0.5f}, 5, 0, 4 * kPi * kLuminance / 2},
      {"sky", ConstantEnvironment{kRadiance}, 6, 0, infinite_power(4 * kPi * kLuminance)},
      {"map", EnvironmentMap{small_map(true), {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 0.25f}, 7, 0,
       infinite_power(integral_of_small_map() * kLuminance / 4)},
      {"sun and sky", SunAndSky::make({0, 0, 1}, half_angle, kRadiance * 100, kRadiance), 8, 0,
       infinite_power((2 * kPi * (1 - std::cos(half_angle)) * 100 + 4 * kPi) * kLuminance)}};
}

/// Of each group what `of` sums up to.
template <class Of>
std::vector<double> sums_of_groups(const std::vector<WeighedLight>& lights, const Of& of) {
  std::vector<double> sums(lights.back().group + 1);
  for (const WeighedLight& l : lights) sums[l.group] += of(l);
  return sums;
}

std::vector<double> stated_probabilities(const std::vector<WeighedLight>& lights,
                                         LightSelection selection) {
  const auto areas = sums_of_groups(lights, [](const auto& l) { return l.area; });
  std::vector<double> weights(areas.size(), 1.0);
  if (selection == LightSelection::power) {
    weights = sums_of_groups(lights, [](const auto& l) { return l.power; });
  } else if (selection == LightSelection::area) {
    double sum = 0, count = 0;
    for (const double area : areas) {
      sum += area;
      count += area > 0 ? 1 : 0;
    }
    for (std::size_t g = 0; g < areas.size(); ++g)
      weights[g] = areas[g] > 0 ? areas[g] : sum / count;
  }
  double total = 0;
  for (const double weight : weights) total += weight;
  std::vector<double> result;
  for (const WeighedLight& l : lights) {
    const double share = areas[l.group] > 0 ? l.area / areas[l.group] : 1;
    result.push_back(weights[l.group] / total * share);
  }
  return result;
}

class LightChoice : public testing::TestWithParam<LightSelection> {};

TEST_P(LightChoice, HasItsStatedProbability) {
  const std::vector<WeighedLight> lights = weighed_lights();
  std::vector<renderer::Light> plain;
  std::vector<std::uint32_t> groups;
  for (const WeighedLight& l : lights) {
    plain.push_back(l.light);
    groups.push_back(l.group);
  }
  const LightSet set(plain, groups, GetParam(), kSceneRadius);
  const std::vector<double> stated = stated_probabilities(lights, GetParam());
  double before = 0;
  for (std::uint32_t i = 0; i < set.size(); ++i) {
    EXPECT_NEAR(set.pmf<double>(i), stated[i], rounding(set.size())) << lights[i].name;
    const auto middle = static_cast<float>(before + stated[i] / 2);
    EXPECT_EQ(set.choose(renderer::Vec2f{middle, 0.5f}).light, i) << lights[i].name;
    before += stated[i];
  }
}

INSTANTIATE_TEST_SUITE_P(All, LightChoice, testing::ValuesIn(renderer::kLightSelections),
                         [](const auto& selection) {
                           return std::string(renderer::name(selection.param));
                         });

/// The scene's radius is half the diagonal of its bounding box, and a mesh is one group.
TEST(LightChoice, InASceneCountsItsRadiusAndItsMeshes) {
  using namespace renderer;
  const Rgbd white{1, 1, 1};
  SceneDescription scene;
  scene.bsdfs = make_bsdfs({Lambertian{{0.5f, 0.5f, 0.5f}}});
  scene.light_selection = LightSelection::power;
  scene.environment = white;
  scene.shapes.push_back(
      {RectangleShape{{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, false}, 0, white, false, true});
  scene.shapes.push_back(
      {MeshShape{{{0, 0, 4}, {2, 0, 4}, {2, 4, 4}, {0, 4, 4}}, {{0, 1, 2}, {0, 2, 3}}, false}, 0,
       white, false, false});
  scene.points.push_back({{1, 1, 1}, white});
  const Scene made = make_scene(scene);
  const double square_of_radius = (4 + 16 + 16) / 4.0;
  // Two-sided rectangle of 8 m², two triangles of 4 m², point, environment.
  const std::array<double, 5> power{2 * 8 * kPi, 4 * kPi, 4 * kPi, 4 * kPi,
                                    kPi * square_of_radius * 4 * kPi};
  double total = 0;
  for (const double p : power) total += p;
  ASSERT_EQ(made.lights().size(), power.size());
  for (std::uint32_t i = 0; i < power.size(); ++i) {
    EXPECT_NEAR(made.lights().pmf<double>(i), power[i] / total, rounding(power.size())) << i;
  }
}

/// Of a rectangle that stands on its corner every corner counts.
TEST(LightChoice, InASceneCountsAllCornersOfARectangle) {
  using namespace renderer;
  SceneDescription scene;
  scene.bsdfs = make_bsdfs({Lambertian{{0.5f, 0.5f, 0.5f}}});
  scene.light_selection = LightSelection::power;
  scene.environment = Rgbd{1, 1, 1};
  scene.shapes.push_back(
      {RectangleShape{{0, -1, 0}, {1, 1, 0}, {-1, 1, 0}, false}, 0, Rgbd{1, 1, 1}, false, false});
  const Scene made = make_scene(scene);
  const double square_of_radius = (4 + 4) / 4.0;
  const double rectangle = 2 * kPi, sky = kPi * square_of_radius * 4 * kPi;
  ASSERT_EQ(made.lights().size(), 2u);
  EXPECT_NEAR(made.lights().pmf<double>(0), rectangle / (rectangle + sky), rounding(2));
}

TEST(DiscreteDistribution, OfWeightsThatAreAllZeroChoosesAllAlike) {
  const std::vector<double> weights(5, 0.0);
  const renderer::DiscreteDistribution alike(weights);
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_NEAR(alike.pmf<double>(i), 0.2, rounding(5)) << i;
}

/// It has nothing above its mean, and is sampled as it stands.
TEST(EnvironmentMapChoice, OfAMapThatIsTheSameEverywhereIsUniform) {
  for (const float grey : {0.25f, 4.0f}) {
    const renderer::EnvironmentMap map{std::make_shared<renderer::EnvironmentTable>(
        4, 3, std::vector<Rgbf>(12, Rgbf{grey, grey, grey}), true)};
    for (const Vec3f& wi : {Vec3f{0, 1, 0}, Vec3f{0.6f, 0, 0.8f}, Vec3f{-0.36f, -0.8f, 0.48f}}) {
      EXPECT_NEAR(map.pdf(Vec3f{}, wi), static_cast<float>(1 / (4 * kPi)), 2e-7f) << grey;
    }
  }
}

/// By luminance times solid angle, or by what a pixel has above the mean over the sphere.
TEST(EnvironmentMapChoice, OfEveryPixelHasItsStatedProbability) {
  const std::vector<double> greys = small_map_greys();
  for (const bool compensation : {false, true}) {
    const renderer::EnvironmentMap map{small_map(compensation)};
    const double floor = compensation ? integral_of_small_map() / (4 * kPi) : 0;
    std::vector<double> weights;
    double total = 0;
    for (int i = 0; i < kSmallMapWidth * kSmallMapHeight; ++i) {
      const double above = std::max(greys[static_cast<std::size_t>(i)] - floor, 0.0);
      weights.push_back(above * height_of_row(i / kSmallMapWidth, kSmallMapHeight));
      total += weights.back();
    }
    for (int i = 0; i < kSmallMapWidth * kSmallMapHeight; ++i) {
      const int row = i / kSmallMapWidth, column = i % kSmallMapWidth;
      const double theta = kPi * (row + 0.5) / kSmallMapHeight;
      const double phi = 2 * kPi * (column + 0.5) / kSmallMapWidth;
      const renderer::Vec3d wi{std::sin(theta) * std::sin(phi), std::cos(theta),
                               -std::sin(theta) * std::cos(phi)};
      const double solid_angle = 2 * kPi / kSmallMapWidth * height_of_row(row, kSmallMapHeight);
      EXPECT_NEAR(map.pdf(renderer::Vec3d{}, wi) * solid_angle,
                  weights[static_cast<std::size_t>(i)] / total,
                  rounding(kSmallMapWidth) + rounding(kSmallMapHeight))
          << (compensation ? "compensated, pixel " : "pixel ") << i;
    }
  }
}

TEST(SunAndSkyChoice, IsOneHalfAndAllForTheSunWhereTheSkyIsBlack) {
  const renderer::Vec3d up{0, 0, 1};
  for (const auto& [sky, share] : {std::pair{1.0f, 0.5}, std::pair{0.0f, 1.0}}) {
    const auto light = renderer::SunAndSky::make({0, 0, 1}, 0.25, kRadiance, Rgbf{sky, sky, sky});
    const double cone = 2 * kPi * (1 - std::cos(0.25));
    EXPECT_NEAR(light.pdf(renderer::Vec3d{}, up) * cone, share, 1e-7) << sky;
    EXPECT_NEAR(light.pdf(renderer::Vec3d{}, -up) * (4 * kPi - cone), 1 - share, 1e-7) << sky;
  }
}

}  // namespace
}  // namespace plumbline::tests
