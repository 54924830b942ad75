#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_microfacet.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fourth::on;
using fourth::over;
using fourth::said;
using fourth::TrowbridgeReitz;

/// Frosted glass, with the microfacets' normals upwards whichever side wo is on.
///
/// @source Walter et al. 2007, Eq. 16, 17, 20, 21
template <class T>
struct Frosted {
  T alpha = T(0.3), eta = T(1.5);
  int fault = 0;

  TrowbridgeReitz<T> facets() const { return {alpha, alpha}; }
  T far_over_near(const V3<T>& wo) const { return wo.z > 0 ? eta : 1 / eta; }

  std::optional<V3<T>> normal_between(const V3<T>& wo, const V3<T>& wi) const {
    const bool reflects = wo.z * wi.z > 0;
    const V3<T> sum = wo + (reflects ? T(1) : far_over_near(wo)) * wi;
    if (dot(sum, sum) == 0) return std::nullopt;
    V3<T> m = unit(sum);
    if (m.z < 0 && (reflects || fault != 1)) m = -m;
    if (!(dot(wo, m) * wo.z > 0) || !(dot(wi, m) * wi.z > 0)) return std::nullopt;
    return m;
  }
  T visible(const V3<T>& wo, const V3<T>& wi, const V3<T>& m) const {
    const T g1 = fault == 9 ? T(1) : facets().g1(fault == 8 ? wi : wo);
    return g1 * std::abs(dot(wo, m)) * facets().d(m) / std::abs(wo.z);
  }
  /// Solid angle of m over that of wi.
  T refraction_jacobian(const V3<T>& wo, const V3<T>& wi, const V3<T>& m) const {
    const T o = dot(wo, m), i = dot(wi, m), sum = i + o / far_over_near(wo);
    if (fault == 2) return 1 / (4 * std::abs(o));
    return std::abs(i) / (fault == 3 ? std::abs(sum) : sum * sum);
  }
  T density(const V3<T>& wo, const V3<T>& wi, const V3<T>& m) const {
    const T c = std::abs(dot(wo, m)), f = fresnel_dielectric(c, far_over_near(wo));
    if (wo.z * wi.z > 0) return f * visible(wo, wi, m) / (4 * c);
    return (1 - f) * visible(wo, wi, m) * refraction_jacobian(wo, wi, m);
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z == 0 || wi.z == 0) return 0;
    const auto m = normal_between(wo, wi);
    return m ? density(wo, wi, *m) : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z == 0 || wi.z == 0) return 0;
    const auto m = normal_between(wo, wi);
    if (!m) return 0;
    const T e = far_over_near(wo), o = dot(wo, *m), i = dot(wi, *m);
    const T f = fresnel_dielectric(std::abs(o), e);
    const T dg = facets().d(*m) * facets().g2(wo, wi) / std::abs(wo.z * wi.z);
    if (wo.z * wi.z > 0) return f * dg / 4;
    const T radiance = fault == 7 ? 1 / (eta * eta) : 1 / (e * e);
    return (1 - f) * dg * std::abs(o * i) / sqr(i + o / e) * radiance;
  }
  /// Probability that sample reflects.
  T reflected_share(T c, T e) const {
    const T f = fresnel_dielectric(c, e);
    if (fault == 5) return std::max(f, T(0.2));
    return fault == 4 && f < 1 ? schlick(sqr((e - 1) / (e + 1)), c) : f;
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (wo.z == 0) return std::nullopt;
    const V3<T> above = wo.z > 0 ? wo : -wo;
    const V3<T> up = facets().visible(above, u.y, u.z), m = wo.z > 0 ? up : -up;
    const T e = far_over_near(wo), c = dot(wo, m);
    if (!(c > 0)) return std::nullopt;
    const bool reflects = u.x < reflected_share(c, e);
    const T cos_t = safe_sqrt(1 - (1 - c * c) / (e * e));
    const V3<T> wi = reflects ? mirrored_at(wo, m) : (c / e - cos_t) * m - (1 / e) * wo;
    if (!reflects && !(cos_t > 0)) return std::nullopt;
    if (wi.z == 0 || (wi.z * wo.z > 0) != reflects) return std::nullopt;
    const T q = density(wo, wi, up);
    if (!(q > 0)) return std::nullopt;
    T weight = facets().g2(wo, wi) / facets().g1(wo);
    if (!reflects && fault != 6) weight /= e * e;
    if (fault == 2 || fault == 3 || fault == 4 || fault == 5 || fault >= 8) {
      weight = eval(wo, wi) * std::abs(wi.z) / q;
    }
    return Sampled<T>{wi, weight, q};
  }
};

template <class T>
Frosted<T> frosted(T alpha, int fault) {
  return {alpha, T(1.5), on(fault)};
}

/// A sheet of frosted glass too thin to bend light; what goes to and fro inside is added up.
template <class T>
struct ThinSheet {
  T alpha = T(0.3), eta = T(1.5);
  int fault = 0;

  TrowbridgeReitz<T> facets() const { return {alpha, alpha}; }
  T reflects(T c) const {
    const T f = fresnel_dielectric(c, eta);
    return 2 * f / (1 + f);
  }
  T share(T c, bool of_pdf) const {
    return of_pdf && fault == 2 ? fresnel_dielectric(c, eta) : reflects(c);
  }
  std::optional<Sampled<T>> sample(const V3<T>& given, const P3<T>& u) const {
    if (given.z == 0) return std::nullopt;
    const V3<T> wo = given.z > 0 ? given : over(given);
    const V3<T> m = facets().visible(wo, u.x, u.y);
    V3<T> wi = mirrored_at(wo, m);
    if (!(dot(wo, m) > 0) || !(wi.z > 0)) return std::nullopt;
    const bool back = u.z < share(dot(wo, m), false);
    if (!back && fault != 1) wi = over(wi);
    if (given.z < 0) wi = over(wi);
    const T q = pdf(given, wi);
    return Sampled<T>{wi, eval(given, wi) * std::abs(wi.z) / q, q};
  }
  T pdf(const V3<T>& given, const V3<T>& sampled) const {
    if (given.z == 0 || sampled.z == 0) return 0;
    const V3<T> wo{given.x, given.y, std::abs(given.z)};
    const V3<T> m = unit(wo + V3<T>{sampled.x, sampled.y, std::abs(sampled.z)});
    const T p = share(dot(wo, m), true);
    const T q = facets().visible_density(wo, m) / (4 * dot(wo, m));
    if (fault == 3) return q;
    return (given.z * sampled.z > 0 ? p : 1 - p) * q;
  }
  T eval(const V3<T>& given, const V3<T>& sampled) const {
    if (given.z == 0 || sampled.z == 0) return 0;
    const V3<T> wo{given.x, given.y, std::abs(given.z)};
    const V3<T> wi{sampled.x, sampled.y, std::abs(sampled.z)}, m = unit(wo + wi);
    const T r = reflects(dot(wo, m));
    const T f = facets().d(m) * facets().g2(wo, wi) / (4 * wo.z * wi.z);
    return (given.z * sampled.z > 0 ? r : 1 - r) * f;
  }
};

template <class T>
ThinSheet<T> thin_sheet(T alpha, int fault) {
  return {alpha, T(1.5), on(fault)};
}

/// A soap bubble: reflects or lets straight through.
template <class T>
struct Bubble {
  int fault = 0;

  struct Record {
    V3<T> wi;
    T weight, pdf;
    bool is_delta;
  };
  Record sample(const V3<T>& wo, const P2<T>& u) const {
    const T f = fresnel_dielectric(std::abs(wo.z), T(1.33)), r = 2 * f / (1 + f);
    if (u.x < r) return {{-wo.x, -wo.y, wo.z}, fault == 1 ? r : T(1), r, true};
    return {-wo, fault == 1 ? 1 - r : T(1), 1 - r, true};
  }
  T pdf(const V3<T>&, const V3<T>&) const { return 0; }
  T eval(const V3<T>&, const V3<T>&) const { return 0; }
};

BsdfOptions bubble_options() {
  BsdfOptions options = from_both_faces({30, 70});
  options.albedo = [](const verify::Vec3&) { return 1.0; };
  return options;
}

}  // namespace

void add_sealed_glass_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fourth frosted glass/alpha 0.3/double", "normal not turned up",
           said("pdf and f do not turn the normal of refraction to the upper side"),
           {CauseKind::support, CauseKind::record_pdf}, frosted(0.3, 1),
           from_both_faces({20, 60}, 1.5));
  twin<D3>(cases, "fourth frosted glass/alpha 0.35/double", "Jacobian of reflection",
           said("pdf has 1/(4 wo.h) for refraction too"), {CauseKind::refraction_jacobian},
           frosted(0.35, 2), from_both_faces({10, 55}, 1.5));
  twin<D3>(cases, "fourth frosted glass/alpha 0.25/double", "denominator not squared",
           said("B5: the denominator of the Jacobian of refraction is not squared"),
           {CauseKind::refraction_jacobian}, frosted(0.25, 3), from_both_faces({25, 65}, 1.5));
  twin<D3>(cases, "fourth frosted glass/alpha 0.4/double", "chosen by Schlick's F",
           said("sample chooses by Schlick's approximation, pdf has the exact Fresnel term"),
           {CauseKind::fresnel, CauseKind::lobe_probability}, frosted(0.4, 4),
           from_both_faces({30, 70}, 1.5));
  twin<F3>(cases, "fourth frosted glass/alpha 0.3/float", "reflects a fifth at least",
           said("sample reflects with probability 0.2 at least, pdf has F as it is"),
           {CauseKind::fresnel, CauseKind::lobe_probability}, frosted(0.3F, 5),
           from_both_faces({20, 50}, 1.5));
  twin<F3>(cases, "fourth frosted glass/alpha 0.4/float", "weight without 1/eta squared",
           said("the weight of refraction lacks 1/eta^2 of radiance, f has it"),
           {CauseKind::eta_squared, CauseKind::weight}, frosted(0.4F, 6),
           from_both_faces({10, 60}, 1.5));
  twin<D3>(cases, "fourth frosted glass/alpha 0.5/double", "f of one side of eta squared",
           said("f is divided by eta^2 from inside too, where it is to be multiplied"),
           {CauseKind::eta_squared}, frosted(0.5, 7), from_both_faces({20, 40}, 1.5));
  twin<D3>(cases, "fourth frosted glass/alpha 0.45/double", "G1 of wi",
           said("pdf's visible normals are masked for wi, not for wo"),
           {CauseKind::masking, CauseKind::directions_swapped}, frosted(0.45, 8),
           from_both_faces({40, 70}, 1.5));
  twin<D3>(cases, "fourth frosted glass/alpha 0.6/double", "visible normals without G1",
           said("B2: pdf of the visible normals lacks G1"), {CauseKind::masking}, frosted(0.6, 9),
           from_both_faces({20, 65}, 1.5));
  twin<D3>(cases, "fourth thin sheet/alpha 0.3/double", "not turned to the other side",
           said("what goes through comes back on the side it came from"),
           {CauseKind::mirrored, CauseKind::support}, thin_sheet(0.3, 1),
           from_both_faces({20, 60}));
  twin<D3>(cases, "fourth thin sheet/alpha 0.4/double", "F of one surface in pdf",
           said("pdf has the Fresnel term of one surface, sample and f that of both"),
           {CauseKind::fresnel, CauseKind::lobe_probability}, thin_sheet(0.4, 2),
           from_both_faces({15, 65}));
  twin<F3>(cases, "fourth thin sheet/alpha 0.35/float", "choice not in pdf",
           said("B31: sample chooses the side by F, pdf has neither probability"),
           {CauseKind::fresnel, CauseKind::lobe_probability}, thin_sheet(0.35F, 3),
           from_both_faces({20, 60}));
  twin<D3>(cases, "fourth bubble/albedo known/double", "F once more in the weight",
           said("the weight has F and 1 - F, though sample has chosen by them"),
           {CauseKind::fresnel, CauseKind::weight}, Bubble<double>{on(1)}, bubble_options());
}

}  // namespace plumbline::tests::corpus
