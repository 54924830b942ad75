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
using fourth::turned_about_z;

/// Rolled steel: roughness and aspect as artists state them, along a direction of rolling, with a
/// gain for light that goes from facet to facet.
template <class T>
struct Steel {
  T alpha = T(0.3), aspect = 1, rolled = 0;
  int fault = 0;
  T f0 = T(0.7);

  TrowbridgeReitz<T> facets() const {
    return {alpha / std::sqrt(aspect), alpha * std::sqrt(aspect)};
  }
  TrowbridgeReitz<T> facets_of_pdf() const {
    if (fault == 2) return {std::sqrt(alpha), std::sqrt(alpha)};
    if (fault == 3) return {alpha / aspect, alpha * aspect};
    return facets();
  }
  T gain(const V3<T>& w) const { return 1 + T(0.2) * alpha * (1 - w.z); }

  std::optional<Sampled<T>> sample(const V3<T>& given, const P2<T>& u) const {
    if (!(given.z > 0)) return std::nullopt;
    const TrowbridgeReitz<T> s = facets();
    const V3<T> wo = turned_about_z(given, -rolled);
    const V3<T> m = fault == 1 ? s.any(u.x, u.y) : s.visible(wo, u.x, u.y);
    if (!(dot(wo, m) > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, m);
    if (!(wi.z > 0)) return std::nullopt;
    const T g2 = fault == 6 ? s.g1(wo) * s.g1(wi) : s.g2(wo, wi);
    T weight = schlick(f0, dot(wo, m)) * g2 / s.g1(wo) * gain(wi);
    if (fault != 7) weight *= gain(wo);
    const V3<T> to = turned_about_z(wi, rolled);
    const T q = pdf(given, to);
    if (fault == 1) weight = eval(given, to) * to.z / q;
    return Sampled<T>{to, weight, q};
  }
  T pdf(const V3<T>& given, const V3<T>& sampled) const {
    if (!(given.z > 0) || !(sampled.z > 0)) return 0;
    const T angle = fault == 4 ? T(0) : -rolled;
    const V3<T> wo = turned_about_z(given, angle), wi = turned_about_z(sampled, angle);
    const V3<T> m = unit(wo + wi);
    const T q = facets_of_pdf().visible_density(wo, m);
    return fault == 5 ? q * 4 * dot(wo, m) : q / (4 * dot(wo, m));
  }
  T eval(const V3<T>& given, const V3<T>& sampled) const {
    if (!(given.z > 0) || !(sampled.z > 0)) return 0;
    const V3<T> wo = turned_about_z(given, -rolled), wi = turned_about_z(sampled, -rolled);
    const V3<T> m = unit(wo + wi);
    const T f = schlick(f0, dot(wo, m)) * facets().d(m) * facets().g2(wo, wi);
    return f * gain(wo) * gain(wi) / (4 * wo.z * wi.z);
  }
};

template <class T>
Steel<T> steel(T alpha, int fault, T aspect = 1, T rolled = 0) {
  return {alpha, aspect, rolled, on(fault)};
}

/// A sheet of it, to be seen from both sides.
template <class T>
struct Sheet {
  Steel<T> steel;
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    auto s = steel.sample(wo.z < 0 ? over(wo) : wo, u);
    if (s && wo.z < 0) s->wi = over(s->wi);
    return s;
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z < 0) return steel.pdf(over(wo), fault == 1 ? wi : over(wi));
    return steel.pdf(wo, wi);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return wo.z < 0 ? steel.eval(over(wo), over(wi)) : steel.eval(wo, wi);
  }
};

/// Reflectance of a conductor for light without polarisation.
template <class T>
T conductor(T cosine, T eta, T k) {
  const T c2 = cosine * cosine, s2 = 1 - c2;
  const T t = eta * eta - k * k - s2, ab = std::sqrt(t * t + 4 * eta * eta * k * k);
  const T a = safe_sqrt((ab + t) / 2);
  const T s = (ab + c2 - 2 * cosine * a) / (ab + c2 + 2 * cosine * a);
  const T p =
      s * (c2 * ab + s2 * s2 - 2 * cosine * a * s2) / (c2 * ab + s2 * s2 + 2 * cosine * a * s2);
  return (s + p) / 2;
}

/// Gold leaf with Beckmann's slopes, by all normals.
///
/// @source Walter et al. 2007, Eq. 25, 27, 28
template <class T>
struct GoldLeaf {
  T alpha = T(0.35);
  int fault = 0;

  T slopes(T tan2) const { return std::exp(-tan2 / sqr(alpha)) / (pi_v<T> * sqr(alpha)); }
  T d(const V3<T>& m) const {
    const T c2 = m.z * m.z;
    return slopes((1 - c2) / c2) / (c2 * c2);
  }
  T lambda(const V3<T>& w, T width) const {
    const T sine = std::hypot(w.x, w.y);
    if (!(sine > 0)) return 0;
    const T a = w.z / (width * sine);
    if (a >= T(1.6)) return 0;
    return std::max(T(0),
                    (1 - T(1.259) * a + T(0.396) * a * a) / (T(3.535) * a + T(2.181) * a * a));
  }
  T masked(const V3<T>& wo, const V3<T>& wi, T width) const {
    return 1 / (1 + lambda(wo, width) + lambda(wi, width));
  }

  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T tan2 = -sqr(alpha) * std::log1p(-u);
    const V3<T> m = spherical(1 / std::sqrt(1 + tan2), 2 * pi_v<T> * v);
    const T c = dot(wo, m);
    if (!(c > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, m);
    if (!(wi.z > 0)) return std::nullopt;
    const T f = fault == 2 ? schlick(T(0.86), c) : conductor(c, T(0.2), T(2.2));
    const T q = pdf(wo, wi);
    if (fault == 1) return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
    return Sampled<T>{wi, f * masked(wo, wi, alpha) * c / (wo.z * m.z), q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    if (fault == 1) return slopes(1 / (m.z * m.z) - 1) * m.z / (4 * dot(wo, m));
    return d(m) * m.z / (4 * dot(wo, m));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    const T g = masked(wo, wi, fault == 3 ? std::sqrt(alpha) : alpha);
    return conductor(dot(wo, m), T(0.2), T(2.2)) * d(m) * g / (4 * wo.z * wi.z);
  }
};

}  // namespace

void add_sealed_ggx_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fourth steel/alpha 0.4/double", "all normals sampled",
           said("sample draws all normals, pdf is that of the visible ones"), {CauseKind::masking},
           steel(0.4, 1), seen_from({30, 70}));
  twin<D3>(cases, "fourth steel/alpha 0.2/double", "root of alpha in pdf",
           said("pdf has alpha where the distribution has its square"), {CauseKind::roughness},
           steel(0.2, 2), seen_from({15, 60}));
  twin<D3>(cases, "fourth steel/alpha 0.25, aspect 0.6/double", "aspect without its root in pdf",
           said("pdf divides and multiplies alpha by the aspect, not by its root"),
           {CauseKind::roughness}, steel(0.25, 3, 0.6), seen_from({20, 55}));
  twin<D3>(cases, "fourth steel/alpha 0.3, aspect 0.3, rolled/double", "not turned in pdf",
           said("pdf does not turn to the direction of rolling"), {CauseKind::tangent_frame},
           steel(0.3, 4, 0.3, 0.6), seen_from({25, 60}));
  twin<F3>(cases, "fourth steel/alpha 0.35/float", "times 4 wo.h",
           said("pdf is multiplied by 4 wo.h where it is to be divided"),
           {CauseKind::half_vector_jacobian}, steel(0.35F, 5), seen_from({20, 65}));
  twin<D3>(cases, "fourth steel/alpha 0.5/double", "separable G in the weight",
           said("the weight has G1(wo) G1(wi), f the masking of heights that go together"),
           {CauseKind::masking, CauseKind::weight}, steel(0.5, 6), seen_from({40, 75}));
  twin<D3>(cases, "fourth steel/alpha 0.6/double", "gain for wi alone in the weight",
           said("the weight has the gain between facets for wi alone"), {CauseKind::weight},
           steel(0.6, 7), seen_from({35, 70}));
  twin<D3>(cases, "fourth sheet of steel/alpha 0.3/double", "wi not turned over in pdf",
           said("B21: on the back pdf turns over wo alone, and is 0"),
           {CauseKind::support, CauseKind::mirrored}, Sheet<double>{steel(0.3, 0), on(1)},
           from_both_faces({20, 60}));
  twin<D3>(cases, "fourth gold leaf/alpha 0.35/double", "per slope",
           said("pdf has the density of slopes, without 1/cos^4 of the normal"),
           {CauseKind::cosine}, GoldLeaf<double>{0.35, on(1)}, seen_from({10, 50}));
  twin<D3>(cases, "fourth gold leaf/alpha 0.3/double", "Schlick's F in the weight",
           said("the weight has Schlick's approximation, f the conductor's Fresnel term"),
           {CauseKind::fresnel, CauseKind::weight}, GoldLeaf<double>{0.3, on(2)},
           seen_from({30, 70}));
  twin<D3>(cases, "fourth gold leaf/alpha 0.25/double", "masking of the root of alpha",
           said("B26: masking in f has the root of alpha, the weight has alpha"),
           {CauseKind::masking, CauseKind::roughness}, GoldLeaf<double>{0.25, on(3)},
           seen_from({45, 70}));
}

}  // namespace plumbline::tests::corpus
