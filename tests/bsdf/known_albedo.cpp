#include "known_albedo.h"

#include <array>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <cmath>
#include <vector>

#include <plumbline/analytic/bsdf_albedo.h>
#include <plumbline/analytic/fresnel.h>

namespace plumbline::tests {
namespace {

using namespace renderer;
using analytic::Index;

/// The albedo of each alternative of the variant; one that has none here does not compile.
struct KnownAlbedo {
  const BsdfSet& set;
  Vec3d wo;
  std::size_t channel;
  const FilmLayer* film = nullptr;

  double of(std::uint32_t index) const { return std::visit(*this, set.alternative(index)); }

  double operator()(const Lambertian& b) const { return wo.z < 0 ? 0 : channel_of(b.albedo); }

  double operator()(const ModifiedPhong& b) const {
    if (wo.z < 0) return 0;
    return channel_of(b.reflectance) * analytic::phong_albedo(double{b.exponent}, wo.z);
  }

  double operator()(const GgxConductor& b) const {
    return wo.z < 0 ? 0 : rough(b.ggx, on_metal(b.fresnel));
  }

  double operator()(const SmoothConductor& b) const {
    return wo.z < 0 ? 0 : on_metal(b.fresnel)(wo.z);
  }

  double operator()(const GgxDielectric& b) const {
    const double eta = double{b.interface.eta};
    const analytic::Share reflected = on_glass(eta);
    return rough(b.ggx, reflected) +
           analytic::ggx_refraction_albedo(roughness(b.ggx), upright(), wo.z > 0 ? eta : 1 / eta,
                                           [&](double c) { return 1 - reflected(c); });
  }

  double operator()(const SmoothDielectric&) const { return 1; }  // nothing is lost

  double operator()(const ClearCoat& b) const {
    if (wo.z < 0) return 0;
    return analytic::clear_coat_albedo(double{b.eta()}, double{b.alpha()},
                                       channel_of(b.base_albedo()), wo.z);
  }

  double operator()(const ThinFilm& b) const {
    const KnownAlbedo under_film{set, wo, channel, &b.film()};
    return std::visit([&](const auto& base) { return under_film(base); }, b.base());
  }

  double operator()(const TwoSided& b) const {
    return KnownAlbedo{set, {wo.x, wo.y, std::abs(wo.z)}, channel}.of(wo.z < 0 ? b.back : b.front);
  }

  double operator()(const Mixture& b) const {
    return (1 - double{b.weight}) * of(b.first) + double{b.weight} * of(b.second);
  }

 private:
  double channel_of(const Rgbf& c) const {
    return std::array<double, 3>{double{c.r}, double{c.g}, double{c.b}}[channel];
  }

  analytic::Vec3 upright() const { return {wo.x, wo.y, std::abs(wo.z)}; }

  static analytic::Roughness roughness(const Ggx& ggx) {
    return {double{ggx.alpha_x}, double{ggx.alpha_y}};
  }

  double rough(const Ggx& ggx, const analytic::Share& reflectance) const {
    return analytic::ggx_reflection_albedo(roughness(ggx), upright(), reflectance);
  }

  /// Reflectance of an interface as a function of the cosine on the side of wo: bare, or the mean
  /// over the channel's band under the film.
  analytic::Share reflectance(double outside, Index inside) const {
    if (film == nullptr) {
      return
          [=](double cosine) { return analytic::interface_reflectance(cosine, outside, inside); };
    }
    constexpr std::array<double, 4> kBandEdges{700, 590, 490, 400};  // [nm]
    return tabulated([&](double cosine) {
      return analytic::film_band_reflectance(cosine, outside, double{film->eta}, inside,
                                             double{film->thickness}, kBandEdges[channel + 1],
                                             kBandEdges[channel]);
    });
  }

  /// A spline through 2,001 cosines: an integral inside of two more would take minutes.
  static analytic::Share tabulated(const analytic::Share& function) {
    constexpr int kSteps = 2000;
    std::vector<double> values;
    for (int i = 0; i <= kSteps; ++i) values.push_back(function(i / double{kSteps}));
    return boost::math::interpolators::cardinal_cubic_b_spline<double>(values.begin(), values.end(),
                                                                       0.0, 1.0 / kSteps);
  }

  analytic::Share on_metal(const ConductorFresnel& fresnel) const {
    return reflectance(1, {channel_of(fresnel.eta()), channel_of(fresnel.k())});
  }

  analytic::Share on_glass(double eta) const {
    return wo.z > 0 ? reflectance(1, eta) : reflectance(eta, 1);
  }
};

}  // namespace

double known_albedo(const Example& example, const Vec3d& wo, std::size_t channel) {
  const auto last = static_cast<std::uint32_t>(example.set->size() - 1);
  return KnownAlbedo{*example.set, wo, channel}.of(last);
}

double albedo_tolerance(const Example& example) {
  for (std::uint32_t i = 0; i < example.set->size(); ++i) {
    if (std::holds_alternative<ClearCoat>(example.set->alternative(i))) return 3e-3;
  }
  return 1e-3;
}

}  // namespace plumbline::tests
