#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include <plumbline/analytic/bsdf_albedo.h>
#include <plumbline/analytic/fresnel.h>

#include "floor_oracle.h"
#include "scenes.h"

/// White furnaces of every BSDF: a floor under a constant sky shows its directional albedo,
/// lossless glass shows the sky.
namespace plumbline::analytic {
namespace {

using Albedo = std::function<Colour(double cosine)>;

/// A smooth function of a cosine, tabulated: barycentric interpolation at Chebyshev's points.
class CosineTable {
 public:
  CosineTable(const Albedo& f, double low) : low_(low) {
    for (std::size_t k = 0; k < kPoints; ++k) {
      const double angle = std::numbers::pi * (static_cast<double>(k) + 0.5) / kPoints;
      x_[k] = 0.5 * (1 + low + (1 - low) * std::cos(angle));
      weight_[k] = (k % 2 == 0 ? 1 : -1) * std::sin(angle);
      f_[k] = f(x_[k]);
    }
    // Between the points, where interpolation is at its worst.
    for (std::size_t k = 1; k < kPoints; k += 3) {
      const double x = 0.5 * (x_[k - 1] + x_[k]);
      const Colour off = (*this)(x)-f(x), exact = f(x);
      error_ = std::max({error_, std::abs(off.r) / exact.r, std::abs(off.g) / exact.g,
                         std::abs(off.b) / exact.b});
    }
  }

  Colour operator()(double x) const {
    Colour above;
    double below = 0;
    for (std::size_t k = 0; k < kPoints; ++k) {
      if (x == x_[k]) return f_[k];
      const double w = weight_[k] / (x - x_[k]);
      above = above + w * f_[k];
      below += w;
    }
    return above / below;
  }

  double low() const { return low_; }
  double error() const { return error_; }  ///< relative, the largest seen between the points

 private:
  static constexpr std::size_t kPoints = 18;

  double low_, error_ = 0;
  std::array<double, kPoints> x_{}, weight_{};
  std::array<Colour, kPoints> f_{};
};

constexpr double kQuadratureError = 3e-6;  // relative, of the albedos

/// No point of a plane sees another, so L = albedo(θ) Le.
std::unique_ptr<PixelOracle> plane_furnace(const OracleInput& input, const Albedo& albedo) {
  const Colour radiance = emitted(input, "radiance");
  if (input.max_depth == 0 || input.max_depth == 1) return uniform_oracle(input.camera.film, 0);
  double lowest = 1;
  const double w = input.camera.film.width, h = input.camera.film.height;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {w, 0.0}, {0.0, h}, {w, h}}) {
    lowest = std::min(lowest, -normalize(input.camera.direction(x, y)).z);
  }
  require(lowest > 0.05, "the film sees the floor at too flat an angle");
  const CosineTable table(albedo, lowest);
  return floor_oracle(
      input.camera, 100,
      [=](const Vec3&, const Vec3& to_camera) { return radiance * table(to_camera.z); },
      {kQuadratureError + table.error(), 1e-9, 4});
}

constexpr double kAlpha = 0.5, kGlass = 1.5, kExponent = 20;

Vec3 at_cosine(double cosine) { return {std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine}; }

/// Reflectance of the metal of index eta + ik, in each channel, from what f gives of one.
template <class F>
Albedo of_metal(const OracleInput& input, const F& f) {
  return [f, eta = colour(input, "eta"), k = colour(input, "k")](double cosine) {
    return by_channel([&](double n, double kappa) { return f(cosine, Index{n, kappa}); }, eta, k);
  };
}

double rough_metal(double cosine, const Index& metal) {
  return ggx_reflection_albedo({kAlpha, kAlpha}, at_cosine(cosine),
                               [&](double c) { return interface_reflectance(c, 1, metal); });
}

double smooth_metal(double cosine, const Index& metal) {
  return interface_reflectance(cosine, 1, metal);
}

/// What it lets through is 1/η² of the radiance below, which is Le too.
double rough_glass(double cosine) {
  const auto reflectance = [](double c) { return interface_reflectance(c, 1, kGlass); };
  const Vec3 wo = at_cosine(cosine);
  return ggx_reflection_albedo({kAlpha, kAlpha}, wo, reflectance) +
         ggx_refraction_albedo({kAlpha, kAlpha}, wo, kGlass, [&](double c) {
           return 1 - reflectance(c);
         }) / (kGlass * kGlass);
}

constexpr std::string_view kBlind =
    "half of each technique: light that only a mirror's or a glass's own direction finds counts "
    "half";

/// @param own  the parameters of the floor
KnownScene furnace(std::string_view name, std::string_view answer, bool atoms,
                   const std::vector<Parameter>& own,
                   std::unique_ptr<PixelOracle> (*make)(const OracleInput&)) {
  KnownScene scene = floor_scene(name, answer, make);
  scene.view = {{0, 0, 1}, {1.2, 0.1, 0}, {0, 0, 1}, 50};
  scene.parameters = {
      {"radiance", {0.8, 1, 1.5}, "Le of the environment [rgb, W/(m² sr)], not negative"}};
  scene.parameters.insert(scene.parameters.end(), own.begin(), own.end());
  if (atoms) {
    scene.expectations = expect_pass_but_for({{Strategy::average, Expected::fail, kBlind}});
  }
  return scene;
}

std::vector<Parameter> diffuse_base(const Colour& albedo) {
  return {{"albedo", albedo, "reflectance of the diffuse part [rgb], 0 to 1"}};
}

std::vector<Parameter> phong_lobe() {
  return {{"albedo", {0.8, 1, 0.5}, "reflectance of the lobe [rgb], 0 to 1"}};
}

/// Its channels differ as much as copper's do.
std::vector<Parameter> metal() {
  return {{"eta", {0.1, 0.2, 1.2}, "index of the metal [rgb], not negative"},
          {"k", {4.5, 3.9, 2.4}, "its extinction [rgb], not negative"}};
}

std::unique_ptr<PixelOracle> make_phong_furnace(const OracleInput& input) {
  return plane_furnace(input, [albedo = reflectance(input, "albedo")](double c) {
    return albedo * phong_albedo(kExponent, c);
  });
}

std::unique_ptr<PixelOracle> make_coat_furnace(const OracleInput& input) {
  return plane_furnace(input, [albedo = reflectance(input, "albedo")](double c) {
    const double coat = clear_coat_albedo(kGlass, kAlpha, 0, c);
    return coat + albedo * (1 - coat);
  });
}

std::vector<KnownScene> floors() {
  return {
      furnace("furnace_coat",
              "L = Le * (E + albedo * (1 - E)), E(theta) what a rough coat reflects over a diffuse "
              "base",
              false, diffuse_base({0.7, 0.5, 0.25}), make_coat_furnace),
      furnace("furnace_phong", "L = Le * albedo(theta) of a modified Phong lobe, n = 20", false,
              phong_lobe(), make_phong_furnace),
      furnace("furnace_two_sided",
              "L = Le * albedo(theta) of the Phong lobe on the back of a floor, diffuse in front",
              false, phong_lobe(), make_phong_furnace),
      furnace("furnace_metal",
              "L = Le * albedo(theta) of rough metal, GGX alpha 0.5: single scattering, by "
              "quadrature over normals",
              false, metal(),
              [](const OracleInput& input) {
                return plane_furnace(input, of_metal(input, rough_metal));
              }),
      // Grey but for its light: one index for all channels, as a refracted path has one direction.
      furnace("furnace_rough_glass",
              "L = Le * (R(theta) + T(theta) / eta^2) of a rough glass surface, GGX alpha 0.5: "
              "single scattering, by quadrature over normals",
              false, {},
              [](const OracleInput& input) {
                return plane_furnace(input, [](double c) { return Colour(rough_glass(c)); });
              }),
      furnace("furnace_mirror", "L = Le * Fresnel's reflectance of metal", true, metal(),
              [](const OracleInput& input) {
                return plane_furnace(input, of_metal(input, smooth_metal));
              }),
      furnace("furnace_blend",
              "L = Le * (0.6 * albedo + 0.4): a diffuse floor and a perfect mirror", true,
              diffuse_base({0.7, 0.5, 0.25}), [](const OracleInput& input) {
                return plane_furnace(input, [albedo = reflectance(input, "albedo")](double) {
                  return 0.6 * albedo + 0.4;
                });
              })};
}

/// Lossless, whatever is reflected and refracted how often: all that reaches the eye came from the
/// sky, and outside radiance is conserved along every path.
std::unique_ptr<PixelOracle> make_lossless(const OracleInput& input) {
  const Colour radiance = emitted(input, "radiance");
  require(input.max_depth == -1, "light that is trapped long needs an unlimited depth");
  return uniform_oracle(input.camera.film, radiance);
}

/// Inside, L/η² is what is conserved. From points within R/η of the centre no direction meets the
/// surface beyond the critical angle, nor does any after a reflection: r sin is kept.
std::unique_ptr<PixelOracle> make_glass_inside(const OracleInput& input) {
  const double eta = parameter(input, "eta");
  const Vec3& eye = input.camera.origin;
  require(std::sqrt(dot(eye, eye)) < 1 / eta,
          "beyond R/eta from the centre some directions are trapped");
  const Colour radiance = emitted(input, "radiance");
  require(input.max_depth == -1, "light that is trapped long needs an unlimited depth");
  return uniform_oracle(input.camera.film, eta * eta * radiance);
}

KnownScene glass_sphere() {
  KnownScene scene = furnace("glass_sphere", "L = Le: a lossless glass sphere does not show", true,
                             {{"eta", 1.5, "index of the glass, 0.4 to 2.5"}}, make_lossless);
  scene.view = {{0, -4, 0}, {0.4, 0, 0.2}, {0, 0, 1}, 50};
  scene.max_depth = -1;
  scene.variants = {{"eta_1", {{"eta", 1.0}}, {}}};
  return scene;
}

KnownScene glass_film() {
  KnownScene scene = glass_sphere();
  scene.name = "glass_film";
  scene.answer = "L = Le: nor does one with a film of 400 nm on it";
  scene.parameters.pop_back();
  scene.variants.clear();
  return scene;
}

KnownScene glass_inside() {
  KnownScene scene = glass_sphere();
  scene.name = "glass_inside";
  scene.answer = "L = eta^2 * Le, seen from inside a glass sphere within R / eta of its centre";
  scene.view = {{0.3, 0.2, -0.1}, {1, 0.4, 0.3}, {0, 0, 1}, 90};
  scene.variants.clear();
  scene.make = make_glass_inside;
  return scene;
}

}  // namespace

std::vector<KnownScene> bsdf_scenes() {
  std::vector<KnownScene> scenes = floors();
  for (const KnownScene& glass : {glass_sphere(), glass_film(), glass_inside()}) {
    scenes.push_back(glass);
  }
  return scenes;
}

}  // namespace plumbline::analytic
