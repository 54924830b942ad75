#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <plumbline/analytic/sphere_light.h>

#include "floor_oracle.h"
#include "piecewise.h"
#include "scenes.h"

namespace plumbline::analytic {
namespace {

constexpr double kSceneHalfSide = 10;          // of sphere_light.xml
constexpr double kClosedFormRounding = 1e-13;  // relative, of the closed forms

struct FloorBox {
  double x0, x1, y0, y1;
};

/// Mean of the irradiance of a sphere that dips into the floor: no antiderivative is known, and
/// outside the sphere the integrand is smooth.
Quadrature clipped_mean(double radius, double height, const FloorBox& box) {
  double inner_error = 0;
  const auto row = [&](double y) {
    const Quadrature across = integrate_smooth(
        [&](double x) { return sphere_irradiance(radius, height, std::hypot(x, y)); }, box.x0,
        box.x1);
    inner_error = std::max(inner_error, across.error);
    return across.value;
  };
  const Quadrature whole = integrate_smooth(row, box.y0, box.y1);
  const double height_of_box = box.y1 - box.y0;
  const double area = (box.x1 - box.x0) * height_of_box;
  return {whole.value / area, (whole.error + inner_error * height_of_box) / area};
}

/// Whether no ray through the film can meet the sphere: it lies behind the camera, or on the outer
/// side of one of the four planes through the pinhole and an edge of the film.
bool out_of_view(const Camera& camera, const Vec3& center, double radius) {
  const Vec3 offset = center - camera.origin;
  if (dot(offset, camera.forward) <= -radius) return true;
  const double w = camera.film.width;
  const double h = camera.film.height;
  const std::array<Vec3, 4> corners = {camera.direction(0, 0), camera.direction(w, 0),
                                       camera.direction(w, h), camera.direction(0, h)};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 plane = normalize(cross(corners[i], corners[(i + 1) % corners.size()]));
    const double side = dot(plane, camera.forward) > 0 ? -1 : 1;
    if (side * dot(plane, offset) >= radius) return true;
  }
  return false;
}

class SphereLightOracle final : public PixelOracle {
 public:
  SphereLightOracle(const Camera& camera, double radius, double height, const Colour& reflected)
      : PixelOracle(camera.film),
        camera_(camera),
        radius_(radius),
        height_(height),
        reflected_(reflected) {}

  Average box_mean(const FilmBox& box) const override {
    const FloorBox floor = on_floor(box);
    Quadrature mean;
    if (height_ >= radius_) {
      mean.value =
          sphere_irradiance_mean_above(radius_, height_, floor.x0, floor.x1, floor.y0, floor.y1);
    } else {
      mean = clipped_mean(radius_, height_, floor);
    }
    mean.error += kClosedFormRounding * mean.value;
    return {reflected_ * mean.value, reflected_ * mean.error};
  }

  /// The film looks straight down, so a box on it is a rectangle on the floor, and a uniform
  /// density over one is a uniform density over the other.
  FloorBox on_floor(const FilmBox& box) const {
    const double distance = camera_.origin.z;
    const Vec3 a = camera_.origin + camera_.direction(box.x0, box.y0) * distance;
    const Vec3 b = camera_.origin + camera_.direction(box.x1, box.y1) * distance;
    return {std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y)};
  }

 private:
  Camera camera_;
  double radius_, height_;
  Colour reflected_;  // albedo/π · Le
};

std::unique_ptr<PixelOracle> make_sphere_light(const OracleInput& input) {
  const double radius = parameter(input, "radius");
  const double height = parameter(input, "height");
  constexpr double kMax = std::numeric_limits<double>::max();
  require(radius > 0 && radius <= kMax, "radius must be positive and finite");
  require(std::abs(height) <= kMax, "height must be finite");
  require(out_of_view(input.camera, {0, 0, height}, radius),
          "the light would be in view, or hold the camera: the closed form is of the floor alone");
  auto oracle =
      std::make_unique<SphereLightOracle>(input.camera, radius, height, reflected_radiance(input));
  const FilmSize film = input.camera.film;
  const FloorBox seen =
      oracle->on_floor({0, 0, static_cast<double>(film.width), static_cast<double>(film.height)});
  require(seen.x0 >= -kSceneHalfSide && seen.x1 <= kSceneHalfSide && seen.y0 >= -kSceneHalfSide &&
              seen.y1 <= kSceneHalfSide,
          "the film is so narrow that it sees past the floor's edge");
  return oracle;
}

}  // namespace

KnownScene sphere_light() {
  KnownScene scene;
  scene.name = "sphere_light";
  scene.answer =
      "L = albedo * Le * sin^2(theta_max) * cos(theta) under a sphere above the floor; the "
      "clipped form where it dips into it";
  scene.view = {{1.75, 0, 1}, {1.75, 0, 0}, {0, 1, 0}, 90};
  scene.film = {128, 96};
  scene.max_depth = 2;
  scene.parameters = {{"radius", 0.8, "of the light [m], positive"},
                      {"height", 1, "of the light's centre over the floor [m], more than -radius"},
                      {"radiance", {3, 4, 5}, "Le of the light [rgb, W/(m² sr)], not negative"},
                      {"albedo", {0.9, 0.75, 0.4}, "reflectance of the floor [rgb], 0 to 1"}};
  scene.expectations = expect_pass_from_all();
  constexpr std::string_view kTooSmall =
      "directions that know nothing of the light find it once in 1e13 tries";
  // A direction from the BSDF meets the far light with P = sin²θ cosθ and then counts albedo · Le,
  // so its second moment is albedo · Le · L = (albedo · Le)² P; the mean of P over the film is
  // 1.538693e-13. Half of each of two techniques has a quarter of it, beside which the light
  // samples' is nothing.
  const Colour far{1.5e12, 1e12, 0.8e12};
  const Colour reflected = Colour{0.9, 0.75, 0.4} * far;
  const Colour average = reflected * reflected * (1.538693e-13 / 4);
  scene.variants = {{"cut_by_the_horizon", {{"height", 0.5}}, {}},
                    {"far",
                     {{"radius", 1e-6}, {"radiance", far}},
                     {{Strategy::bsdf, Expected::hopeless, kTooSmall},
                      {Strategy::uniform, Expected::hopeless, kTooSmall},
                      {Strategy::average, Expected::hopeless, kTooSmall, average}}}};
  scene.make = make_sphere_light;
  return scene;
}

}  // namespace plumbline::analytic
