#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_facets.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {
namespace fifth {
namespace {

/// Chrome by the normals that are seen.
template <class T>
struct Chrome {
  T ax, ay;
  int fault = 0;
  T f0 = T(0.55);

  Ggx<T> facets() const { return {ax, ay}; }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> h = facets().seen_normal(wo, u.x, u.y);
    const V3<T> wi = mirrored_at(wo, h);
    if (!(wi.z > 0)) return std::nullopt;
    const T f = schlick(f0, fault == 4 ? wo.z : dot(wo, h));
    const T weight = f * facets().shadows(wo, wi) / facets().shadow(fault == 3 ? wi : wo);
    return Sampled<T>{wi, weight, pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    if (fault == 1) return facets().ndf(h) * h.z / (4 * dot(wo, h));
    if (fault == 2) return Ggx<T>{ay, ax}.seen(wo, h) / (4 * dot(wo, h));
    // wo.h of the normals that are seen and of the reflection cancel.
    const T d = facets().ndf(h);
    if (fault == 5) return facets().shadow(wo) * d / (4 * wi.z);
    if (fault == 6) return facets().shadow(wo) * d / wo.z;
    if (fault == 7) return Ggx<T>{ax * ax, ay * ay}.shadow(wo) * d / (4 * wo.z);
    if (fault == 8) return facets().shadow(wi) * d / (4 * wi.z);
    return facets().shadow(wo) * d / (4 * wo.z);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    const T top = schlick(f0, dot(wo, h)) * facets().ndf(h) * facets().shadows(wo, wi);
    return fault == 9 ? top / (4 * wo.z) : top / (4 * wo.z * wi.z);
  }
};

template <class T>
Chrome<T> chrome(T ax, T ay, int fault) {
  return {ax, ay, put(fault)};
}

/// Brass with Beckmann's distribution, of all normals, shadowed by Smith's rational fit.
///
/// @source Walter et al. 2007, Eq. 25, 28
template <class T>
struct Brass {
  T alpha;
  int fault = 0;
  T f0 = T(0.75);

  T ndf(const V3<T>& h) const {
    const T c2 = h.z * h.z;
    return std::exp(-(1 - c2) / (c2 * alpha * alpha)) / (pi_v<T> * alpha * alpha * c2 * c2);
  }
  T shadow(const V3<T>& w) const {
    const T sine = safe_sqrt(1 - w.z * w.z);
    if (!(sine > 0)) return 1;
    const T a = w.z / (alpha * sine);
    if (!(a < T(1.6))) return 1;
    return (T(3.535) * a + T(2.181) * a * a) / (1 + T(2.276) * a + T(2.577) * a * a);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T tan2 = -(fault == 1 ? alpha : alpha * alpha) * std::log1p(-u);
    const V3<T> h = spherical(1 / std::sqrt(1 + tan2), 2 * pi_v<T> * v);
    if (!(dot(wo, h) > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, h);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    const T c = dot(wo, h);
    return fault == 2 ? ndf(h) / (4 * c) : ndf(h) * h.z / (4 * c);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    return schlick(f0, dot(wo, h)) * ndf(h) * shadow(wo) * shadow(wi) / (4 * wo.z * wi.z);
  }
};

/// The clear coat of a studio's BRDF, with the long tail of the power 1.
///
/// @source Burley 2012, App. B.2, Eq. 4 and the sampling formula after Eq. 5
template <class T>
struct Lacquer {
  T alpha;
  int fault = 0;

  T width() const { return fault == 2 ? std::max(alpha, T(0.1)) : alpha; }
  T ndf(const V3<T>& h) const {
    const T a2 = alpha * alpha;
    return (a2 - 1) / (pi_v<T> * std::log(a2) * (1 + (a2 - 1) * h.z * h.z));
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T a2 = width() * width();
    const T c = safe_sqrt((1 - std::pow(a2, 1 - u.x)) / (1 - a2));
    const V3<T> h = spherical(c, 2 * pi_v<T> * u.y);
    if (!(dot(wo, h) > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, h);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    return fault == 1 ? ndf(h) / (4 * dot(wo, h)) : ndf(h) * h.z / (4 * dot(wo, h));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    const Ggx<T> quarter{T(0.25), T(0.25)};
    const T shadowed = quarter.shadow(wo) * quarter.shadow(wi);
    return schlick(T(0.04), dot(wo, h)) * ndf(h) * shadowed / (4 * wo.z * wi.z);
  }
};

}  // namespace
}  // namespace fifth

void add_sealed_ggx_cases(std::vector<Case>& cases) {
  using namespace fifth;
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fifth chrome/alpha 0.45/double", "pdf of all normals",
           because("pdf is that of all normals, sample draws those that are seen"),
           {CauseKind::masking}, chrome(0.45, 0.45, 1), seen_from({35, 70}));
  twin<F3>(cases, "fifth chrome/alpha 0.15 and 0.4/float", "alphas exchanged in pdf",
           because("pdf has alpha x for alpha y"),
           {CauseKind::mirrored, CauseKind::tangent_frame, CauseKind::roughness},
           chrome(0.15F, 0.4F, 2), seen_from({15, 50}));
  twin<D3>(cases, "fifth chrome/alpha 0.4/double", "G1 of wi in the weight",
           because("the weight divides G2 by G1 of wi, pdf has G1 of wo"),
           {CauseKind::masking, CauseKind::weight}, chrome(0.4, 0.4, 3), seen_from({30, 75}));
  twin<F3>(cases, "fifth chrome/alpha 0.3/float", "F at the surface's normal in the weight",
           because("the weight has F at wo.n, f at wo.h"), {CauseKind::fresnel, CauseKind::weight},
           chrome(0.3F, 0.3F, 4), seen_from({55, 78}));
  twin<D3>(cases, "fifth chrome/alpha 0.25/double", "cosine of wi below",
           because("pdf divides by 4 cos wi, not by 4 cos wo"), {CauseKind::cosine},
           chrome(0.25, 0.25, 5), seen_from({30, 65}));
  twin<D3>(cases, "fifth chrome/alpha 0.35/double", "4 forgotten",
           because("pdf lacks the 4 of the half vector's Jacobian"),
           {CauseKind::constant, CauseKind::half_vector_jacobian}, chrome(0.35, 0.35, 6),
           seen_from({10, 60}));
  twin<D3>(cases, "fifth chrome/alpha 0.6/double", "alpha squared twice in G1",
           because("G1 in pdf has the square of alpha"), {CauseKind::masking, CauseKind::roughness},
           chrome(0.6, 0.6, 7), seen_from({45, 75}));
  twin<D3>(cases, "fifth chrome/alpha 0.5/double", "wi for wo in pdf",
           because("B13: pdf takes wi for the given direction"), {CauseKind::directions_swapped},
           chrome(0.5, 0.5, 8), seen_from({25, 70}));
  twin<F3>(cases, "fifth chrome/alpha 0.2/float", "cosine left in f",
           because("B28: f is divided by 4 cos wo alone"), {CauseKind::value_cosine},
           chrome(0.2F, 0.2F, 9), seen_from({20, 60}));
  twin<D3>(cases, "fifth brass/alpha 0.3/double", "alpha for its square in sample",
           because("sample draws slopes of alpha, pdf has its square"), {CauseKind::roughness},
           Brass<double>{0.3, put(1)}, seen_from({10, 50}));
  twin<F3>(cases, "fifth brass/alpha 0.4/float", "normal's cosine forgotten",
           because("pdf lacks the cosine between facet and surface"), {CauseKind::cosine},
           Brass<float>{0.4F, put(2)}, seen_from({0, 55}));
  twin<D3>(cases, "fifth lacquer/alpha 0.25/double", "normal's cosine forgotten",
           because("pdf lacks the cosine between facet and surface"), {CauseKind::cosine},
           Lacquer<double>{0.25, put(1)}, seen_from({20, 60}));
  twin<D3>(cases, "fifth lacquer/alpha 0.04/double", "alpha clamped in sample",
           because("B29: sample clamps alpha at 0.1, pdf and f do not"), {CauseKind::roughness},
           Lacquer<double>{0.04, put(2)}, seen_from({15, 50}));
}

}  // namespace plumbline::tests::corpus
