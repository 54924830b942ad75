#include <array>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_math.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fourth::on;
using fourth::said;

/// Wool along x, with scales that tilt its cones: three lobes, each logistic over the sine of the
/// inclination and a wrapped Cauchy density about the fibre.
template <class T>
struct Wool {
  int fault = 0;
  std::array<T, 3> tilt{T(0.15), T(-0.1), T(-0.25)}, spread{T(0.08), T(0.05), T(0.15)};
  std::array<T, 3> exit{T(0.4), T(2.8), T(-1.2)}, focus{T(0.3), T(0.7), T(0.5)};

  static T cdf(T x, T s) { return 1 / (1 + std::exp(-x / s)); }
  static T strength(const V3<T>& w, std::size_t p) {
    const T s2 = w.x * w.x;
    return p == 0 ? T(0.1) + T(0.4) * s2 : p == 1 ? T(0.5) - T(0.3) * s2 : T(0.2);
  }
  static T share(const V3<T>& w, std::size_t p) {
    return strength(w, p) / (strength(w, 0) + strength(w, 1) + strength(w, 2));
  }
  T along_pdf(T x, T centre, T s) const {
    const T e = std::exp(-std::abs(x - centre) / s);
    return e / (s * sqr(1 + e)) / (cdf(1 - centre, s) - cdf(-1 - centre, s));
  }
  static T about_pdf(T x, T rho) {
    return (1 - rho * rho) / (2 * pi_v<T> * (1 + rho * rho - 2 * rho * std::cos(x)));
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    std::size_t p = 0;
    T x = u.x;
    while (p < 2 && x >= share(wo, p)) x -= share(wo, p++);
    const T centre = tilt[p] - wo.x, s = spread[p];
    const T low = cdf(-1 - centre, s), k = low + u.y * (cdf(1 - centre, s) - low);
    const T sine = std::clamp(centre - s * std::log(1 / k - 1), T(-1), T(1));
    const T narrow = (1 - focus[p]) / (1 + focus[p]);
    const T phi = std::atan2(wo.z, wo.y) + exit[p] +
                  2 * std::atan(narrow * std::tan(pi_v<T> * (u.z - T(0.5))));
    const T cosine = safe_sqrt(1 - sine * sine);
    const V3<T> wi{sine, cosine * std::cos(phi), cosine * std::sin(phi)};
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, scattered(wo, wi) / q, q};
  }
  T lobe(const V3<T>& wo, const V3<T>& wi, std::size_t p, int which) const {
    const T centre = (which == 1 ? -tilt[p] : tilt[p]) - wo.x;
    const T turn = std::atan2(wi.z, wi.y) - std::atan2(wo.z, wo.y) - exit[p];
    return along_pdf(wi.x, centre, spread[p]) * about_pdf(turn, focus[which == 2 ? 0 : p]);
  }
  T pdf(const V3<T>& given, const V3<T>& sampled) const {
    const V3<T>&wo = fault == 5 ? sampled : given, &wi = fault == 5 ? given : sampled;
    T sum = 0;
    for (std::size_t p = 0; p < 3; ++p) {
      sum += share(fault == 3 ? wi : wo, p) * lobe(wo, wi, p, fault);
    }
    return sum;
  }
  T scattered(const V3<T>& wo, const V3<T>& wi) const {
    T sum = 0;
    for (std::size_t p = 0; p < 3; ++p) sum += strength(wo, p) * lobe(wo, wi, p, 0);
    return sum;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    const T cosine = fault == 4 ? safe_sqrt(1 - wi.x * wi.x) : std::abs(wi.z);
    return cosine > 0 ? scattered(wo, wi) / cosine : T(0);
  }
};

template <class T>
Wool<T> wool(int fault) {
  Wool<T> w;
  w.fault = on(fault);
  return w;
}

BsdfOptions wool_options(double angle) {
  BsdfOptions options = from_both_faces({angle});
  options.reciprocal = false;
  return options;
}

}  // namespace

void add_sealed_hair_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fourth wool/double", "scales tilt the other way in pdf",
           said("pdf has the sign of the scales' tilt the wrong way round"),
           {CauseKind::shifted, CauseKind::mirrored}, wool<double>(1), wool_options(35));
  twin<D3>(cases, "fourth wool/double", "one azimuthal width in pdf",
           said("pdf has the first lobe's width about the fibre for all of them"),
           {CauseKind::roughness}, wool<double>(2), wool_options(50));
  twin<D3>(cases, "fourth wool/double", "shares of wi in pdf",
           said("T3: pdf weighs the lobes by their strength for wi, sample by that for wo"),
           {CauseKind::lobe_probability, CauseKind::directions_swapped}, wool<double>(3),
           wool_options(60));
  twin<D3>(cases, "fourth wool/double", "wo and wi exchanged in pdf",
           said("B13: pdf takes its arguments the other way round"),
           {CauseKind::directions_swapped}, wool<double>(5), wool_options(45));
  twin<F3>(cases, "fourth wool/float", "f over the inclination's cosine",
           said("f is divided by the cosine of the inclination, not by that at the surface"),
           {CauseKind::value_cosine}, wool<float>(4), wool_options(30));
}

}  // namespace plumbline::tests::corpus
