#include <cmath>
#include <utility>

#include <plumbline/analytic/bsdf_albedo.h>
#include <plumbline/analytic/fresnel.h>

#include "off_default_parts.h"

namespace plumbline::tests {
namespace {

using analytic::Index;
using analytic::Vec3;

/// ITU-R BT.709-6, Section 3.2.
double luminance_of(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }

// BSDFs in the plane z = 0 under a white sky, from (0.576, 0.768, 0.28), where
// roughness matters, along neither axis: their albedo. A sky all around is
// also behind what light passes.

constexpr double kCosine = 0.28;
constexpr Vec3 kSide{0.576, 0.768, 0.28};

OffDefault under_sky(const std::string& name, const std::string& bsdf,
                     std::vector<std::string> covers, double albedo,
                     const std::string& from = "0.576 0.768 0.28") {
  return {name, eye(from) + kDirect + sky("1") + R"(<shape type="rectangle">)" + bsdf + "</shape>",
          std::move(covers), albedo};
}

/// Without light samples alone: they find nothing of what a mirror does, and narrow lobes seldom.
OffDefault by_bsdf(OffDefault known) {
  known.strategies = {renderer::Strategy::bsdf, renderer::Strategy::mis};
  return known;
}

analytic::Share reflectance(double outside, Index inside) {
  return [=](double cosine) { return analytic::interface_reflectance(cosine, outside, inside); };
}

constexpr const char* kGgx = R"(<string name="distribution" value="ggx"/>)";
constexpr const char* kStretched =
    R"(<float name="alpha_u" value="0.6"/><float name="alpha_v" value="0.2"/>)";
constexpr const char* kIndices =
    R"(<float name="int_ior" value="1.8"/><float name="ext_ior" value="1.25"/>)";
constexpr const char* kCopper = R"(<string name="material" value="Cu"/>)";

/// Copper in Mitsuba 3's linear RGB.
const Index kCopperRgb[] = {{0.200438, 3.91295}, {0.924033, 2.45285}, {1.10221, 2.14219}};

std::vector<OffDefault> conductors() {
  const Index metal(0.5, 1.5);
  const std::string by_index = R"(<rgb name="eta" value="0.5"/><rgb name="k" value="1.5"/>)";
  const auto smooth = [](Index m) { return analytic::interface_reflectance(kCosine, 1, m); };
  const auto rough = [](const analytic::Roughness& alpha, Index m) {
    return analytic::ggx_reflection_albedo(alpha, kSide, reflectance(1, m));
  };
  const auto colour = [](const auto& of) {
    return luminance_of(of(kCopperRgb[0]), of(kCopperRgb[1]), of(kCopperRgb[2]));
  };
  const std::string alpha = R"(<float name="alpha" value="0.5"/>)";
  return {
      by_bsdf(under_sky("conductor", R"(<bsdf type="conductor">)" + by_index + "</bsdf>",
                        {"conductor.eta", "conductor.k"}, smooth(metal))),
      by_bsdf(under_sky("copper", std::string(R"(<bsdf type="conductor">)") + kCopper + "</bsdf>",
                        {"conductor.material"}, colour(smooth))),
      by_bsdf(under_sky(
          "rough_conductor",
          std::string(R"(<bsdf type="roughconductor">)") + kGgx + kStretched + by_index + "</bsdf>",
          {"roughconductor.distribution", "roughconductor.alpha_u", "roughconductor.alpha_v",
           "roughconductor.eta", "roughconductor.k"},
          rough({0.6, 0.2}, metal))),
      by_bsdf(under_sky(
          "rough_copper",
          std::string(R"(<bsdf type="roughconductor">)") + kGgx + alpha + kCopper + "</bsdf>",
          {"roughconductor.material", "roughconductor.alpha"}, colour([&](Index m) {
            return rough({0.5, 0.5}, m);
          })))};
}

std::vector<OffDefault> dielectrics() {
  // What comes through has been concentrated on the way in: (η_o/η_i)² of the sky's radiance.
  const double eta = 1.8 / 1.25, f = analytic::interface_reflectance(kCosine, 1.25, 1.8);
  const auto rough = [&](const analytic::Roughness& alpha) {
    const auto share = reflectance(1.25, 1.8);
    const auto rest = [&](double cosine) { return 1 - share(cosine); };
    return analytic::ggx_reflection_albedo(alpha, kSide, share) +
           analytic::ggx_refraction_albedo(alpha, kSide, eta, rest) / (eta * eta);
  };
  const std::string type = R"(<bsdf type="roughdielectric">)";
  return {by_bsdf(under_sky(
              "dielectric", std::string(R"(<bsdf type="dielectric">)") + kIndices + "</bsdf>",
              {"dielectric.int_ior", "dielectric.ext_ior"}, f + (1 - f) / (eta * eta))),
          by_bsdf(under_sky(
              "rough_dielectric", type + kGgx + kIndices + kStretched + "</bsdf>",
              {"roughdielectric.distribution", "roughdielectric.int_ior", "roughdielectric.ext_ior",
               "roughdielectric.alpha_u", "roughdielectric.alpha_v"},
              rough({0.6, 0.2}))),
          by_bsdf(under_sky("rough_dielectric_alike",
                            type + kGgx + kIndices + R"(<float name="alpha" value="0.9"/></bsdf>)",
                            {"roughdielectric.alpha"}, rough({0.9, 0.9})))};
}

OffDefault thin_film() {
  const Index base(1.5, 2);
  const auto band = [&](double low, double high) {
    return analytic::film_band_reflectance(kCosine, 1, 1.7, base, 150, low, high);
  };
  return by_bsdf(under_sky("thin_film",
                           R"(<bsdf type="thinfilm"><float name="thickness" value="150"/>
      <float name="film_ior" value="1.7"/><bsdf type="conductor"><rgb name="eta" value="1.5"/>
      <rgb name="k" value="2"/></bsdf></bsdf>)",
                           {"thinfilm.thickness", "thinfilm.film_ior", "thinfilm.bsdf"},
                           luminance_of(band(590, 700), band(490, 590), band(400, 490))));
}

std::vector<OffDefault> other_bsdfs() {
  return {thin_film(),
          under_sky("clear_coat",
                    R"(<bsdf type="clearcoat"><rgb name="reflectance" value="0.7"/>
      <float name="alpha" value="0.6"/>)" +
                        std::string(kIndices) + "</bsdf>",
                    {"clearcoat.reflectance", "clearcoat.alpha", "clearcoat.int_ior",
                     "clearcoat.ext_ior"},
                    analytic::clear_coat_albedo(1.8 / 1.25, 0.6, 0.7, kCosine)),
          by_bsdf(under_sky("phong",
                            R"(<bsdf type="phong"><rgb name="reflectance" value="0.7"/>
      <float name="exponent" value="3"/></bsdf>)",
                            {"phong.reflectance", "phong.exponent"},
                            0.7 * analytic::phong_albedo(3, kCosine))),
          under_sky("two_sided_from_behind",
                    R"(<bsdf type="twosided">)" + diffuse("0.2") + diffuse("0.7") + "</bsdf>",
                    {"twosided.bsdf"}, 0.7, "0.576 0.768 -0.28"),
          under_sky("blend",
                    R"(<bsdf type="blendbsdf"><float name="weight" value="0.3"/>)" +
                        diffuse("0.2") + diffuse("0.9") + "</bsdf>",
                    {"blendbsdf.weight", "blendbsdf.bsdf"}, 0.7 * 0.2 + 0.3 * 0.9)};
}

}  // namespace

std::vector<OffDefault> off_default_bsdfs() {
  std::vector<OffDefault> all = other_bsdfs();
  for (const auto& more : {conductors(), dielectrics()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace plumbline::tests
