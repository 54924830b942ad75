#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_microfacet.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fresh::Facets;
using fresh::on;
using fresh::reflectance;
using fresh::said;

/// Ground glass, η on the far side of wo over that on its own, with the weight written out.
///
/// @source Walter et al. 2007, Eq. 16, 17; the order of terms as in pbrt-v4, DielectricBxDF
template <class T>
struct GroundGlass {
  Facets<T> facets{T(0.3), T(0.3)};
  T eta = T(1.5);
  int fault = 0;

  struct Seen {
    V3<T> wo, wi, m;
    T relative, f;
  };
  /// Both directions with wo on top, and the microfacet between them.
  std::optional<Seen> seen(V3<T> wo, V3<T> wi) const {
    if (wo.z == 0 || wi.z == 0) return std::nullopt;
    const T relative = wo.z > 0 ? eta : 1 / eta;
    if (wo.z < 0) wo.z = -wo.z, wi.z = -wi.z;
    const T scale = wi.z > 0 ? T(1) : relative;
    const V3<T> sum = scale * wi + wo;
    if (dot(sum, sum) == 0) return std::nullopt;
    V3<T> m = unit(sum);
    if (m.z < 0) m = -m;
    if (!(dot(wo, m) > 0) || !(dot(wi, m) * wi.z > 0)) return std::nullopt;
    return Seen{wo, wi, m, relative, fresnel_dielectric(dot(wo, m), relative)};
  }
  T refraction_jacobian(const Seen& s) const {
    const T o = dot(s.wo, s.m), i = dot(s.wi, s.m);
    if (fault == 1) return std::abs(i) / sqr(o + s.relative * i);
    if (fault == 2) return std::abs(i) / sqr(i + o * s.relative);
    if (fault == 3) return std::abs(o) / sqr(i + o / s.relative);
    return std::abs(i) / sqr(i + o / s.relative);
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    const auto s = seen(wo, wi);
    if (!s) return 0;
    const T d = facets.visible_pdf(s->wo, s->m);
    if (s->wi.z > 0) return s->f * d / (4 * dot(s->wo, s->m));
    return (1 - s->f) * d * refraction_jacobian(*s);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    const auto s = seen(wo, wi);
    if (!s) return 0;
    const T dg = facets.ndf(s->m) * facets.g2(s->wo, s->wi);
    if (s->wi.z > 0) return s->f * dg / (4 * s->wo.z * s->wi.z);
    const T o = dot(s->wo, s->m), i = dot(s->wi, s->m);
    T through = fault == 4 ? s->f : 1 - s->f;
    if (fault != 5) through /= s->relative * s->relative;
    return through * dg * std::abs(i * o / (s->wo.z * s->wi.z)) / sqr(i + o / s->relative);
  }
  std::optional<Sampled<T>> sample(const V3<T>& given, const P3<T>& u) const {
    if (given.z == 0) return std::nullopt;
    const T e = given.z > 0 ? eta : 1 / eta;
    const V3<T> wo{given.x, given.y, std::abs(given.z)};
    const V3<T> m = facets.visible_normal(wo, u.y, fault == 6 ? u.x : u.z);
    const T c = dot(wo, m), f = fresnel_dielectric(c, e);
    const bool reflected = u.x < f;
    V3<T> wi = mirrored_at(wo, m);
    if (!reflected) wi = (c / e - safe_sqrt(1 - (1 - c * c) / (e * e))) * m - (1 / e) * wo;
    if (wi.z == 0 || (wi.z > 0) != reflected) return std::nullopt;
    const T masked = facets.g2(wo, wi) / facets.g1(wo);
    if (given.z < 0) wi.z = -wi.z;
    const T q = pdf(given, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, reflected ? masked : masked / (e * e), q};
  }
};

template <class T>
GroundGlass<T> ground(T alpha, int fault) {
  return {{alpha, alpha}, T(1.5), on(fault)};
}

/// A lens: nothing but the mirror and the refracted direction.
template <class T>
struct Lens {
  T eta = T(1.6);
  int fault = 0;

  struct Record {
    V3<T> wi;
    T weight, pdf;
    bool is_delta;
  };
  Record sample(const V3<T>& wo, const P2<T>& u) const {
    const T e = wo.z > 0 ? eta : 1 / eta;
    const T f = reflectance(wo.z, eta);
    const T stated = fault == 2 ? fresnel_dielectric(std::abs(wo.z), eta) : f;
    if (u.x < f) return {{-wo.x, -wo.y, wo.z}, 1, stated, true};
    const T cosine = safe_sqrt(1 - (1 - wo.z * wo.z) / (e * e));
    const V3<T> wi{-wo.x / e, -wo.y / e, -std::copysign(cosine, wo.z)};
    return {wi, 1 / sqr(fault == 1 ? eta : e), 1 - stated, true};
  }
  T pdf(const V3<T>&, const V3<T>&) const { return 0; }
  T eval(const V3<T>&, const V3<T>&) const { return 0; }
};

/// Gauze: a share of the light goes straight through between the threads, the threads are diffuse.
template <class T>
struct Gauze {
  T open = T(0.4), albedo = T(0.6);
  int fault = 0;

  struct Record {
    V3<T> wi;
    T weight, pdf;
    bool is_delta;
  };
  Record sample(const V3<T>& wo, const P2<T>& u) const {
    if (u.x < open) return {-wo, 1, fault == 2 ? 1 - open : open, fault != 1};
    V3<T> wi = cosine_hemisphere(below_one((u.x - open) / (1 - open)), u.y);
    if (wo.z < 0) wi.z = -wi.z;
    return {wi, albedo, pdf(wo, wi), false};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return wo.z * wi.z > 0 ? (1 - open) * std::abs(wi.z) / pi_v<T> : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return wo.z * wi.z > 0 ? (1 - open) * albedo / pi_v<T> : T(0);
  }
};

BsdfOptions glass_options(std::vector<double> angles, double eta = 1.5) {
  return from_both_faces(std::move(angles), eta);
}

BsdfOptions gauze_options() {
  BsdfOptions options = from_both_faces({20, 60});
  options.conventions.zero_pdf_is_failure = true;
  return options;
}

}  // namespace

void add_sealed_glass_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fresh ground glass/alpha 0.4/double", "Jacobian without eta squared",
           said("the pdf's Jacobian of refraction is |wi.h|/(wo.h + eta wi.h)^2, eta^2 is missing"),
           {CauseKind::refraction_jacobian, CauseKind::eta_squared}, ground(0.4, 1),
           glass_options({20, 60}));
  twin<D3>(cases, "fresh ground glass/alpha 0.25/double", "eta upside down in Jacobian",
           said("the pdf's Jacobian of refraction has eta where 1/eta belongs"),
           {CauseKind::refraction_jacobian}, ground(0.25, 2), glass_options({10, 50}));
  twin<D3>(cases, "fresh ground glass/alpha 0.3/double", "wo.h in Jacobian",
           said("B5: the pdf's Jacobian of refraction has |wo.h| where |wi.h| belongs"),
           {CauseKind::refraction_jacobian}, ground(0.3, 3), glass_options({30, 70}));
  twin<F3>(cases, "fresh ground glass/alpha 0.35/float", "F for 1 - F in f",
           said("f has F for refraction too, the weight does not"), {CauseKind::fresnel},
           ground(0.35F, 4), glass_options({20, 60}));
  twin<D3>(cases, "fresh ground glass/alpha 0.5/double", "f not divided by eta squared",
           said("f lacks 1/eta^2 of radiance, the weight has it"), {CauseKind::eta_squared},
           ground(0.5, 5), glass_options({0, 40}));
  twin<F3>(cases, "fresh lens/float", "1/eta squared from inside",
           said("the weight of refraction is 1/eta^2 from inside too, where eta^2 belongs"),
           {CauseKind::eta_squared}, Lens<float>{1.6F, on(1)}, glass_options({10, 35}, 1.6));
  twin<D3>(cases, "fresh gauze/double", "straight through not an atom",
           said("what goes straight through does not say that it is an atom"),
           {CauseKind::atom_as_density, CauseKind::on_a_line}, Gauze<double>{0.4, 0.6, on(1)},
           gauze_options());
}

}  // namespace plumbline::tests::corpus
