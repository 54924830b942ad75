#include <plumbline/verify/detail/random.h>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_microfacet.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fourth::on;
using fourth::over;
using fourth::said;

/// Lampshade: Lambert's law on both sides, in two colours.
template <class T>
struct Lampshade {
  int fault = 0;
  Rgb<T> front{T(0.7), T(0.1), T(0.1)}, through{T(0.3), T(0.35), T(0.25)};

  static T mean(const Rgb<T>& c) { return (c.r + c.g + c.b) / 3; }
  static T largest(const Rgb<T>& c) { return std::max(c.r, std::max(c.g, c.b)); }
  T share(bool of_pdf) const {
    if (of_pdf && fault == 1) return largest(front) / (largest(front) + largest(through));
    return mean(front) / (mean(front) + mean(through));
  }
  std::optional<SampledRgb<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (wo.z == 0) return std::nullopt;
    V3<T> wi = cosine_hemisphere(u.y, u.z);
    if ((u.x < share(false)) != (wo.z > 0)) wi = over(wi);
    if (wi.z == 0) return std::nullopt;
    const T q = pdf(wo, wi);
    return SampledRgb<T>{wi, (std::abs(wi.z) / q) * eval(wo, wi), q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    const T p = share(true);
    return (wo.z * wi.z > 0 ? p : 1 - p) * std::abs(wi.z) / pi_v<T>;
  }
  Rgb<T> eval(const V3<T>& wo, const V3<T>& wi) const {
    return 1 / pi_v<T> * (wo.z * wi.z > 0 ? front : through);
  }
};

/// Chalk: the normal and a point of the unit sphere around its tip.
struct Chalk {
  double albedo = 0.8;
  int fault = 0;

  std::optional<Sampled<double>> sample(const V3<double>& wo, verify::Random& random) const {
    if (!(wo.z > 0)) return std::nullopt;
    V3<double> p{};
    double r2 = 0;
    do {
      p = {2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1};
      r2 = dot(p, p);
    } while (!(r2 > 1e-12 && r2 <= 1));
    if (fault != 1) p = unit(p);
    const V3<double> towards{p.x, p.y, p.z + 1};
    if (!(towards.z > 1e-12)) return std::nullopt;
    const V3<double> wi = unit(towards);
    return Sampled<double>{wi, albedo, pdf(wo, wi)};
  }
  double pdf(const V3<double>& wo, const V3<double>& wi) const {
    return wo.z > 0 && wi.z > 0 ? wi.z / pi_v<double> : 0;
  }
  double eval(const V3<double>& wo, const V3<double>& wi) const {
    return wo.z > 0 && wi.z > 0 ? albedo / pi_v<double> : 0;
  }
};

/// @source Burley 2012, "Physically Based Shading at Disney", Eq. 4
template <class T>
struct RetroDiffuse {
  T albedo = T(0.6), roughness = T(0.7);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const P2<T> d = concentric_disk(u.x, u.y);
    const V3<T> wi{d.x, d.y, safe_sqrt(1 - d.x * d.x - d.y * d.y)};
    if (!(wi.z > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * pi_v<T>, pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return wo.z > 0 && wi.z > 0 ? wi.z / pi_v<T> : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T c = fault == 1 ? wo.z : dot(wo, unit(wo + wi));
    const T rise = 2 * roughness * c * c - T(0.5);
    return albedo / pi_v<T> * (1 + rise * schlick(T(0), wo.z)) * (1 + rise * schlick(T(0), wi.z));
  }
};

/// Plaster, alike on both sides, and opaque.
template <class T>
struct Plaster {
  T albedo = T(0.4);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (wo.z == 0) return std::nullopt;
    const V3<T> up = cosine_hemisphere(u, v), wi = wo.z > 0 ? up : over(up);
    return Sampled<T>{wi, albedo, pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return wo.z * wi.z > 0 ? std::abs(wi.z) / pi_v<T> : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (fault != 1 && !(wo.z * wi.z > 0)) return 0;
    return albedo / pi_v<T>;
  }
};

/// Cloth whose threads stand up, by directions that are uniform over the hemisphere.
///
/// @source Estevez, Kulla 2017, "Production Friendly Microfacet Sheen BRDF", roughness 1
struct Charlie {
  double albedo = 0.8;
  int fault = 0;

  static double rise(double x) {
    return 21.5473 / (1 + 3.82987 * std::pow(x, 0.19823)) - 1.97760 * x - 4.32054;
  }
  static double lambda(double c) {
    return std::exp(c < 0.5 ? rise(c) : 2 * rise(0.5) - rise(1 - c));
  }
  std::optional<Sampled<double>> sample(const V3<double>& wo, double u, double v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<double> wi = spherical(1 - u, (fault == 2 ? 1 : 2) * pi_v<double> * v);
    if (!(wi.z > 0)) return std::nullopt;
    const double f = eval(wo, wi);
    return Sampled<double>{wi, fault == 1 ? f * pi_v<double> : f * wi.z * 2 * pi_v<double>,
                           pdf(wo, wi)};
  }
  double pdf(const V3<double>& wo, const V3<double>& wi) const {
    return wo.z > 0 && wi.z > 0 ? 1 / (2 * pi_v<double>) : 0;
  }
  double eval(const V3<double>& wo, const V3<double>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<double> h = unit(wo + wi);
    const double d = 3 * safe_sqrt(1 - h.z * h.z) / (2 * pi_v<double>);
    return albedo * d / ((1 + lambda(wo.z) + lambda(wi.z)) * 4 * wo.z * wi.z);
  }
};

}  // namespace

void add_sealed_diffuse_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<F3>(cases, "fourth lampshade/float", "side by the largest channel in pdf",
           said("T1: sample chooses the side by mean colours, pdf by the largest channels"),
           {CauseKind::constant_per_hemisphere, CauseKind::lobe_probability},
           Lampshade<float>{on(1)}, from_both_faces({10, 60}));
  twin<D3>(cases, "fourth chalk/generator/double", "a point of the ball",
           said("the normal and a point of the ball, not of the sphere: cos^3 for cos"),
           {CauseKind::cosine}, Chalk{0.8, on(1)}, seen_from({0, 60}));
  twin<D3>(cases, "fourth retro diffuse/roughness 0.7/double", "f90 at wo",
           said("f's grazing value is taken at the cosine of wo, not at that of wo and h"),
           {CauseKind::asymmetric}, RetroDiffuse<double>{0.6, 0.7, on(1)}, seen_from({15, 65}));
  twin<D3>(cases, "fourth plaster/double", "f on the other side too",
           said("f does not ask whether wi is on the side of wo"), {CauseKind::support},
           Plaster<double>{0.4, on(1)}, from_both_faces({0, 50}));
  twin<D3>(cases, "fourth charlie/double", "weight of cosine sampling",
           said("the weight is pi f, as for directions by the cosine, they are uniform"),
           {CauseKind::weight, CauseKind::value_cosine}, Charlie{0.8, on(1)}, seen_from({20, 60}));
  twin<D3>(cases, "fourth charlie/double", "half a turn",
           said("azimuths are pi v, half of the hemisphere gets no sample"), {CauseKind::support},
           Charlie{0.8, on(2)}, seen_from({20, 60}));
}

}  // namespace plumbline::tests::corpus
