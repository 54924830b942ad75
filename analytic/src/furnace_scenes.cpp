#include <stdexcept>

#include <plumbline/analytic/furnace.h>
#include <plumbline/analytic/silhouette.h>

#include "floor_oracle.h"
#include "scenes.h"

namespace plumbline::analytic {
namespace {

// Rounding of a handful of operations, and of areas whose terms are about a box side larger than
// the box: 2⁻⁵² × 10³ for films up to a thousand pixels wide.
constexpr double kRounding = 2.3e-13;

Average exact(const Colour& value) { return {value, kRounding * value}; }

class SphereOnBackgroundOracle final : public PixelOracle {
 public:
  SphereOnBackgroundOracle(const SphereSilhouette& sphere, FilmSize film, const Colour& on_sphere,
                           const Colour& background)
      : PixelOracle(film), sphere_(sphere), on_sphere_(on_sphere), background_(background) {}

  Average box_mean(const FilmBox& box) const override {
    const double covered = sphere_.coverage(box);
    return exact(on_sphere_ * covered + background_ * (1 - covered));
  }

 private:
  SphereSilhouette sphere_;
  Colour on_sphere_, background_;
};

constexpr double kSphereRadius = 1;  // of furnace_open.xml

std::unique_ptr<PixelOracle> make_furnace_open(const OracleInput& input) {
  const Colour radiance = colour(input, "radiance");
  const Colour on_sphere = by_channel(
      [&](double albedo, double emitted) {
        return open_furnace_radiance(albedo, emitted, input.max_depth);
      },
      colour(input, "albedo"), radiance);
  return std::make_unique<SphereOnBackgroundOracle>(
      SphereSilhouette(input.camera, {0, 0, 0}, kSphereRadius), input.camera.film, on_sphere,
      input.max_depth == 0 ? Colour() : radiance);
}

Colour closed_furnace(const Colour& albedo, const Colour& radiance, int max_depth) {
  return by_channel(
      [&](double a, double emitted) { return closed_furnace_radiance(a, emitted, max_depth); },
      albedo, radiance);
}

std::unique_ptr<PixelOracle> make_closed_furnace(const OracleInput& input) {
  return uniform_oracle(
      input.camera.film,
      closed_furnace(colour(input, "albedo"), colour(input, "radiance"), input.max_depth));
}

KnownScene furnace_open() {
  KnownScene scene;
  scene.name = "furnace_open";
  scene.answer = "L = albedo * Le on a convex Lambertian sphere, Le around it";
  scene.view = {{0, -4, 0}, {0.4, 0, 0.2}, {0, 0, 1}, 50};
  scene.film = {128, 96};
  scene.max_depth = -1;
  scene.parameters = {
      {"albedo", {0.9, 0.75, 0.4}, "reflectance of the sphere [rgb], 0 to 1"},
      {"radiance", {0.8, 1, 1.5}, "Le of the environment [rgb, W/(m² sr)], not negative"}};
  scene.expectations = expect_pass_from_all();
  scene.make = make_furnace_open;
  return scene;
}

KnownScene furnace_sphere() {
  KnownScene scene;
  scene.name = "furnace_sphere";
  scene.answer =
      "L = Le / (1 - albedo) inside a closed emitting sphere; Le * sum of albedo^i, i < "
      "max_depth, when truncated";
  scene.view = {{0.2, -0.3, 0.1}, {1, 0.4, -0.2}, {0, 0, 1}, 70};
  scene.film = {64, 64};
  scene.max_depth = -1;
  scene.parameters = {
      {"albedo",
       {0.6, 0.5, 0.3},
       "reflectance of the wall [rgb], 0 to 1 (less than 1 at any depth)"},
      {"radiance", {0.3, 0.5, 0.6}, "Le of the wall [rgb, W/(m² sr)], not negative"}};
  scene.expectations = expect_pass_from_all();
  // Paths go on for the channels that still carry light, whatever the first one does.
  scene.variants = {{"without_red", {{"albedo", {0, 0.5, 0.7}}}, {}}};
  scene.make = make_closed_furnace;
  return scene;
}

/// Inside the sphere of furnace_white.xml every direction is Le, so a convex sphere in it looks the
/// same as in an open furnace.
KnownScene furnace_white() {
  KnownScene scene = furnace_open();
  scene.name = "furnace_white";
  scene.answer = "L = albedo * Le on a convex Lambertian sphere inside a uniformly emitting sphere";
  scene.parameters = {
      {"albedo", {0.8, 1, 0.5}, "reflectance of the sphere [rgb], 0 to 1"},
      {"radiance", {1.4, 1, 1.8}, "Le of the sphere around [rgb, W/(m² sr)], not negative"}};
  return scene;
}

// Why area sampling alone cannot be shown to be right in the cube.
//
// Let the shaded point lie at distance h from an edge, and the light sample at height z on the
// adjacent face, a lateral distance t along the edge: d² = h² + z² + t², cosθ = z/d, cosθ' = h/d.
// With the face drawn uniformly by area (A the sampled area over its probability) the estimate is
//   X = (albedo/π) Le A G,  G = cosθ cosθ'/d² = h z/d⁴,
// and its second moment, with z = h z', t = h t',
//   E[X² | h] ∝ A ∫∫ h² z²/d⁸ dz dt = (A/h²) ∫∫ z'²/(1 + z'² + t'²)⁴ dz' dt' → C A/h²  as h → 0:
// finite at every point, but vertices of a path, and points of a pixel that sees an edge, have a
// positive density in h down to 0, and ∫ dh/h² diverges. So E[X²] is infinite: in every pixel once
// light that has been reflected twice counts (max_depth ≥ 3), in the pixels along edges at
// max_depth 2. The tail is P(X > x) ~ ∫ P(X > x | h) dh over h < x^(-1/2), each h² wide: x^(-3/2).
// The mean exists, the error falls like N^(-1/3), and no interval built on a sample variance means
// anything.
//
// Weighted with the BSDF's density p_b = cosθ/π the contribution is at most f cosθ Le/p_b =
// albedo·Le: the weights bound it, and `mis` and `one-sample` pass.
KnownScene furnace_cube() {
  KnownScene scene = furnace_sphere();
  scene.name = "furnace_cube";
  scene.variants.clear();
  scene.answer =
      "L = Le / (1 - albedo) inside a closed emitting cube; Le * sum of albedo^i, i < "
      "max_depth, when truncated";
  scene.view = {{0.2, -0.3, 0.1}, {1, 0.4, -0.2}, {0, 0, 1}, 90};
  constexpr std::string_view kReason =
      "sampling the adjacent faces by area has infinite variance near the edges: E[X²] grows like "
      "1/h² with the distance h to an edge";
  scene.expectations =
      expect_pass_but_for({{Strategy::light, Expected::infinite_variance, kReason},
                           {Strategy::average, Expected::infinite_variance, kReason}});
  return scene;
}

// The disk hides a cap of the sphere, and a cap that is the fraction f of the sphere's area has the
// form factor f from every point of the sphere: between points of a sphere dF = dA/(4πR²),
// wherever they are, and each line from outside the cap to the cap crosses the disk once. So
//   E = π Le f + ρ (1 − f) E  on the rest of the sphere, uniform: E = π Le f/(1 − ρ (1 − f)),
// and a path of at most k vertices carries the terms of Le ρ f Σ_{i < k − 1} (ρ (1 − f))ⁱ.
std::unique_ptr<PixelOracle> make_integrating_sphere(const OracleInput& input) {
  constexpr double kFraction = 0.1;  // (R − z)/(2R) of integrating_sphere.xml: R = 1, z = 0.8
  const Colour albedo = colour(input, "albedo");
  const int terms = input.max_depth < 1 ? input.max_depth : input.max_depth - 1;
  return uniform_oracle(input.camera.film, albedo * kFraction *
                                               closed_furnace(albedo * (1 - kFraction),
                                                              colour(input, "radiance"), terms));
}

KnownScene integrating_sphere() {
  KnownScene scene;
  scene.name = "integrating_sphere";
  scene.answer =
      "L = albedo * Le * f / (1 - albedo * (1 - f)) on the wall of a sphere lit by a black disk "
      "that cuts off f = 0.1 of its area; truncated, the first max_depth - 1 terms of the series";
  scene.view = {{0, 0, 0.2}, {0.3, 0.1, -1}, {0, 1, 0}, 60};
  scene.film = {64, 64};
  scene.max_depth = -1;
  scene.parameters = {{"albedo", {0.85, 0.8, 0.6}, "reflectance of the wall [rgb], 0 to 1"},
                      {"radiance", {7, 10, 12}, "Le of the disk [rgb, W/(m² sr)], not negative"}};
  constexpr std::string_view kReason =
      "sampling the disk by area has infinite variance near its rim, where it meets the wall: "
      "E[X²] grows like 1/h² with the distance h to it";
  scene.expectations =
      expect_pass_but_for({{Strategy::light, Expected::infinite_variance, kReason},
                           {Strategy::average, Expected::infinite_variance, kReason}});
  scene.make = make_integrating_sphere;
  return scene;
}

}  // namespace

std::vector<KnownScene> furnace_scenes() {
  return {furnace_cube(), furnace_open(), furnace_sphere(), furnace_white(), integrating_sphere()};
}

}  // namespace plumbline::analytic
