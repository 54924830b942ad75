#include <plumbline/analytic/bsdf_albedo.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <plumbline/analytic/fresnel.h>

namespace plumbline::analytic {
namespace {

using std::numbers::pi;

using boost::math::quadrature::gauss_kronrod;

/// 1/(1 + Λ), Λ = (√(1 + α² tan²θ) − 1)/2. Walter et al. 2007, Eq. 34.
double masking(const Roughness& roughness, const Vec3& w) {
  const double x = roughness.x * w.x / w.z, y = roughness.y * w.y / w.z;
  return 2 / (1 + std::sqrt(1 + x * x + y * y));
}

/// Where a normal sends the light.
using Scatter = std::function<std::optional<Vec3>(const Vec3& normal, double cosine)>;

/// Where along a turn a condition begins or ceases to hold, after which nothing is smooth; at both
/// ends too.
template <class Condition>
std::vector<double> borders_along_turn(const Condition& holds) {
  constexpr int kSteps = 48, kHalvings = 30;
  std::vector<double> borders{0};
  double from = 0;
  bool before = holds(from);
  for (int i = 1; i <= kSteps; ++i) {
    const double to = 2 * pi * i / kSteps;
    const bool after = holds(to);
    if (after != before) {
      double low = from, high = to;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = (low + high) / 2;
        (holds(middle) == before ? low : high) = middle;
      }
      borders.push_back((low + high) / 2);
    }
    from = to;
    before = after;
  }
  borders.push_back(2 * pi);
  return borders;
}

/// The mean over GGX normals of share · G1 G1 (wo·h)/(cosθo cosθh). With slopes αr(cosφ, sinφ) the
/// distribution is 1/(π (1 + r²)²) r dr dφ, so t = r²/(1 + r²) and φ are uniform.
double mean_over_normals(const Roughness& roughness, const Vec3& wo, const Share& share,
                         const Scatter& scatter) {
  const double mask = masking(roughness, wo);
  struct Scattered {
    Vec3 wi;
    double cosine, along;  // wo·h, (wo·h)/cosθh
  };
  const auto scattered = [&](double r, double phi) -> std::optional<Scattered> {
    const Vec3 h{roughness.x * r * std::cos(phi), roughness.y * r * std::sin(phi), 1};
    const double along = dot(wo, h);
    if (!(along > 0)) return std::nullopt;
    const Vec3 normal = normalize(h);
    const double cosine = std::min(dot(wo, normal), 1.0);
    const std::optional<Vec3> wi = scatter(normal, cosine);
    if (!wi) return std::nullopt;
    return Scattered{*wi, cosine, along};
  };
  const auto at = [&](double r, double phi) {
    const auto s = scattered(r, phi);
    return s ? share(s->cosine) * mask * masking(roughness, s->wi) * s->along / wo.z : 0.0;
  };
  // Towards t = 1 normals lie down and nothing is smooth: s = 1 − t as s = v² spreads it out.
  const auto over_azimuth = [&](double v) {
    const double r = std::sqrt(1 - v * v) / v;
    const std::vector<double> borders =
        borders_along_turn([&](double phi) { return scattered(r, phi).has_value(); });
    double sum = 0;
    for (std::size_t i = 1; i < borders.size(); ++i) {
      sum += gauss_kronrod<double, 15>::integrate([&](double phi) { return at(r, phi); },
                                                  borders[i - 1], borders[i], 10, 1e-6);
    }
    return 2 * v * sum / (2 * pi);
  };
  return gauss_kronrod<double, 15>::integrate(over_azimuth, 0.0, 1.0, 10, 1e-6);
}

/// ∫ max(0, a + b cosφ) dφ over a turn, b ≥ 0.
double positive_part(double a, double b) {
  if (a >= b) return 2 * pi * a;
  if (a <= -b) return 0;
  const double edge = std::acos(-a / b);
  return 2 * (a * edge + b * std::sin(edge));
}

/// Share of a turn on which a + b cosφ > 0, b ≥ 0.
double positive_share(double a, double b) {
  if (a >= b) return 1;
  if (a <= -b) return 0;
  return std::acos(-a / b) / pi;
}

/// The mean of g(cosα cosθ, sinα sinθ) over the density (n + 1) cosⁿα sinα dα: uniform in
/// cosⁿ⁺¹α. Split where the lobe's ring first meets the horizon.
template <class Function>
double mean_over_lobe(double exponent, double cosine, const Function& g) {
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  const auto at = [&](double v) {
    const double log_cos = std::log(v) / (exponent + 1);
    return g(std::exp(log_cos) * cosine, std::sqrt(-std::expm1(2 * log_cos)) * sine);
  };
  const double edge = std::pow(sine, exponent + 1);  // cosα cosθ = sinα sinθ: cosα = sinθ
  return gauss_kronrod<double, 15>::integrate(at, 0.0, edge, 15, 1e-11) +
         gauss_kronrod<double, 15>::integrate(at, edge, 1.0, 15, 1e-11);
}

}  // namespace

double ggx_reflection_albedo(const Roughness& roughness, const Vec3& wo, const Share& reflectance) {
  return mean_over_normals(roughness, wo, reflectance,
                           [&](const Vec3& h, double cosine) -> std::optional<Vec3> {
                             const Vec3 wi = h * (2 * cosine) - wo;
                             if (!(wi.z > 0)) return std::nullopt;
                             return wi;
                           });
}

double ggx_refraction_albedo(const Roughness& roughness, const Vec3& wo, double eta,
                             const Share& transmittance) {
  return mean_over_normals(
      roughness, wo, transmittance, [&](const Vec3& h, double cosine) -> std::optional<Vec3> {
        const double square = 1 - (1 - cosine * cosine) / (eta * eta);
        if (!(square > 0)) return std::nullopt;
        const Vec3 wi = h * (cosine / eta - std::sqrt(square)) - wo * (1 / eta);
        if (!(wi.z < 0)) return std::nullopt;
        return wi;
      });
}

double phong_albedo(double exponent, double cosine) {
  const double mean = mean_over_lobe(
      exponent, cosine, [](double a, double b) { return positive_part(a, b) / (2 * pi); });
  return (exponent + 2) / (exponent + 1) * mean;
}

double phong_mass_above_horizon(double exponent, double cosine) {
  return mean_over_lobe(exponent, cosine, positive_share);
}

double clear_coat_albedo(double eta, double alpha, double base_albedo, double cosine) {
  const double coat =
      ggx_reflection_albedo({alpha, alpha}, {std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine},
                            [eta](double c) { return interface_reflectance(c, 1, eta); });
  return coat + base_albedo * (1 - coat);
}

}  // namespace plumbline::analytic
