#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_math.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fourth::on;
using fourth::said;

/// A billiard ball after Blinn, with Torrance and Sparrow's grooves.
template <class T>
struct Billiard {
  T exponent = 60;
  int fault = 0;

  T d(const V3<T>& h, T n) const { return (n + 2) / (2 * pi_v<T>)*std::pow(h.z, n); }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> h = spherical(std::pow(1 - u.x, 1 / (exponent + 2)), 2 * pi_v<T> * u.y);
    if (!(dot(wo, h) > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, h);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    return d(h, fault == 1 ? exponent / 4 : exponent) * h.z / (4 * dot(wo, h));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    const T c = dot(wo, h), g = std::min(T(1), 2 * h.z * std::min(wo.z, wi.z) / c);
    return schlick(T(0.5), c) * d(h, exponent) * g / (4 * wo.z * wi.z);
  }
};

/// Ground metal of two exponents.
///
/// @source Ashikhmin, Shirley 2000, "An Anisotropic Phong BRDF Model", Eq. 4, 6 to 8
template <class T>
struct GroundMetal {
  T nu = 8, nv = 80;
  int fault = 0;

  T slope(T cos_phi, T sin_phi) const { return nu * sqr(cos_phi) + nv * sqr(sin_phi); }
  T of_half(const V3<T>& h) const {
    const T flat2 = h.x * h.x + h.y * h.y;
    const T e = flat2 > 0 ? (nu * h.x * h.x + nv * h.y * h.y) / flat2 : T(0);
    return std::sqrt((nu + 1) * (nv + 1)) / (2 * pi_v<T>)*std::pow(h.z, e);
  }
  T azimuth(T u) const {
    const T four = 4 * u;
    const int quadrant = std::min(static_cast<int>(four), 3);
    const T left = four - T(quadrant);
    const T first = std::atan(std::sqrt((nu + 1) / (nv + 1)) * std::tan(pi_v<T> / 2 * left));
    if (fault == 1) return first + T(quadrant) * pi_v<T> / 2;
    const T half = quadrant < 2 ? pi_v<T> : 2 * pi_v<T>;
    return quadrant % 2 == 1 ? half - first : half - pi_v<T> + first;
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T phi = azimuth(u), e = slope(std::cos(phi), std::sin(phi));
    const V3<T> h = spherical(std::pow(1 - v, 1 / (e + 1)), phi);
    if (!(dot(wo, h) > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, h);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    return of_half(h) / (4 * dot(wo, h));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    const T c = dot(wo, h);
    return schlick(T(0.7), c) * of_half(h) / (4 * c * std::max(wo.z, wi.z));
  }
};

/// Satin of two slopes, with the weight as Walter writes it.
///
/// @source Walter 2005, "Notes on the Ward BRDF", Eq. 6 to 10
template <class T>
struct Satin {
  T ax = T(0.3), ay = T(0.2);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T y = ay * std::sin(2 * pi_v<T> * v), x = ax * std::cos(2 * pi_v<T> * v);
    const T phi = fault == 2 ? std::atan(y / x) : std::atan2(y, x);
    const T steep = sqr(std::cos(phi) / ax) + sqr(std::sin(phi) / ay);
    const T tan2 = -std::log1p(-u) / steep;
    const V3<T> h = spherical(1 / std::sqrt(1 + tan2), phi);
    const T c = dot(wo, h);
    if (!(c > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, h);
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, T(0.5) * c * h.z * h.z * h.z * std::sqrt(wi.z / wo.z), q};
  }
  T slopes(const V3<T>& h) const {
    return std::exp(-(sqr(h.x / ax) + sqr(h.y / ay)) / sqr(h.z)) / (pi_v<T> * ax * ay);
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    return slopes(h) / (4 * dot(wo, h) * h.z * h.z * h.z);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T f = T(0.5) * slopes(unit(wo + wi)) / std::sqrt(wo.z * wi.z);
    return fault == 1 ? f : f / 4;
  }
};

BsdfOptions satin_options(std::vector<double> angles) {
  BsdfOptions options = seen_from(std::move(angles));
  options.conserves_energy = false;  // the model does not at grazing angles
  return options;
}

}  // namespace

void add_sealed_phong_cases(std::vector<Case>& cases) {
  using D3 = V3<double>;
  twin<D3>(cases, "fourth billiard ball/exponent 60/double", "Phong's exponent for Blinn's",
           said("pdf has a quarter of the exponent, as between mirror direction and half vector"),
           {CauseKind::roughness}, Billiard<double>{60, on(1)}, seen_from({20, 60}));
  twin<D3>(cases, "fourth ground metal/8, 80/double", "quadrants turned",
           said("quadrants follow by quarter turns, not each as the mirror image of the last"),
           {CauseKind::mirrored, CauseKind::tangent_frame}, GroundMetal<double>{8, 80, on(1)},
           seen_from({10, 50}));
  twin<D3>(cases, "fourth satin/0.3, 0.2/double", "f without 1/4",
           said("f lacks 1/4, the weight is right"), {CauseKind::value_constant},
           Satin<double>{0.3, 0.2, on(1)}, satin_options({15, 55}));
  twin<D3>(cases, "fourth satin/0.3, 0.25/double", "atan for atan2",
           said("the azimuth of h comes from atan and never leaves half a turn"),
           {CauseKind::support}, Satin<double>{0.3, 0.25, on(2)}, satin_options({0, 40}));
}

}  // namespace plumbline::tests::corpus
