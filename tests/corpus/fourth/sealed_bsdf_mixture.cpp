#include <array>

#include <plumbline/verify/detail/random.h>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_microfacet.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fourth::on;
using fourth::said;
using fourth::TrowbridgeReitz;

template <class T>
T cosine_pdf(const V3<T>& wi) {
  return wi.z / pi_v<T>;
}

/// Glazed tile: a diffuse body and a highlight, the shares by what wo's Fresnel term leaves. The
/// first of two numbers chooses, and is stretched.
template <class T>
struct Tile {
  T alpha = T(0.25);
  int fault = 0;
  T albedo = T(0.5), f0 = T(0.08);

  TrowbridgeReitz<T> facets() const { return {alpha, alpha}; }
  T gloss_share(const V3<T>& wo) const {
    const T f = schlick(f0, fault == 2 ? T(1) : wo.z);
    return f / (f + (1 - f) * albedo);
  }
  T gloss_pdf(const V3<T>& wo, const V3<T>& wi) const {
    const V3<T> m = unit(wo + wi);
    if (fault == 5) return facets().d(m) * m.z / (4 * dot(wo, m));
    return facets().visible_density(wo, m) / (4 * dot(wo, m));
  }
  T gloss_f(const V3<T>& wo, const V3<T>& wi) const {
    const V3<T> m = unit(wo + wi);
    return schlick(f0, dot(wo, m)) * facets().d(m) * facets().g2(wo, wi) / (4 * wo.z * wi.z);
  }
  T body_f(const V3<T>& wo, const V3<T>& wi) const {
    return albedo * (1 - schlick(f0, wo.z)) * (1 - schlick(f0, wi.z)) / pi_v<T>;
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T f = schlick(f0, wo.z), p = f / (f + (1 - f) * albedo);
    const bool gloss = u < p;
    T left = gloss ? u / p : (u - p) / (1 - p);
    if (fault == 1) left = u / p;
    left = below_one(left);
    const V3<T> wi =
        gloss ? mirrored_at(wo, facets().visible(wo, left, v)) : cosine_hemisphere(left, v);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi), chosen_pdf = gloss ? gloss_pdf(wo, wi) : cosine_pdf(wi);
    if (fault == 3) {
      const T chosen_f = gloss ? gloss_f(wo, wi) : body_f(wo, wi);
      return Sampled<T>{wi, chosen_f * wi.z / chosen_pdf, q};
    }
    if (fault == 4) {
      const T stated = (gloss ? p : 1 - p) * chosen_pdf;
      return Sampled<T>{wi, eval(wo, wi) * wi.z / stated, stated};
    }
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T p = gloss_share(wo);
    return p * gloss_pdf(wo, wi) + (1 - p) * cosine_pdf(wi);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return body_f(wo, wi) + gloss_f(wo, wi);
  }
};

template <class T>
Tile<T> tile(T alpha, int fault) {
  return {alpha, on(fault)};
}

/// Leather: diffuse, a dull highlight and a sharp one, by weights whose sum is not 1.
template <class T>
struct Leather {
  int fault = 0;
  std::array<T, 3> weight{T(0.4), T(0.2), T(0.2)};
  std::array<T, 2> alpha{T(0.5), T(0.15)};

  TrowbridgeReitz<T> facets(std::size_t k, bool of_pdf) const {
    const T a = of_pdf && fault == 2 ? alpha[0] : alpha[k];
    return {a, a};
  }
  T sum() const { return weight[0] + weight[1] + weight[2]; }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    T x = fault == 1 ? u.x : u.x * sum();
    std::size_t k = 0;
    while (k < 3 && x >= weight[k]) x -= weight[k++];
    if (k == 3) {
      if (fault == 1) return std::nullopt;
      k = 2;
    }
    const V3<T> wi = k == 0 ? cosine_hemisphere(u.y, u.z)
                            : mirrored_at(wo, facets(k - 1, false).visible(wo, u.y, u.z));
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    T q = weight[0] * cosine_pdf(wi);
    for (std::size_t k = 0; k < 2; ++k) {
      q += weight[k + 1] * facets(k, true).visible_density(wo, m) / (4 * dot(wo, m));
    }
    return q / sum();
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    T f = weight[0] / pi_v<T>;
    for (std::size_t k = 0; k < 2; ++k) {
      const TrowbridgeReitz<T> s = facets(k, false);
      f += weight[k + 1] * s.d(m) * s.g2(wo, wi) / (4 * wo.z * wi.z);
    }
    return f;
  }
};

/// Parts on a list, any of which may be black; the others are chosen evenly.
struct PartsList {
  int fault = 0;
  TrowbridgeReitz<double> gloss{0.3, 0.3}, black{0.05, 0.05};

  std::optional<Sampled<double>> sample(const V3<double>& wo, double u, double v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const int part = u < 0.5 ? 0 : 1;
    const double left = 2 * u - part;
    const V3<double> wi =
        part == 0 ? cosine_hemisphere(left, v) : mirrored_at(wo, gloss.visible(wo, left, v));
    if (!(wi.z > 0)) return std::nullopt;
    const double q = pdf(wo, wi);
    return Sampled<double>{wi, eval(wo, wi) * wi.z / q, q};
  }
  double pdf(const V3<double>& wo, const V3<double>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<double> m = unit(wo + wi);
    const double both = cosine_pdf(wi) + gloss.visible_density(wo, m) / (4 * dot(wo, m));
    return both / (fault == 1 ? 3 : 2);
  }
  double eval(const V3<double>& wo, const V3<double>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return 0.4 / pi_v<double> + 0.5 * gloss.d(unit(wo + wi)) * gloss.g2(wo, wi) / (4 * wo.z * wi.z);
  }
};

/// Enamel, its parts exposed.
struct Enamel {
  int fault = 0;
  double body = 0.7;
  TrowbridgeReitz<double> gloss{0.2, 0.2}, wide{0.3, 0.3};

  std::optional<V3<double>> direction(const V3<double>& wo, int i, double u, double v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const TrowbridgeReitz<double>& s = fault == 2 ? wide : gloss;
    const V3<double> wi = i == 0 ? cosine_hemisphere(u, v) : mirrored_at(wo, s.visible(wo, u, v));
    if (!(wi.z > 0)) return std::nullopt;
    return wi;
  }
  double gloss_f(const V3<double>& wo, const V3<double>& wi) const {
    return 0.5 * gloss.d(unit(wo + wi)) * gloss.g2(wo, wi) / (4 * wo.z * wi.z);
  }
  std::optional<Sampled<double>> sample(const V3<double>& wo, const P2<double>& u) const {
    const bool first = u.x < body;
    const double left = below_one(first ? u.x / body : (u.x - body) / (1 - body));
    const auto wi = direction(wo, first ? 0 : 1, left, u.y);
    if (!wi) return std::nullopt;
    const double q = pdf(wo, *wi);
    return Sampled<double>{*wi, eval(wo, *wi) * wi->z / q, q};
  }
  double pdf(const V3<double>& wo, const V3<double>& wi) const {
    return body * pdf_lobe(wo, wi, 0) + (1 - body) * pdf_lobe(wo, wi, 1);
  }
  double eval(const V3<double>& wo, const V3<double>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return 0.45 / pi_v<double> + gloss_f(wo, wi);
  }
  int lobe_count() const { return 2; }
  double lobe_probability(const V3<double>&, int i) const {
    if (fault == 1) return 0.5;
    return i == 0 ? body : 1 - body;
  }
  std::optional<Sampled<double>> sample_lobe(const V3<double>& wo, int i,
                                             const P2<double>& u) const {
    const auto wi = direction(wo, i, u.x, u.y);
    if (!wi) return std::nullopt;
    const double q = pdf_lobe(wo, *wi, i);
    return Sampled<double>{*wi, (i == 0 ? 0.45 / pi_v<double> : gloss_f(wo, *wi)) * wi->z / q, q};
  }
  double pdf_lobe(const V3<double>& wo, const V3<double>& wi, int i) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    if (i == 0) return cosine_pdf(wi);
    const V3<double> m = unit(wo + wi);
    return gloss.visible_density(wo, m) / (4 * dot(wo, m));
  }
};

/// Rust on iron, blended by how much of it there is, from the caller's generator.
template <class T>
struct Rust {
  T amount = T(0.3);
  int fault = 0;
  TrowbridgeReitz<T> iron{T(0.4), T(0.4)};

  std::optional<Sampled<T>> sample(const V3<T>& wo, verify::Random& random) const {
    if (!(wo.z > 0)) return std::nullopt;
    const bool rust = verify::uniform<T>(random) < amount;
    const T u = verify::uniform<T>(random), v = verify::uniform<T>(random);
    const V3<T> wi = rust ? cosine_hemisphere(u, v) : mirrored_at(wo, iron.visible(wo, u, v));
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    const T p = fault == 1 ? 1 - amount : amount;
    return p * cosine_pdf(wi) + (1 - p) * iron.visible_density(wo, m) / (4 * dot(wo, m));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T metal = iron.d(unit(wo + wi)) * iron.g2(wo, wi) / (4 * wo.z * wi.z);
    return amount * T(0.3) / pi_v<T> + (1 - amount) * T(0.6) * metal;
  }
};

}  // namespace

void add_sealed_mixture_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fourth tile/alpha 0.25/double", "one way of stretching",
           said("L6: the body's number is divided by the highlight's share and cut off at 1"),
           {CauseKind::numbers_reused, CauseKind::on_a_line}, tile(0.25, 1), seen_from({40, 75}));
  twin<D3>(cases, "fourth tile/alpha 0.3/double", "share along the normal in pdf",
           said("pdf takes the highlight's share along the normal, sample at wo"),
           {CauseKind::lobe_probability, CauseKind::fresnel}, tile(0.3, 2), seen_from({65, 80}));
  twin<F3>(cases, "fourth tile/alpha 0.35/float", "weight of the part by itself",
           said("B8: the weight is that of the chosen part, as if there were no other"),
           {CauseKind::chosen_lobe_only, CauseKind::weight}, tile(0.35F, 3), seen_from({30, 65}));
  twin<D3>(cases, "fourth tile/alpha 0.4/double", "record of the part with its share",
           said("B7: the record has the chosen part's density, times its share"),
           {CauseKind::chosen_lobe_only, CauseKind::record_pdf}, tile(0.4, 4), seen_from({20, 60}));
  twin<D3>(cases, "fourth tile/alpha 0.5/double", "all normals in pdf",
           said("pdf of the highlight is that of all normals, sample draws visible ones"),
           {CauseKind::masking}, tile(0.5, 5), seen_from({50, 75}));
  twin<D3>(cases, "fourth leather/double", "weights not normalised in sample",
           said("sample gives nothing where its number is above the weights' sum of 0.8"),
           {CauseKind::lobe_probability, CauseKind::constant}, Leather<double>{on(1)},
           seen_from({10, 50}));
  twin<D3>(cases, "fourth leather/double", "one roughness in pdf",
           said("pdf takes the first highlight's roughness for both"), {CauseKind::roughness},
           Leather<double>{on(2)}, seen_from({10, 50}));
  twin<D3>(cases, "fourth parts on a list/double", "black part counted in pdf",
           said("pdf divides by the number of all parts, sample chooses among those not black"),
           {CauseKind::constant, CauseKind::lobe_probability}, PartsList{on(1)},
           seen_from({20, 60}));
  twin<D3>(cases, "fourth enamel/lobes exposed/double", "lobes said to be even",
           said("lobe_probability says a half for both, sample and pdf have 0.7 and 0.3"),
           {CauseKind::lobe_probability}, Enamel{on(1)}, seen_from({0, 60}));
  twin<D3>(cases, "fourth enamel/lobes exposed/double", "highlight sampled wider",
           said("B29: the highlight is sampled with an alpha of 0.3, pdf and f have 0.2"),
           {CauseKind::roughness}, Enamel{on(2)}, seen_from({0, 60}));
  twin<F3>(cases, "fourth rust/generator/float", "amounts exchanged in pdf",
           said("T2: pdf blends by one minus the amount"), {CauseKind::lobe_probability},
           Rust<float>{0.3F, on(1)}, seen_from({15, 60}));
}

}  // namespace plumbline::tests::corpus
