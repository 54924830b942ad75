#include <cmath>
#include <numbers>

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
  const double reflected = reflected_radiance(input);
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
  scene.parameters = {light_radiance(1), floor_albedo(0.75)};
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
  scene.parameters = {light_radiance(1), floor_albedo(0.75)};
  return scene;
}

/// Light i of lights_1000.xml: 40 in a row, 25 rows.
struct GridLight {
  double x, y, radiance;
};

constexpr int kLights = 1000;
constexpr double kSpacing = 0.08, kGridRadius = 0.036, kGridHeight = 1;

GridLight grid_light(int i) {
  const int column = i % 40, row = i / 40;
  return {(column - 19.5) * kSpacing, (row - 12.0) * kSpacing, 1.0 + i % 5};
}

std::unique_ptr<PixelOracle> make_lights_1000(const OracleInput& input) {
  const double scale = albedo_over_pi(input);
  return floor_oracle(input.camera, 5,
                      [scale](const Vec3& p, const Vec3&) {
                        double sum = 0;
                        for (int i = 0; i < kLights; ++i) {
                          const GridLight light = grid_light(i);
                          const double dx = p.x - light.x, dy = p.y - light.y;
                          const double lateral = std::sqrt(dx * dx + dy * dy);
                          sum +=
                              light.radiance * disk_irradiance(kGridRadius, kGridHeight, lateral);
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
  scene.parameters = {floor_albedo(0.75)};
  return scene;
}

}  // namespace

std::vector<KnownScene> sphere_scenes() {
  return {sphere_light(), sphere_near(), sphere_inside(), lights_1000()};
}

}  // namespace plumbline::analytic
