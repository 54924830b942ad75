#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <plumbline/analytic/polygon_light.h>

#include "floor_oracle.h"
#include "scenes.h"

/// Scenes lit by rectangles, triangles and a cone, on diffuse and Phong floors.
namespace plumbline::analytic {
namespace {

constexpr double kFloorHalfSide = 10;
constexpr Vec3 kUp{0, 0, 1};

/// [-a, a] × [-b, b] in the plane z = 0.
Polygon rectangle(double a, double b) { return {{-a, -b, 0}, {a, -b, 0}, {a, b, 0}, {-a, b, 0}}; }

/// Turned about the y axis, then moved, as the scene files do it.
Polygon placed(Polygon polygon, double tilt_degrees, const Vec3& to) {
  const double t = tilt_degrees * std::numbers::pi / 180;
  for (Vec3& p : polygon) {
    p = Vec3{p.x * std::cos(t) + p.z * std::sin(t), p.y, p.z * std::cos(t) - p.x * std::sin(t)} +
        to;
  }
  return polygon;
}

/// Where the film's corners lie on the floor.
std::vector<Vec3> seen_corners(const Camera& camera) {
  std::vector<Vec3> corners;
  const double w = camera.film.width, h = camera.film.height;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {w, 0.0}, {0.0, h}, {w, h}}) {
    const Vec3 d = camera.direction(x, y);
    corners.push_back(camera.origin + d * (-camera.origin.z / d.z));
  }
  return corners;
}

/// Whether one of the four planes through the pinhole and an edge of the film has all corners on
/// its outer side, or all are behind the camera.
bool out_of_view(const Camera& camera, const Polygon& polygon) {
  const double w = camera.film.width, h = camera.film.height;
  const std::array<Vec3, 4> rays = {camera.direction(0, 0), camera.direction(w, 0),
                                    camera.direction(w, h), camera.direction(0, h)};
  std::vector<Vec3> outward{camera.forward * -1};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vec3 plane = cross(rays[i], rays[(i + 1) % rays.size()]);
    outward.push_back(plane * (dot(plane, camera.forward) > 0 ? -1 : 1));
  }
  return std::any_of(outward.begin(), outward.end(), [&](const Vec3& n) {
    return std::all_of(polygon.begin(), polygon.end(),
                       [&](const Vec3& p) { return dot(n, p - camera.origin) >= 0; });
  });
}

/// A light that emits from its front only must face all of the floor that is seen, and the camera
/// must look away from it.
void require_front(const Camera& camera, const Polygon& light) {
  const Vec3 normal = cross(light[1] - light[0], light[2] - light[1]);
  bool in_front = true;
  for (const Vec3& p : seen_corners(camera)) in_front = in_front && dot(normal, p - light[0]) > 0;
  require(in_front, "part of the floor in view lies behind the light");
  require(out_of_view(camera, light),
          "the light may be in view: the closed form is of the floor alone");
}

std::unique_ptr<PixelOracle> diffuse_floor(const OracleInput& input, const Polygon& light) {
  const Colour reflected = reflected_radiance(input);
  require_front(input.camera, light);
  return floor_oracle(input.camera, kFloorHalfSide, [=](const Vec3& p, const Vec3&) {
    return reflected * polygon_irradiance(light, p, kUp);
  });
}

std::unique_ptr<PixelOracle> make_rectangle_light(const OracleInput& input) {
  return diffuse_floor(input, placed(rectangle(0.75, 1.5), parameter(input, "tilt"),
                                     {0, 0, parameter(input, "height")}));
}

/// The corners of triangle_light.obj.
Polygon triangle() { return {{-0.75, -1.5, 0}, {0.75, -1.2, 0}, {0.2, 1.6, 0}}; }

std::unique_ptr<PixelOracle> make_triangle_light(const OracleInput& input) {
  return diffuse_floor(
      input, placed(triangle(), parameter(input, "tilt"), {0, 0, parameter(input, "height")}));
}

KnownScene rectangle_light() {
  KnownScene scene = floor_scene(
      "rectangle_light",
      "L = albedo / pi * Le * Lambert's formula, under a rectangle that the horizon may cut",
      make_rectangle_light);
  scene.view = {{1.75, 0, 1}, {1.75, 0, 0}, {0, 1, 0}, 90};
  scene.parameters = {
      {"tilt", 180, "turn of the light about y [degrees]; 180 faces down, 90 along x"},
      {"height", 1.5, "of the light's centre over the floor [m]"},
      light_radiance({3, 4, 5}),
      floor_albedo({0.9, 0.75, 0.4})};
  scene.variants = {{"cut_by_the_horizon", {{"tilt", 90.0}, {"height", 0.2}}, {}}};
  return scene;
}

KnownScene triangle_light() {
  KnownScene scene = rectangle_light();
  scene.name = "triangle_light";
  scene.answer =
      "L = albedo / pi * Le * Lambert's formula, under a triangle that the horizon may cut";
  scene.make = make_triangle_light;
  return scene;
}

/// Two surfaces 1e-4 apart, the camera between them.
std::unique_ptr<PixelOracle> make_thin_gap(const OracleInput& input) {
  return diffuse_floor(input, placed(rectangle(1, 1), 180, {0, 0, 1e-4}));
}

KnownScene thin_gap() {
  KnownScene scene = floor_scene(
      "thin_gap",
      "L = albedo / pi * Le * Lambert's formula on a floor 1e-4 below an emitting square",
      make_thin_gap);
  scene.view = {{0, 0, 5e-5}, {0, 0, 0}, {0, 1, 0}, 90};
  scene.parameters = {light_radiance({0.8, 1, 1.5}), floor_albedo({0.9, 0.75, 0.4})};
  constexpr std::string_view kReason =
      "points spread over the area A of a light at the distance h seldom lie where they count: the "
      "variance is about A/h², 4e8 times the squared mean";
  scene.expectations = expect_pass_but_for({{Strategy::light, Expected::hopeless, kReason},
                                            {Strategy::average, Expected::hopeless, kReason}});
  return scene;
}

/// Neither the scale nor the place of a scene shows in its image.
std::unique_ptr<PixelOracle> make_scaled_moved(const OracleInput& input) {
  require(parameter(input, "scale") > 0, "scale must be positive");
  return diffuse_floor(input, placed(rectangle(0.5, 0.5), 180, {0, 0, 1.5}));
}

KnownScene scaled_moved() {
  KnownScene scene = floor_scene(
      "scaled_moved",
      "L = albedo / pi * Le * Lambert's formula, whatever the scale of the scene and its place",
      make_scaled_moved);
  scene.view = {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 90};
  scene.parameters = {{"scale", 1, "of everything, positive"},
                      {"offset", 0, "of everything along each axis [m]"},
                      light_radiance({3, 4, 5}),
                      floor_albedo({0.9, 0.75, 0.4})};
  scene.variants = {{"moved_by_1e5", {{"offset", 1e5}}, {}},
                    {"scaled_by_1e-3", {{"scale", 1e-3}}, {}},
                    {"scaled_by_1e3", {{"scale", 1e3}}, {}}};
  return scene;
}

/// The small light covers a part of the large one, as seen from every point in view: there its
/// radiance counts and the other's does not.
std::unique_ptr<PixelOracle> make_lights_overlap(const OracleInput& input) {
  const Colour reflected = reflected_radiance(input);
  const Colour albedo = albedo_over_pi(input);
  const Colour excess = emitted(input, "small") - emitted(input, "radiance");
  const Polygon large = placed(rectangle(1, 1), 180, {0, 0, 2});
  const Polygon small = placed(rectangle(0.25, 0.25), 180, {0, 0, 1});
  for (const Vec3& p : seen_corners(input.camera)) {
    // A corner of the small light is seen before 2·corner − p of the plane z = 2.
    require(0.5 + std::fmax(std::abs(p.x), std::abs(p.y)) <= 1,
            "the small light must stand before the large one from every point in view");
  }
  return floor_oracle(input.camera, kFloorHalfSide, [=](const Vec3& p, const Vec3&) {
    return reflected * polygon_irradiance(large, p, kUp) +
           albedo * excess * polygon_irradiance(small, p, kUp);
  });
}

KnownScene lights_overlap() {
  KnownScene scene = floor_scene(
      "lights_overlap",
      "L = albedo / pi * (Le * E_large + (small - Le) * E_small): one light in front of another",
      make_lights_overlap);
  scene.view = {{0, 0, 0.5}, {0, 0, 0}, {0, 1, 0}, 90};
  scene.parameters = {
      {"small", {6, 5, 2}, "Le of the small light [rgb, W/(m² sr)], not negative"},
      {"radiance", {0.8, 1, 1.5}, "Le of the large light [rgb, W/(m² sr)], not negative"},
      floor_albedo({0.9, 0.75, 0.4})};
  return scene;
}

int whole_exponent(const OracleInput& input) {
  const double n = parameter(input, "exponent");
  require(n >= 1 && n <= 1000 && n == std::floor(n), "exponent must be a whole number, 1 to 1000");
  return static_cast<int>(n);
}

Vec3 mirrored(const Vec3& to_camera) { return {-to_camera.x, -to_camera.y, to_camera.z}; }

/// (n + 2)/(2π) · reflectance · Le: what turns a moment into reflected radiance.
Colour phong_scale(const OracleInput& input, int exponent) {
  return reflected_radiance(input) * (0.5 * (exponent + 2));
}

std::unique_ptr<PixelOracle> make_phong_polygon(const OracleInput& input) {
  const int n = whole_exponent(input);
  const Colour scale = phong_scale(input, n);
  const Polygon light = placed(rectangle(0.6, 0.6), 225, {1.2, 0, 1.2});
  require_front(input.camera, light);
  return floor_oracle(input.camera, kFloorHalfSide, [=](const Vec3& p, const Vec3& to_camera) {
    return scale * polygon_moment(light, p, kUp, mirrored(to_camera), n);
  });
}

KnownScene phong_polygon() {
  KnownScene scene = floor_scene(
      "phong_polygon",
      "L = albedo * Le * (n + 2) / (2 pi) * the double-axis moment of a square over a Phong floor",
      make_phong_polygon);
  scene.view = {{-1.2, 0, 1.2}, {0, 0, 0}, {0, 0, 1}, 40};
  scene.parameters = {{"exponent", 20, "of the Phong lobe, a whole number"},
                      light_radiance({3, 4, 5}),
                      {"albedo", {0.9, 0.75, 0.4}, "reflectance of the lobe [rgb], 0 to 1"}};
  return scene;
}

/// A sphere light of radius 0.8 at (1.5, 0, 1.5): a cone of light from every point of the floor.
std::unique_ptr<PixelOracle> make_phong_cone(const OracleInput& input) {
  const int n = whole_exponent(input);
  const Colour scale = phong_scale(input, n);
  return floor_oracle(input.camera, kFloorHalfSide, [=](const Vec3& p, const Vec3& to_camera) {
    const Vec3 to_light = Vec3{1.5, 0, 1.5} - p;
    const double distance = std::sqrt(dot(to_light, to_light));
    return scale * cone_moment(to_light * (1 / distance), std::asin(0.8 / distance), kUp,
                               mirrored(to_camera), n);
  });
}

KnownScene phong_cone() {
  KnownScene scene = phong_polygon();
  scene.name = "phong_cone";
  scene.answer =
      "L = albedo * Le * cos(theta_r) * (1 - cos^(n+2)(theta)) where the cone of light is around "
      "the mirror direction; the double-axis moment of the cone beside it";
  scene.view = {{-1.5, 0, 1.5}, {0, 0, 0}, {0, 0, 1}, 20};
  scene.make = make_phong_cone;
  return scene;
}

}  // namespace

std::vector<KnownScene> polygon_scenes() {
  return {lights_overlap(), phong_cone(), phong_polygon(), rectangle_light(),
          scaled_moved(),   thin_gap(),   triangle_light()};
}

}  // namespace plumbline::analytic
