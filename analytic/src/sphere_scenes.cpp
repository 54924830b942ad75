#include <cmath>
#include <numbers>

#include <plumbline/analytic/sphere_light.h>

#include "floor_oracle.h"
#include "scenes.h"

/// Scenes with spherical lights; sphere_light itself has a source of its own.
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
  KnownScene scene;
  scene.name = "sphere_near";
  scene.answer =
      "L = albedo * Le * sin^2(theta_max) * cos(theta) on the floor 1e-4 R below an emitting "
      "sphere, which fills nearly all of its sky";
  scene.view = {{0, 0, 5e-5}, {0, 0, 0}, {0, 1, 0}, 90};
  scene.film = {64, 48};
  scene.max_depth = 2;
  scene.parameters = {{"radiance", 1, "Le of the light [W/(m² sr)], not negative"},
                      {"albedo", 0.75, "reflectance of the floor [1], 0 to 1"}};
  scene.expectations = expect_pass_from_all();
  scene.make = make_sphere_near;
  return scene;
}

std::unique_ptr<PixelOracle> make_sphere_inside(const OracleInput& input) {
  return uniform_oracle(input.camera.film, std::numbers::pi * reflected_radiance(input));
}

KnownScene sphere_inside() {
  KnownScene scene;
  scene.name = "sphere_inside";
  scene.answer = "L = albedo * Le on a floor inside a sphere that emits inwards";
  scene.view = {{0, 0, 1}, {0.2, 0.1, 0}, {0, 1, 0}, 50};
  scene.film = {64, 48};
  scene.max_depth = 2;
  scene.parameters = {{"radiance", 1, "Le of the light [W/(m² sr)], not negative"},
                      {"albedo", 0.75, "reflectance of the floor [1], 0 to 1"}};
  scene.expectations = expect_pass_from_all();
  scene.make = make_sphere_inside;
  return scene;
}

/// Light i of lights_1000.xml: 40 in a row, 25 rows.
struct GridLight {
  double x, y, radiance;
};

constexpr int kLights = 1000;
constexpr double kSpacing = 0.08, kLightHeight = 1;
// Smaller than what would let one light hide another from a point of the floor in view: at the
// lowest elevation, sin = 1/√(1 + 2.06² + 1.34²), neighbours are kSpacing · 0.38 > 2 R apart.
constexpr double kLightRadius = 0.012;

GridLight grid_light(int i) {
  return {(i % 40 - 19.5) * kSpacing, (i / 40 - 12.0) * kSpacing, 10.0 * (1 + i % 5)};
}

class ManyLightsOracle final : public PixelOracle {
 public:
  ManyLightsOracle(const Camera& camera, double reflected)
      : PixelOracle(camera.film), camera_(camera), reflected_(reflected) {}

  Average box_mean(const FilmBox& box) const override {
    const double distance = camera_.origin.z;
    const Vec3 a = camera_.origin + camera_.direction(box.x0, box.y0) * distance;
    const Vec3 b = camera_.origin + camera_.direction(box.x1, box.y1) * distance;
    double sum = 0;
    for (int i = 0; i < kLights; ++i) {
      const GridLight light = grid_light(i);
      sum += light.radiance * sphere_irradiance_mean_above(
                                  kLightRadius, kLightHeight, std::fmin(a.x, b.x) - light.x,
                                  std::fmax(a.x, b.x) - light.x, std::fmin(a.y, b.y) - light.y,
                                  std::fmax(a.y, b.y) - light.y);
    }
    return {reflected_ * sum, 1e-12 * reflected_ * sum};
  }

 private:
  Camera camera_;
  double reflected_;
};

std::unique_ptr<PixelOracle> make_lights_1000(const OracleInput& input) {
  const double albedo = parameter(input, "albedo");
  require(albedo >= 0 && albedo <= 1, "albedo must be in [0, 1]");
  const bool lit = input.max_depth == -1 || input.max_depth >= 2;
  return std::make_unique<ManyLightsOracle>(input.camera, lit ? albedo / std::numbers::pi : 0);
}

KnownScene lights_1000() {
  KnownScene scene;
  scene.name = "lights_1000";
  scene.answer = "L = albedo / pi * sum of E_i under 1,000 spheres of unequal power over a floor";
  scene.view = {{0, 0, 0.5}, {0, 0, 0}, {0, 1, 0}, 90};
  scene.film = {64, 48};
  scene.max_depth = 2;
  scene.parameters = {{"albedo", 0.75, "reflectance of the floor [1], 0 to 1"}};
  scene.expectations = expect_pass_from_all();
  scene.make = make_lights_1000;
  return scene;
}

}  // namespace

std::vector<KnownScene> sphere_scenes() {
  return {sphere_light(), sphere_near(), sphere_inside(), lights_1000()};
}

}  // namespace plumbline::analytic
