#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include <plumbline/analytic/shadow.h>
#include <plumbline/analytic/sphere_light.h>

#include "floor_oracle.h"
#include "scenes.h"

/// Scenes with spherical lights, and with many; sphere_light itself has a source of its own.
namespace plumbline::analytic {

KnownScene sphere_light();

namespace {

/// The sphere of sphere_near.xml: the point below it is at R (1 + 1e-4) from its centre.
constexpr double kNearHeight = 1.0001;

std::unique_ptr<PixelOracle> make_sphere_near(const OracleInput& input) {
  const Colour reflected = reflected_radiance(input);
  return floor_oracle(input.camera, 1, [reflected](const Vec3& p, const Vec3&) {
    return reflected * sphere_irradiance(1, kNearHeight, std::hypot(p.x, p.y));
  });
}

KnownScene sphere_near() {
  KnownScene scene = floor_scene(
      "sphere_near",
      "L = albedo * Le * sin^2(theta_max) * cos(theta) on the floor 1e-4 R below an emitting "
      "sphere, which fills nearly all of its sky",
      make_sphere_near);
  scene.view = {{0, 0, 5e-5}, {0, 0, 0}, {0, 1, 0}, 90};
  scene.parameters = {light_radiance({0.8, 1, 1.5}), floor_albedo({0.9, 0.75, 0.4})};
  return scene;
}

std::unique_ptr<PixelOracle> make_sphere_inside(const OracleInput& input) {
  return uniform_oracle(input.camera.film, std::numbers::pi * reflected_radiance(input));
}

KnownScene sphere_inside() {
  KnownScene scene =
      floor_scene("sphere_inside", "L = albedo * Le on a floor inside a sphere that emits inwards",
                  make_sphere_inside);
  scene.view = {{0, 0, 1}, {0.2, 0.1, 0}, {0, 1, 0}, 50};
  scene.parameters = {light_radiance({0.8, 1, 1.5}), floor_albedo({0.9, 0.75, 0.4})};
  return scene;
}

/// Light i of lights_1000.xml: 40 in a row, 25 rows.
struct GridLight {
  double x, y;
};

constexpr int kLights = 1000;
constexpr double kSpacing = 0.08, kGridRadius = 0.036, kGridHeight = 1;

GridLight grid_light(int i) {
  const int column = i % 40, row = i / 40;
  return {(column - 19.5) * kSpacing, (row - 12.0) * kSpacing};
}

/// The parameters of the radiances; light i has the one numbered i mod 5.
constexpr std::array<std::string_view, 5> kGridRadiances{"radiance_0", "radiance_1", "radiance_2",
                                                         "radiance_3", "radiance_4"};

std::unique_ptr<PixelOracle> make_lights_1000(const OracleInput& input) {
  const Colour scale = albedo_over_pi(input);
  std::array<Colour, 5> radiances;
  for (std::size_t i = 0; i < radiances.size(); ++i) {
    radiances[i] = emitted(input, kGridRadiances[i]);
  }
  return floor_oracle(input.camera, 5,
                      [=](const Vec3& p, const Vec3&) {
                        std::array<double, 5> sums{};
                        for (int i = 0; i < kLights; ++i) {
                          const GridLight light = grid_light(i);
                          const double dx = p.x - light.x, dy = p.y - light.y;
                          const double lateral = std::sqrt(dx * dx + dy * dy);
                          sums[static_cast<std::size_t>(i % 5)] +=
                              disk_irradiance(kGridRadius, kGridHeight, lateral);
                        }
                        Colour sum;
                        for (std::size_t k = 0; k < sums.size(); ++k) {
                          sum = sum + radiances[k] * sums[k];
                        }
                        return scale * sum;
                      },
                      {1e-12, 1e-7, 4});
}

KnownScene lights_1000() {
  KnownScene scene = floor_scene(
      "lights_1000", "L = albedo / pi * sum of E_i under 1,000 disks of unequal power over a floor",
      make_lights_1000);
  scene.view = {{0, 0, 0.5}, {0, 0, 0}, {0, 1, 0}, 90};
  scene.parameters = {floor_albedo({0.9, 0.75, 0.4})};
  constexpr std::array<Colour, 5> kRadiances{
      {{2, 1, 3}, {1, 2, 2.5}, {3.5, 3, 2}, {5, 4, 1.5}, {4, 5, 1}}};
  for (std::size_t i = 0; i < kRadiances.size(); ++i) {
    scene.parameters.push_back(
        {kGridRadiances[i], kRadiances[i], "Le of every fifth light [rgb, W/(m² sr)]"});
  }
  return scene;
}

}  // namespace

std::vector<KnownScene> sphere_scenes() {
  return {sphere_light(), sphere_near(), sphere_inside(), lights_1000()};
}

}  // namespace plumbline::analytic
