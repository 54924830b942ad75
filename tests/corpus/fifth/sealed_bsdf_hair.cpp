#include <array>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_facets.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {
namespace fifth {
namespace {

/// A strand along x: what its scales reflect, and what passes through it. Logistic in the
/// inclination; about the strand the cosine of half the turn, or logistic around the far side.
///
/// @source Marschner et al. 2003, §5; trimmed logistic after Chiang et al. 2016, Eq. 10
template <class T>
struct Strand {
  std::array<T, 2> tilt{T(-0.07), T(0.035)}, spread{T(0.08), T(0.05)};
  T turn_spread = T(0.25);
  int fault = 0;

  static T cdf(T x, T s) { return 1 / (1 + std::exp(-x / s)); }
  static T logistic(T x, T s, T low, T high) {
    if (!(x >= low && x <= high)) return 0;
    const T e = std::exp(-std::abs(x) / s);
    return e / (s * (1 + e) * (1 + e)) / (cdf(high, s) - cdf(low, s));
  }
  static T draw_logistic(T u, T s, T low, T high) {
    const T k = cdf(low, s) + u * (cdf(high, s) - cdf(low, s));
    return std::clamp(-s * std::log(1 / k - 1), low, high);
  }
  static T inclination(const V3<T>& w) { return std::atan2(w.x, std::hypot(w.y, w.z)); }
  static T about(const V3<T>& w) { return std::atan2(w.z, w.y); }

  /// How much light each lobe carries.
  static std::array<T, 2> carried(const V3<T>& w) {
    const T f = schlick(T(0.05), std::cos(inclination(w)));
    return {f + T(0.1), (1 - f) * T(0.6)};
  }
  static T first_share(const V3<T>& w) {
    const std::array<T, 2> a = carried(w);
    return a[0] / (a[0] + a[1]);
  }
  T along(const V3<T>& wo, const V3<T>& wi, std::size_t p, bool other_tilt) const {
    const T centre = (other_tilt ? -tilt[p] : tilt[p]) - inclination(wo);
    const T quarter = pi_v<T> / 2;
    return logistic(inclination(wi) - centre, spread[p], -quarter - centre, quarter - centre);
  }
  T round(const V3<T>& wo, const V3<T>& wi, std::size_t p, T s) const {
    const T turn = std::remainder(about(wi) - about(wo), 2 * pi_v<T>);
    if (p == 0) return std::cos(turn / 2) / 4;
    return logistic(std::remainder(turn - pi_v<T>, 2 * pi_v<T>), s, -pi_v<T>, pi_v<T>);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    const std::size_t p = u.x < first_share(wo) ? 0 : 1;
    const T centre = tilt[p] - inclination(wo), quarter = pi_v<T> / 2;
    const T theta = centre + draw_logistic(u.y, spread[p], -quarter - centre, quarter - centre);
    const T turn = p == 0 ? 2 * std::asin(2 * u.z - 1)
                          : pi_v<T> + draw_logistic(u.z, turn_spread, -pi_v<T>, pi_v<T>);
    const T phi = about(wo) + turn, c = std::cos(theta);
    const V3<T> wi{std::sin(theta), c * std::cos(phi), c * std::sin(phi)};
    const T q = pdf(wo, wi);
    if (!(q > 0) || wi.z == 0) return std::nullopt;
    return Sampled<T>{wi, scattered(wo, wi) / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    const T p = fault == 4 ? T(0.5) : first_share(wo);
    const T s = fault == 3 ? turn_spread * turn_spread : turn_spread;
    const T sum = p * along(wo, wi, 0, fault == 2) * round(wo, wi, 0, s) +
                  (1 - p) * along(wo, wi, 1, fault == 2) * round(wo, wi, 1, s);
    return fault == 1 ? sum : sum / std::hypot(wi.y, wi.z);
  }
  T scattered(const V3<T>& wo, const V3<T>& wi) const {
    const std::array<T, 2> a = carried(wo);
    T sum = 0;
    for (std::size_t p = 0; p < 2; ++p) {
      sum += a[p] * along(wo, wi, p, false) * round(wo, wi, p, turn_spread);
    }
    return sum / std::hypot(wi.y, wi.z);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return wi.z == 0 ? T(0) : scattered(wo, wi) / std::abs(wi.z);
  }
};

template <class T>
Strand<T> strand(int fault, std::array<T, 2> tilt = {T(-0.07), T(0.035)}) {
  Strand<T> s;
  s.tilt = tilt;
  s.fault = put(fault);
  return s;
}

BsdfOptions strand_options(std::vector<double> angles) {
  BsdfOptions options = from_both_faces(std::move(angles));
  options.reciprocal = false;
  return options;
}

}  // namespace
}  // namespace fifth

void add_sealed_hair_cases(std::vector<Case>& cases) {
  using namespace fifth;
  using D3 = V3<double>;
  twin<D3>(cases, "fifth strand/double", "cosine of the strand forgotten",
           because("pdf lacks 1/cos of the inclination to the strand"),
           {CauseKind::cosine, CauseKind::sine}, strand<double>(1), strand_options({20, 40}));
  twin<D3>(cases, "fifth strand/tilt 0.1/double", "tilt of the other sign in pdf",
           because("pdf tilts the scales the other way"), {CauseKind::mirrored, CauseKind::shifted},
           strand<double>(2, {-0.1, 0.06}), strand_options({15, 40}));
  twin<D3>(cases, "fifth strand/spread 0.25/double", "spread squared in pdf",
           because("pdf has the variance where sample has the spread"), {CauseKind::roughness},
           strand<double>(3), strand_options({10, 35}));
  twin<D3>(cases, "fifth strand/lobes/double", "lobes as if even",
           because("pdf gives half to each lobe, sample goes by the light that they carry"),
           {CauseKind::lobe_probability}, strand<double>(4), strand_options({45, 60}));
}

}  // namespace plumbline::tests::corpus
