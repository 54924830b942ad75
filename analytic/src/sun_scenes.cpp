#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include <plumbline/analytic/polygon_light.h>

#include "floor_oracle.h"
#include "scenes.h"

/// Sun and sky, and a light without extent.
namespace plumbline::analytic {
namespace {

constexpr Vec3 kNormal{0, 0, 1};
constexpr double kSunHalfAngle = 0.2665 * std::numbers::pi / 180;

/// The wall of sidewalk.xml: in the plane x = -1, |y| ≤ 2, up to z = 3.
const Polygon kWall{{-1, -2, 0}, {-1, 2, 0}, {-1, 2, 3}, {-1, -2, 3}};

/// Whether the wall covers the whole sun as seen from p, or none of it.
enum class Sun { covered, clear, partly };

Sun sun_behind_wall(const Vec3& p, const Vec3& to_sun, double half_angle) {
  // To be safe, a sun a little larger than it is, and square.
  const double margin = 2 * std::tan(half_angle);
  const Vec3 e1 = normalize(cross(to_sun, kNormal)), e2 = cross(e1, to_sun);
  int covered = 0;
  for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Vec3 w = to_sun + e1 * (a * margin) + e2 * (b * margin);
    const double t = (-1 - p.x) / w.x;
    const Vec3 hit = p + w * t;
    if (t > 0 && std::abs(hit.y) <= 2 && hit.z <= 3) ++covered;
  }
  return covered == 4 ? Sun::covered : covered == 0 ? Sun::clear : Sun::partly;
}

/// The sky gives π Lsky less what the black wall hides of it, by Lambert's formula; the sun
/// Lsun π sin²σ cosθ, or nothing.
std::unique_ptr<PixelOracle> make_sidewalk(const OracleInput& input) {
  const Colour reflected = reflected_radiance(input);
  const Colour albedo = albedo_over_pi(input);
  const Vec3 to_sun = normalize({-parameter(input, "sun_x"), 0.2, 1});
  const double sine = std::sin(kSunHalfAngle);
  const Colour sunlight = std::numbers::pi * sine * sine * to_sun.z * emitted(input, "sun");
  const double w = input.camera.film.width, h = input.camera.film.height;
  const auto seen = [&](double x, double y) {
    const Vec3 d = input.camera.direction(x, y);
    return sun_behind_wall(input.camera.origin + d * (-input.camera.origin.z / d.z), to_sun,
                           kSunHalfAngle);
  };
  const Sun place = seen(0, 0);
  require(place != Sun::partly && place == seen(w, 0) && place == seen(0, h) && place == seen(w, h),
          "the shadow's edge is in view: the closed form is of sun or shade alone");
  const Colour direct = place == Sun::clear ? albedo * sunlight : Colour();
  return floor_oracle(input.camera, 10, [=](const Vec3& p, const Vec3&) {
    return reflected * (std::numbers::pi - polygon_irradiance(kWall, p, kNormal)) + direct;
  });
}

KnownScene sidewalk() {
  KnownScene scene = floor_scene(
      "sidewalk",
      "L = albedo / pi * (Lsky * (pi - E_wall) + Lsun * pi * sin^2(0.2665 deg) * cos(theta)) in "
      "the sun, without the last term in the shade of a black wall",
      make_sidewalk);
  scene.view = {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 50};
  // The sun gives half of the light in every channel: if it gave less, its being met so seldom
  // would be taken for a bias (docs/statistics.md, skewed samples).
  scene.parameters = {
      {"sun_x", -0.5, "its light travels along (sun_x, -0.2, -1); 0.8 is from behind the wall"},
      {"sun", {24000, 20000, 25000}, "radiance of the sun [rgb, W/(m² sr)], not negative"},
      {"radiance", {0.3, 0.5, 0.6}, "Le of the sky [rgb, W/(m² sr)], not negative"},
      {"albedo", {0.6, 0.5, 0.35}, "reflectance of the sidewalk [rgb], 0 to 1"}};
  constexpr std::string_view kTooSmall =
      "directions that know nothing of the sun find it once in 1e5 tries";
  // A direction from the BSDF meets the sun with P = sin²σ cosθ, and then counts albedo · Lsun,
  // about 1e4: beside P times its square all other variance is small. One uniform on the hemisphere
  // meets it with 1 − cosσ and counts 2 albedo cosθ Lsun; half of each of two techniques has a
  // quarter of it.
  const double sine = std::sin(kSunHalfAngle), cosine = 1 / std::sqrt(1.29);
  const Colour reflected = Colour{0.6, 0.5, 0.35} * Colour{24000, 20000, 25000};
  const Colour bsdf = reflected * reflected * (sine * sine * cosine);
  const Colour uniform =
      reflected * reflected * (4 * cosine * cosine * sine * sine / (1 + std::cos(kSunHalfAngle)));
  scene.expectations =
      expect_pass_but_for({{Strategy::bsdf, Expected::hopeless, kTooSmall, bsdf},
                           {Strategy::uniform, Expected::hopeless, kTooSmall, uniform},
                           {Strategy::average, Expected::hopeless, kTooSmall, bsdf / 4}});
  constexpr std::string_view kHidden = "the wall hides the sun that these cannot find";
  scene.variants = {{"shade",
                     {{"sun_x", 0.8}},
                     {{Strategy::bsdf, Expected::pass, kHidden},
                      {Strategy::uniform, Expected::pass, kHidden},
                      {Strategy::average, Expected::pass, kHidden}}}};
  return scene;
}

/// f I cosθ/d² with f of the Phong lobe, n = 20.
std::unique_ptr<PixelOracle> make_point_glossy(const OracleInput& input) {
  constexpr double kSpotExponent = 20;
  const Colour scale =
      0.5 * (kSpotExponent + 2) * albedo_over_pi(input) * emitted(input, "intensity");
  return floor_oracle(input.camera, 10, [=](const Vec3& p, const Vec3& to_camera) {
    const Vec3 r = Vec3{1.2, 0, 1.2} - p;
    const double d2 = dot(r, r);
    const Vec3 wi = r * (1 / std::sqrt(d2));
    const double lobe = dot(wi, {-to_camera.x, -to_camera.y, to_camera.z});
    return lobe > 0 ? scale * (std::pow(lobe, kSpotExponent) * wi.z / d2) : Colour();
  });
}

KnownScene point_glossy() {
  KnownScene scene = floor_scene(
      "point_glossy",
      "L = albedo * (n + 2) / (2 pi) * cos^n(alpha) * I * cos(theta) / d^2 of a point light",
      make_point_glossy);
  scene.view = {{-1.2, 0, 1.2}, {0, 0, 0}, {0, 0, 1}, 40};
  scene.parameters = {{"intensity", {4, 5, 7}, "of the light [rgb, W/sr], not negative"},
                      {"albedo", {0.7, 1, 0.9}, "reflectance of the lobe [rgb], 0 to 1"}};
  constexpr std::string_view kUnmet = "no direction from a BSDF meets a point";
  scene.expectations = expect_pass_but_for({{Strategy::bsdf, Expected::fail, kUnmet},
                                            {Strategy::uniform, Expected::fail, kUnmet},
                                            {Strategy::average, Expected::fail, kUnmet}});
  return scene;
}

}  // namespace

std::vector<KnownScene> sun_scenes() { return {point_glossy(), sidewalk()}; }

}  // namespace plumbline::analytic
