#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_microfacet.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fresh::Facets;
using fresh::on;
using fresh::said;

/// Varnished wood: a rough dielectric over diffuse, which gets what the varnish lets through, in
/// and out.
template <class T>
struct Varnish {
  Facets<T> facets{T(0.2), T(0.2)};
  T albedo = T(0.6);
  int fault = 0;
  T eta = T(1.5);

  T share(T cosine) const {
    const T f = fresnel_dielectric(cosine, eta);
    return f / (f + (1 - f) * albedo);
  }
  T coat_pdf(const V3<T>& wo, const V3<T>& m) const {
    return facets.g1(wo) * facets.ndf(m) / (4 * wo.z);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = u.x < share(wo.z) ? mirrored_at(wo, facets.visible_normal(wo, u.y, u.z))
                                       : cosine_hemisphere(u.y, u.z);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi), weight = eval(wo, wi) * wi.z / q;
    if (fault == 3) return Sampled<T>{wi, weight, coat_pdf(wo, unit(wo + wi)) + wi.z / pi_v<T>};
    return Sampled<T>{wi, weight, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    const T p = share(fault == 1 ? dot(wo, m) : wo.z);
    return p * coat_pdf(wo, m) + (1 - p) * wi.z / pi_v<T>;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    const T coat =
        fresnel_dielectric(dot(wo, m), eta) * facets.ndf(m) * facets.g2(wo, wi) / (4 * wo.z * wi.z);
    const T in = 1 - fresnel_dielectric(wo.z, eta);
    const T out = fault == 4 ? in : 1 - fresnel_dielectric(wi.z, eta);
    return coat + albedo / pi_v<T> * (fault == 2 ? T(1) : in * out);
  }
};

template <class T>
Varnish<T> varnish(T alpha, T albedo, int fault) {
  return {{alpha, alpha}, albedo, on(fault)};
}

/// Velvet over cloth: the fuzz takes its share from what lies below.
template <class T>
struct Velvet {
  T albedo = 1, fuzz = T(0.6);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = cosine_hemisphere(u, v);
    if (!(wi.z > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * pi_v<T>, pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return wo.z > 0 && wi.z > 0 ? wi.z / pi_v<T> : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T edge = schlick(T(0), dot(wo, unit(wo + wi)));
    const T below = fault == 1 ? T(1) : 1 - fuzz;
    return (albedo * below + fuzz * edge) / pi_v<T>;
  }
};

/// Lacquer: a mirror by Fresnel's share of the samples over a matt coat of pigment.
template <class T>
struct Lacquer {
  T albedo = T(0.5);
  int fault = 0;

  struct Record {
    V3<T> wi;
    T weight, pdf;
    bool is_delta;
  };
  T mirror_share(const V3<T>& wo) const {
    return T(0.25) + T(0.5) * fresnel_dielectric(wo.z, T(1.4));
  }
  Record sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return {wo, 0, 0, false};
    const T p = mirror_share(wo);
    if (u.x < p) {
      return {{-wo.x, -wo.y, wo.z}, fresnel_dielectric(wo.z, T(1.4)) / p, p, true};
    }
    const V3<T> wi = cosine_hemisphere(fault == 2 ? u.x : below_one((u.x - p) / (1 - p)), u.y);
    const T q = pdf(wo, wi);
    return {wi, eval(wo, wi) * wi.z / q, q, false};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return (fault == 1 ? T(1) : 1 - mirror_share(wo)) * wi.z / pi_v<T>;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T in = 1 - fresnel_dielectric(wo.z, T(1.4));
    return in * (1 - fresnel_dielectric(wi.z, T(1.4))) * albedo / pi_v<T>;
  }
};

BsdfOptions lacquer_options() {
  BsdfOptions options = seen_from({10, 65});
  options.conventions.zero_pdf_is_failure = true;
  return options;
}

}  // namespace

void add_sealed_layers_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fresh varnish/alpha 0.4/double", "F at h in pdf",
           said("sample chooses by the Fresnel term at the cosine of wo, pdf has that of wo and h"),
           {CauseKind::fresnel, CauseKind::lobe_probability}, varnish(0.4, 0.6, 1),
           seen_from({60, 80}));
  twin<D3>(cases, "fresh varnish/alpha 0.15/double", "wood not dimmed",
           said("the diffuse part lacks the 1 - F of the varnish, in and out"),
           {CauseKind::fresnel, CauseKind::energy}, varnish(0.15, 0.97, 2), seen_from({10, 60}));
  twin<F3>(cases, "fresh varnish/alpha 0.3/float", "record of lobes without their shares",
           said("the record adds the lobes' densities without their probabilities, pdf() has them"),
           {CauseKind::record_pdf, CauseKind::lobe_probability}, varnish(0.3F, 0.5F, 3),
           seen_from({0, 60}));
  twin<D3>(cases, "fresh velvet/double", "fuzz added on top",
           said("the fuzz is added to the whole of the cloth"), {CauseKind::energy},
           Velvet<double>{1, 0.6, on(1)}, seen_from({20, 75}));
  twin<D3>(cases, "fresh lacquer/double", "pigment without its share",
           said("pdf of the pigment lacks the probability that the mirror is not chosen"),
           {CauseKind::lobe_probability}, Lacquer<double>{0.5, on(1)}, lacquer_options());
}

}  // namespace plumbline::tests::corpus
