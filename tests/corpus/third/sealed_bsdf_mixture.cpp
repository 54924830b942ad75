#include <array>

#include <plumbline/verify/detail/random.h>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_microfacet.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fresh::Facets;
using fresh::on;
using fresh::said;

/// Plastic: diffuse with a highlight. The second of two numbers chooses and is stretched.
template <class T>
struct Plastic {
  Facets<T> facets{T(0.25), T(0.25)};
  int fault = 0;
  T kd = T(0.4), ks = T(0.5), diffuse_share = T(0.35);

  T diffuse_pdf(const V3<T>& wi) const { return wi.z / pi_v<T>; }
  T glossy_pdf(const V3<T>& wo, const V3<T>& wi) const {
    return facets.g1(wo) * facets.ndf(unit(wo + wi)) / (4 * wo.z);
  }
  T glossy_f(const V3<T>& wo, const V3<T>& wi) const {
    return ks * facets.ndf(unit(wo + wi)) * facets.g2(wo, wi) / (4 * wo.z * wi.z);
  }
  V3<T> cosine_direction(T u, T v) const {
    const T r = fault == 1 ? u : std::sqrt(u), phi = 2 * pi_v<T> * v;
    return {r * std::cos(phi), r * std::sin(phi), safe_sqrt(1 - r * r)};
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const bool diffuse = v < diffuse_share;
    T left = diffuse ? v / diffuse_share : (v - diffuse_share) / (1 - diffuse_share);
    if (fault == 2) left = v;
    left = below_one(left);
    const V3<T> wi =
        diffuse ? cosine_direction(u, left) : mirrored_at(wo, facets.visible_normal(wo, u, left));
    if (!(wi.z > 0)) return std::nullopt;
    T q = pdf(wo, wi);
    const T chosen =
        diffuse ? diffuse_share * diffuse_pdf(wi) : (1 - diffuse_share) * glossy_pdf(wo, wi);
    const T f = diffuse ? kd / pi_v<T> : glossy_f(wo, wi);
    if (fault == 3) return Sampled<T>{wi, f * wi.z / chosen, q};
    if (fault == 4) q = chosen;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T p = fault == 5 ? 1 - diffuse_share : diffuse_share;
    if (fault == 6) return p * diffuse_pdf(wi);
    return p * diffuse_pdf(wi) + (1 - p) * glossy_pdf(wo, wi);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return kd / pi_v<T> + glossy_f(wo, wi);
  }
};

template <class T>
Plastic<T> plastic(T alpha, int fault) {
  return {{alpha, alpha}, on(fault)};
}

/// Skin: diffuse and two highlights, by weights that do not add up to 1; a number of its own for
/// the choice.
template <class T>
struct Skin {
  int fault = 0;
  std::array<T, 3> weight{T(0.5), T(0.15), T(0.1)};
  std::array<Facets<T>, 2> oil{Facets<T>{T(0.5), T(0.5)}, Facets<T>{T(0.2), T(0.2)}};

  T sum() const { return weight[0] + weight[1] + weight[2]; }
  T oil_pdf(const V3<T>& wo, const V3<T>& wi, std::size_t k) const {
    const V3<T> m = unit(wo + wi);
    const T d = oil[k].ndf(m) * m.z;
    return fault == 2 && k == 1 ? d / 4 : d / (4 * dot(wo, m));
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T x = u.x * sum();
    V3<T> wi{};
    if (x < weight[0]) {
      wi = cosine_hemisphere(u.y, u.z);
    } else {
      const V3<T> m = oil[x < weight[0] + weight[1] ? 0 : 1].any_normal(u.y, u.z);
      if (!(dot(wo, m) > 0)) return std::nullopt;
      wi = mirrored_at(wo, m);
    }
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    std::array<T, 3> w = weight;
    if (fault == 3) std::swap(w[1], w[2]);
    const T mixed = w[0] * wi.z / pi_v<T> + w[1] * oil_pdf(wo, wi, 0) + w[2] * oil_pdf(wo, wi, 1);
    return fault == 1 ? mixed : mixed / sum();
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    T f = weight[0] / pi_v<T>;
    for (std::size_t k = 0; k < 2; ++k) {
      f += weight[k + 1] * oil[k].ndf(m) * oil[k].g2(wo, wi) / (4 * wo.z * wi.z);
    }
    return f;
  }
};

template <class T>
Skin<T> skin(int fault) {
  Skin<T> s;
  s.fault = on(fault);
  return s;
}

/// Car paint from the caller's generator: base, or flakes on the normals that wo sees.
struct CarPaint {
  int fault = 0;
  Facets<double> flakes{0.7, 0.7};
  double base_share = 0.4;

  std::optional<Sampled<double>> sample(const V3<double>& wo, verify::Random& random) const {
    if (!(wo.z > 0)) return std::nullopt;
    const bool base = random.uniform() < base_share;
    for (int tries = 0; tries < (fault == 1 ? 16 : 1); ++tries) {
      const double u = random.uniform(), v = fault == 2 ? u : random.uniform();
      const V3<double> wi =
          base ? cosine_hemisphere(u, v) : mirrored_at(wo, flakes.visible_normal(wo, u, v));
      if (!(wi.z > 0)) continue;
      const double q = pdf(wo, wi);
      return Sampled<double>{wi, eval(wo, wi) * wi.z / q, q};
    }
    return std::nullopt;
  }
  double pdf(const V3<double>& wo, const V3<double>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const double glossy = flakes.g1(wo) * flakes.ndf(unit(wo + wi)) / (4 * wo.z);
    return base_share * wi.z / pi_v<double> + (1 - base_share) * glossy;
  }
  double eval(const V3<double>& wo, const V3<double>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const double glossy = flakes.ndf(unit(wo + wi)) * flakes.g2(wo, wi) / (4 * wo.z * wi.z);
    return 0.2 / pi_v<double> + 0.7 * glossy;
  }
};

}  // namespace

void add_sealed_mixture_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fresh plastic/alpha 0.25/double", "diffuse radius without the root",
           said("the diffuse lobe's disk has r = u, without the square root"), {CauseKind::radius},
           plastic(0.25, 1), seen_from({0, 60}));
  twin<F3>(cases, "fresh plastic/alpha 0.3/float", "second number not stretched",
           said("L6: the number that chose the lobe is the azimuth as it is"),
           {CauseKind::numbers_reused}, plastic(0.3F, 2), seen_from({20, 60}));
  twin<D3>(cases, "fresh plastic/alpha 0.4/double", "weight of the chosen lobe alone",
           said("B8: the weight is f of the chosen lobe over its own share of the pdf"),
           {CauseKind::chosen_lobe_only, CauseKind::weight}, plastic(0.4, 3), seen_from({0, 60}));
  twin<D3>(cases, "fresh plastic/alpha 0.6/double", "pdf without the highlight",
           said("pdf has the diffuse lobe alone, with its probability"),
           {CauseKind::lobe_probability}, plastic(0.6, 6), seen_from({10, 65}));
  twin<D3>(cases, "fresh skin/double", "weights not normalised in pdf",
           said("pdf weighs the lobes by weights whose sum is 0.75, sample normalises them"),
           {CauseKind::lobe_probability, CauseKind::constant}, skin<double>(1), seen_from({0, 60}));
  twin<D3>(cases, "fresh car paint/generator/double", "drawn again below the horizon",
           said("samples below the horizon are drawn again, up to 16 times, pdf does not know"),
           {CauseKind::not_rejected}, CarPaint{on(1)}, seen_from({60, 80}));
}

}  // namespace plumbline::tests::corpus
