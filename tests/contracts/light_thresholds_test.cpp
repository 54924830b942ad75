#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/light/spherical_rectangle.h>
#include <plumbline/renderer/core/light/spherical_triangle.h>
#include <plumbline/renderer/core/sampling/discrete.h>
#include "threshold.h"

/// The thresholds of light/. A row names the place in the core.
namespace plumbline::tests {
namespace {

using renderer::Rgbf;
using renderer::Vec2f;
using renderer::Vec3d;
using renderer::Vec3f;

constexpr double kFullTurn = 2 * 3.14159265358979323846;
const Rgbf kUnitRadiance{1, 1, 1};

float as_float(double x) { return static_cast<float>(x); }

/// The first float from which on a condition holds that holds at `high` and not at `low`.
template <class Condition>
float switch_between(float low, float high, const Condition& condition) {
  while (std::nextafter(low, high) != high) {
    const float middle = low + (high - low) / 2;
    (condition(middle) ? high : low) = middle;
  }
  return high;
}

const Vec3f kUp{0, 0, 1};

/// A square metre at z = 0 that emits upwards.
renderer::RectangleLight square(bool by_solid_angle = false, bool two_sided = false) {
  return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, kUnitRadiance, by_solid_angle, two_sided};
}

renderer::TriangleLight half_square(bool by_solid_angle = false) {
  return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, kUnitRadiance, by_solid_angle};
}

renderer::DiskLight unit_disk() { return {{0, 0, 0}, {0, 0, 1}, 1, kUnitRadiance}; }

/// Whether a light gives a sample at a height above the plane z = 0, off the light's corner.
template <class Light>
double sees(const Light& light, double z) {
  return light.sample(Vec3f{0.25f, 0.25f, as_float(z)}, Vec2f{0.5f, 0.5f}) ? 1 : 0;
}

/// pdf towards a place of the plane z = 0, from 1 m above it.
template <class Light>
double pdf_down(const Light& light, double x, double y) {
  return double{light.pdf(Vec3f{as_float(x), as_float(y), 1}, -kUp)};
}

std::vector<Threshold> flat_light_thresholds() {
  std::vector<Threshold> rows{
      {"light/light_sample.h height > 0, a rectangle",
       float_around(0),
       [](double z) { return sees(square(), z); },
       {0, 0, 1}},
      {"light/light_sample.h height > 0, a triangle",
       float_around(0),
       [](double z) { return sees(half_square(), z); },
       {0, 0, 1}},
      {"light/light_sample.h height > 0, a disk",
       float_around(0),
       [](double z) { return sees(unit_disk(), z); },
       {0, 0, 1}},
      {"light/rectangle_light.h dot < 0, two sides",
       float_around(0),
       [](double z) { return sees(square(false, true), z); },
       {1, 0, 1}},
      {"light/rectangle_light.h cos_light > 0, by solid angle",
       float_around(0),
       [](double z) { return sees(square(true), z); },
       {0, 0, 1}},
      {"light/rectangle_light.h s >= 0",
       float_around(0),
       [](double x) { return pdf_down(square(), x, 0.5); },
       {0, 1, 1}},
      {"light/rectangle_light.h s <= 1",
       float_around(1),
       [](double x) { return pdf_down(square(), x, 0.5); },
       {1, 1, 0}},
      {"light/rectangle_light.h t >= 0",
       float_around(0),
       [](double y) { return pdf_down(square(), 0.5, y); },
       {0, 1, 1}},
      {"light/rectangle_light.h t <= 1",
       float_around(1),
       [](double y) { return pdf_down(square(), 0.5, y); },
       {1, 1, 0}},
      {"light/disk_light.h |p| <= r",
       float_around(1),
       [](double x) { return pdf_down(unit_disk(), x, 0); },
       {2 / kFullTurn, 2 / kFullTurn, 0},
       1e-7},
      {"light/point_light.h distance > 0: nearer than float can square is at the light",
       float_around(0),
       [](double x) {
         const renderer::PointLight light{{0, 0, 0}, kUnitRadiance};
         return light.sample(Vec3f{as_float(x), 0, 0}, Vec2f{}) ? 1.0 : 0.0;
       },
       {0, 0, 0}}};
  // A triangle takes what lies within the rounding of its own test for inside.
  for (const double at : {-1e-5, 1e-5}) {
    rows.push_back({"light/triangle_light.h inside, an edge", float_around(at),
                    [](double y) { return pdf_down(half_square(), 0.25, y); },
                    thrice(at < 0 ? 0 : 2), 1e-6});
  }
  return rows;
}

/// A square of 1 m² and half of it, from far above their corner: their area over d², to parts in a
/// million.
std::vector<Threshold> solid_angle_thresholds() {
  const auto large_square = [](float d) {
    const renderer::SphericalRectangle<float> seen({0, 0, -double{d}}, {1, 0, 0}, {0, 1, 0},
                                                   {0, 0, 1});
    return seen.solid_angle() < static_cast<float>(renderer::kSmallestSolidAngle);
  };
  const auto large_triangle = [](float d) {
    const renderer::SphericalTriangle<double> seen({0, 0, -double{d}}, {1, 0, 0}, {0, 1, 0});
    return seen.solid_angle() < renderer::kSmallestSolidAngle;
  };
  const double of_square = double{switch_between(500.0f, 2000.0f, large_square)};
  const double of_triangle = double{switch_between(500.0f, 2000.0f, large_triangle)};
  EXPECT_NEAR(of_square, 1000, 0.1);
  EXPECT_NEAR(of_triangle, std::sqrt(0.5e6), 0.1);
  // pdf_w times the solid angle, so that what is left is the error of either formula.
  const auto scaled = [](const auto& light, double area, bool sampled) {
    return [=](double d) {
      const Vec3f ref{0, 0, as_float(d)};
      const auto s = light.sample(ref, Vec2f{0.5f, 0.5f});
      const double pdf = double{sampled ? s->pdf_w : light.pdf(ref, s->wi)};
      return pdf * area / (d * d);
    };
  };
  // By solid angle the pdf of all directions is one; by area it grows like the cube of the
  // distance, which at √0.4625 m off the middle is by 1.5 · 0.4625/d².
  const auto unevenness = [](const auto& light) {
    return [=](double d) {
      const Vec3d ref{0.25, 0.25, d}, place{0.9, 0.05, 0};
      return (light.pdf(ref, normalize(place - ref)) / light.pdf(ref, Vec3d{0, 0, -1}) - 1) * d * d;
    };
  };
  std::vector<Threshold> rows;
  for (const bool sampled : {false, true}) {
    const std::string what = sampled ? ", pdf_w of a sample" : ", pdf";
    // By area, where d² varies by parts in a million over the light, and by solid angle.
    rows.push_back({"light/light_sample.h kSmallestSolidAngle, a rectangle" + what,
                    float_around(of_square), scaled(square(true), 1, sampled), thrice(1), 4e-6});
    rows.push_back({"light/light_sample.h kSmallestSolidAngle, a triangle" + what,
                    float_around(of_triangle), scaled(half_square(true), 0.5, sampled), thrice(1),
                    4e-6});
  }
  // In double a solid angle has its digits, and the switch lies where it is 1e-6 to six of them.
  const auto around = [](double d) { return std::array{d * 0.99999, d * 1.00001, d * 1.0001}; };
  rows.push_back({"light/light_sample.h kSmallestSolidAngle, unevenness of a rectangle",
                  around(1000),
                  unevenness(square(true)),
                  {0, 0.69375, 0.69375},
                  1e-3});
  rows.push_back({"light/light_sample.h kSmallestSolidAngle, unevenness of a triangle",
                  around(std::sqrt(0.5e6)),
                  unevenness(half_square(true)),
                  {0, 0.69375, 0.69375},
                  1e-3});
  return rows;
}

/// 4 atan(ab/(h √(a² + b² + h²))) of a rectangle 2a by 2b, a distance h below its middle.
double solid_angle_below_middle(double a, double b, double h) {
  return 4 * std::atan(a * b / (h * std::sqrt(a * a + b * b + h * h)));
}

std::vector<Threshold> spherical_rectangle_thresholds() {
  const auto seen = [](double h) {
    return double{
        renderer::SphericalRectangle<float>({-1, -0.5, -h}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1})
            .solid_angle()};
  };
  // h² (1.25 + h²) = a² b² where the angle is π, and h² = 2 where it may be more at all.
  const double half_sphere = std::sqrt((std::sqrt(1.25 * 1.25 + 1) - 1.25) / 2);
  std::vector<Threshold> rows;
  for (const double h : {half_sphere, std::sqrt(2.0)}) {
    rows.push_back(
        {"light/spherical_rectangle.h more than a quarter of the sphere, h " + std::to_string(h),
         double_around(h), seen, thrice(solid_angle_below_middle(1, 0.5, h)), 2e-6});
  }
  // From 1 m below an edge the middle of what is seen is k = (0 + 1/√2)/2, y = k/√(1 − k²) = 1/√7.
  rows.push_back({"light/spherical_rectangle.h y < 0, a corner below the reference point",
                  {-1e-7, 0, 1e-7},
                  [](double y) {
                    const renderer::SphericalRectangle<float> above({-1, y, 1}, {2, 0, 0},
                                                                    {0, 1, 0}, {0, 0, 1});
                    return double{above.sample({0.5f, 0.5f}).y};
                  },
                  thrice(1 / std::sqrt(7.0)),
                  1e-6});
  return rows;
}

std::vector<Threshold> sphere_thresholds() {
  using renderer::SphereLight;
  const SphereLight outward{{0, 0, 0}, 1, false, kUnitRadiance},
      inward{{0, 0, 0}, 1, true, kUnitRadiance};
  const auto towards = [](const SphereLight& light, double d) {
    return double{light.pdf(Vec3f{0, 0, as_float(d)}, -kUp)};
  };
  // From 2 m the limb is at sinθ = 1/2.
  const auto at_sine = [=](double sine) {
    const Vec3f wi = renderer::vec_cast<float>(Vec3d{sine, 0, -std::sqrt(1 - sine * sine)});
    return double{outward.pdf(Vec3f{0, 0, 2}, wi)};
  };
  const double cone = 1 / (kFullTurn * (1 - std::sqrt(0.75)));
  const double edge =
      double{switch_between(0.4f, 0.6f, [&](float sine) { return at_sine(double{sine}) == 0; })};
  EXPECT_NEAR(edge, 0.5, 1e-7);
  const auto chord = [=](double x) {
    return double{inward.pdf(Vec3f{as_float(x), 0, 0}, -kUp)} > 0 ? 1.0 : 0.0;
  };
  return {
      // Just outside, √(d² − r²)/d = 5e-4 is missing to the half sphere.
      {"light/sphere_light.h d > r, pdf along the axis",
       float_around(1),
       [=](double d) { return towards(outward, d); },
       {0, 0, 1 / kFullTurn},
       1e-4},
      {"light/sphere_light.h sin² <= sin²max", float_around(edge), at_sine, {cone, 0, 0}, 1e-5},
      {"light/sphere_light.h dot > 0, away from the sphere", float_around(0),
       [=](double z) {
         return double{outward.pdf(Vec3f{0, 0, 2}, Vec3f{1, 0, as_float(z)})};
       },
       thrice(0)},
      // From the sphere itself: (2r)² r/(r 4π r²) = 1/π.
      {"light/sphere_light.h gap, inward from its surface", float_around(1),
       [=](double d) { return towards(inward, d); }, thrice(2 / kFullTurn), 1e-6},
      {"light/sphere_light.h away > 0, inward from the middle", float_around(0),
       [=](double d) { return towards(inward, d); }, thrice(0.5 / kFullTurn), 1e-7},
      {"light/sphere_light.h half_chord > 0, inward along the limb",
       float_around(1),
       chord,
       {1, 0, 0}},
  };
}

std::vector<Threshold> infinite_light_thresholds() {
  using namespace renderer;
  const auto sun = [](double one_minus_cos, double sky) {
    return SunAndSky{kUp, as_float(one_minus_cos), kUnitRadiance, kUnitRadiance * as_float(sky)};
  };
  const auto beside = [=](double h) {
    const Vec3f wi = normalize(Vec3f{0.6f, 0, 0.8f});
    return double{sun(h, 1).pdf(Vec3f{}, wi)};
  };
  const double edge =
      double{switch_between(0.1f, 0.3f, [&](float h) { return beside(double{h}) > 0.2; })};
  EXPECT_NEAR(edge, 0.2, 1e-7);
  const auto columns = std::make_shared<EnvironmentTable>(
      4, 1, std::vector<Rgbf>{{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}}, false);
  const auto dark_half = [](double bright) {
    const EnvironmentMap map{std::make_shared<EnvironmentTable>(
        1, 2, std::vector<Rgbf>{kUnitRadiance * as_float(bright), kUnitRadiance}, true)};
    return map.pdf(Vec3d{}, Vec3d{0, -1, 0});
  };
  // The mean of 1 and b is exceeded by a part in a million where b − 1 is two.
  const double contrast =
      double{switch_between(1.0f, 1.001f, [&](float b) { return dark_half(double{b}) == 0; })};
  EXPECT_NEAR(contrast, 1 + 2e-6, 2e-7);
  return {
      {"light/sun_and_sky.h u.x < p, what is seen",
       float_around(0.5),
       [=](double u) {
         return double{sun(0.2, 1).sample(Vec3f{}, Vec2f{as_float(u), 0.5f})->radiance.g};
       },
       {2, 1, 1}},
      {"light/sun_and_sky.h the edge of the sun, pdf",
       float_around(edge),
       beside,
       {0.5 / (kFullTurn * 1.8), 0.5 / (kFullTurn * 0.2), 0.5 / (kFullTurn * 0.2)},
       1e-6},
      // Radiance is not negative: below 0 stands 0 once more.
      {"light/sun_and_sky.h a black sky, pdf of the sun",
       {0, 0, 1e-30},
       [=](double sky) { return double{sun(0.25, sky).pdf(Vec3f{}, kUp)}; },
       {4 / kFullTurn, 4 / kFullTurn, 2 / kFullTurn},
       1e-6},
      // Nearer to the seam than 1e-45 a turn is rounded to 0.
      {"light/environment_map.h turn < 0, the seam between the last column and the first",
       {-1e-30, 0, 1e-30},
       [=](double x) {
         return double{EnvironmentMap{columns}.radiance_along(Vec3f{as_float(x), 0, -1}).g};
       },
       {4, 1, 1}},
      {"light/environment_map.h south, the equator in an even number of rows", float_around(0.5),
       [](double u) {
         const EnvironmentMap map{
             std::make_shared<EnvironmentTable>(1, 2, std::vector<Rgbf>(2, kUnitRadiance), false)};
         return double{map.sample(Vec3f{}, Vec2f{0, as_float(u)})->wi.y};
       },
       thrice(0), 2e-7},
      {"light/environment_map.cpp 1 + 1e-6, a map that is the same everywhere",
       float_around(contrast),
       dark_half,
       {1 / (2 * kFullTurn), 0, 0},
       1e-6},
  };
}

/// The choice at the first number that is choice 7's, and at the one before it.
double choices_at_a_bound(double choices) {
  const renderer::DiscreteDistribution alike(
      std::vector<double>(static_cast<std::size_t>(choices), 1));
  float bound = 0;
  for (std::uint32_t i = 0; i < 7; ++i) bound += alike.pmf<float>(i);
  return 10.0 * alike.sample(bound).index + alike.sample(std::nextafter(bound, 0.0f)).index;
}

std::vector<Threshold> choice_thresholds() {
  return {{"sampling/discrete.h kFew, which choice", {15, 16, 17}, choices_at_a_bound, thrice(76)}};
}

TEST(Thresholds, OfChoicesDoNotShow) { expect_all_hold(choice_thresholds()); }
TEST(Thresholds, OfFlatLights) { expect_all_hold(flat_light_thresholds()); }
TEST(Thresholds, OfTheSmallestSolidAngleDoNotShow) { expect_all_hold(solid_angle_thresholds()); }
TEST(Thresholds, OfSolidAnglesOfRectanglesDoNotShow) {
  expect_all_hold(spherical_rectangle_thresholds());
}
TEST(Thresholds, OfSpheres) { expect_all_hold(sphere_thresholds()); }
TEST(Thresholds, OfInfiniteLights) { expect_all_hold(infinite_light_thresholds()); }

}  // namespace
}  // namespace plumbline::tests
