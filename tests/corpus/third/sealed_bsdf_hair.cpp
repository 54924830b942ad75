#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_math.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fresh::on;
using fresh::said;

/// Fur along x: a lobe over the inclination around the mirror cone, and one over the azimuth around
/// where the light leaves, both logistic and cut off; and a share that goes anywhere.
template <class T>
struct Fur {
  T spread = T(0.12), turn_spread = T(0.5), exit = T(0.9), anywhere = T(0.25);
  int fault = 0;

  struct Record {
    V3<T> wi;
    T f, pdf;
  };
  static T cdf(T x, T s) { return 1 / (1 + std::exp(-x / s)); }
  static T logistic(T x, T s) {
    const T e = std::exp(-std::abs(x) / s);
    return e / (s * sqr(1 + e));
  }
  /// In [low, high], by inversion.
  static T cut(T u, T s, T low, T high) {
    const T a = cdf(low, s), k = a + u * (cdf(high, s) - a);
    return std::clamp(-s * std::log(1 / k - 1), low, high);
  }
  static T inclination(const V3<T>& w) { return std::atan2(w.x, std::sqrt(w.y * w.y + w.z * w.z)); }
  static T azimuth(const V3<T>& w) { return std::atan2(w.z, w.y); }

  std::optional<Record> sample(const V3<T>& wo, const P3<T>& u) const {
    T theta = 0, phi = 0;
    if (u.x < anywhere) {
      theta = std::asin(std::clamp(2 * u.y - 1, T(-1), T(1)));
      phi = 2 * pi_v<T> * u.z;
    } else {
      const T centre = -inclination(wo);
      const T s = fault == 3 ? spread * spread : spread;
      theta = centre + cut(u.y, s, -pi_v<T> / 2 - centre, pi_v<T> / 2 - centre);
      phi = exit + cut(u.z, turn_spread, -pi_v<T>, pi_v<T>);
      if (fault != 5) phi += azimuth(wo);
    }
    const T c = std::cos(theta);
    const V3<T> wi{std::sin(theta), c * std::cos(phi), c * std::sin(phi)};
    return Record{wi, eval(wo, wi), pdf(wo, wi)};
  }
  T lobe(const V3<T>& wo, const V3<T>& wi, int which) const {
    const T centre = which == 4 ? inclination(wo) : -inclination(wo);
    const T inside = cdf(pi_v<T> / 2 - centre, spread) - cdf(-pi_v<T> / 2 - centre, spread);
    T along = logistic(inclination(wi) - centre, spread) / inside;
    if (which != 1) along /= std::max(T(1e-6), std::sqrt(wi.y * wi.y + wi.z * wi.z));
    T x = azimuth(wi) - azimuth(wo);
    if (which == 2) x = -x;
    x -= exit;
    x -= 2 * pi_v<T> * std::floor((x + pi_v<T>) / (2 * pi_v<T>));
    const T about = cdf(pi_v<T>, turn_spread) - cdf(-pi_v<T>, turn_spread);
    return along * logistic(x, turn_spread) / about;
  }
  T mixed(const V3<T>& wo, const V3<T>& wi, int which) const {
    const T p = which == 6 ? T(0) : anywhere;
    return p / (4 * pi_v<T>)+(1 - p) * lobe(wo, wi, which);
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const { return mixed(wo, wi, fault); }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return std::abs(wi.z) > 0 ? T(0.7) * mixed(wo, wi, 0) / std::abs(wi.z) : T(0);
  }
};

template <class T>
Fur<T> fur(int fault) {
  Fur<T> f;
  f.fault = on(fault);
  return f;
}

BsdfOptions fur_options(double angle) {
  BsdfOptions options = from_both_faces({angle});
  options.reciprocal = false;
  options.conventions.weight = verify::BsdfConventions::Weight::f;
  return options;
}

}  // namespace

void add_sealed_hair_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fresh fur/double", "per angle of inclination",
           said("pdf of the lobe is per angle, not divided by the cosine of the inclination"),
           {CauseKind::cosine, CauseKind::sine}, fur<double>(1), fur_options(40));
  twin<D3>(cases, "fresh fur/double", "azimuth negated in pdf",
           said("pdf takes the azimuth from wi to wo for that from wo to wi"),
           {CauseKind::mirrored}, fur<double>(2), fur_options(30));
  twin<F3>(cases, "fresh fur/float", "width squared in sample",
           said("sample takes the variance for the width of the inclination's lobe"),
           {CauseKind::roughness}, fur<float>(3), fur_options(40));
}

}  // namespace plumbline::tests::corpus
