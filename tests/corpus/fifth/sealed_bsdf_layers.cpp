#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_facets.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {
namespace fifth {
namespace {

template <class T>
struct Layered {
  V3<T> wi;
  T weight, pdf;
  bool is_delta;
};

/// A smooth varnish over matte wood. What is thrown back inside is taken as lost.
template <class T>
struct Varnish {
  T index, albedo;
  int fault = 0;

  T lets_in(const V3<T>& w) const { return 1 - fresnel_dielectric(w.z, index); }
  std::optional<Layered<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T f = 1 - lets_in(wo);
    if (u.x < f) return Layered<T>{{-wo.x, -wo.y, wo.z}, T(1), fault == 3 ? T(1) : f, true};
    const V3<T> wi = lambert_direction(u.y, u.z);
    if (!(wi.z > 0)) return std::nullopt;
    return Layered<T>{wi, albedo * lets_in(wi), pdf(wo, wi), false};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    return (fault == 1 ? T(1) : lets_in(wo)) * wi.z / pi_v<T>;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const T base = albedo / pi_v<T>;
    return fault == 2 ? lets_in(wo) * base : lets_in(wo) * lets_in(wi) * base;
  }
};

/// A rough clear coat over rougher metal, half of the samples for each.
template <class T>
struct CoatedMetal {
  T coat_alpha, base_alpha;
  int fault = 0;

  static T passes(const V3<T>& w) { return 1 - schlick(T(0.04), w.z); }
  static T facet_pdf(T alpha, const V3<T>& wo, const V3<T>& wi) {
    const V3<T> h = halfway(wo, wi);
    return Ggx<T>{alpha, alpha}.seen(wo, h) / (4 * dot(wo, h));
  }
  static T facet_f(T alpha, T f0, const V3<T>& wo, const V3<T>& wi) {
    const Ggx<T> facets{alpha, alpha};
    const V3<T> h = halfway(wo, wi);
    return schlick(f0, dot(wo, h)) * facets.ndf(h) * facets.shadows(wo, wi) / (4 * wo.z * wi.z);
  }
  T attenuated(const V3<T>& wo, const V3<T>& wi, T both_ways) const {
    return facet_f(coat_alpha, T(0.04), wo, wi) + both_ways * facet_f(base_alpha, T(0.7), wo, wi);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T alpha = u.x < T(0.5) ? coat_alpha : base_alpha;
    const V3<T> wi = mirrored_at(wo, Ggx<T>{alpha, alpha}.seen_normal(wo, u.y, u.z));
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    const T both_ways = fault == 1 ? passes(wo) : passes(wo) * passes(wi);
    return Sampled<T>{wi, attenuated(wo, wi, both_ways) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const T base = fault == 2 ? sqr(base_alpha) : base_alpha;
    return (facet_pdf(coat_alpha, wo, wi) + facet_pdf(base, wo, wi)) / 2;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? attenuated(wo, wi, passes(wo) * passes(wi)) : T(0);
  }
};

/// A sheet of haze: what scatters in it once, evenly, and what passes straight through.
///
/// @source Hanrahan, Krueger 1993, §5.1
template <class T>
struct Haze {
  T depth, single;
  int fault = 0;

  T passes(const V3<T>& wo) const {
    return std::exp(fault == 2 ? -depth * std::abs(wo.z) : -depth / std::abs(wo.z));
  }
  std::optional<Layered<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (wo.z == 0) return std::nullopt;
    const T straight = std::exp(-depth / std::abs(wo.z));
    if (u.x < straight) return Layered<T>{-wo, T(1), passes(wo), true};
    const V3<T> wi = spherical(1 - 2 * u.y, 2 * pi_v<T> * u.z);
    if (wi.z == 0) return std::nullopt;
    const T q = pdf(wo, wi);
    return Layered<T>{wi, eval(wo, wi) * std::abs(wi.z) / q, q, false};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z == 0 || wi.z == 0) return 0;
    const T scatters = -std::expm1(-depth / std::abs(wo.z));
    return (fault == 1 ? T(1) : scatters) / (4 * pi_v<T>);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z == 0 || wi.z == 0) return 0;
    const T o = std::abs(wo.z), i = std::abs(wi.z), phase = single / (4 * pi_v<T>);
    if (wo.z * wi.z > 0) return phase / (o + i) * -std::expm1(-depth * (1 / o + 1 / i));
    // exp(-d/o) (1 - exp(-d (1/i - 1/o))) / (o - i), from the larger cosine so that nothing
    // overflows, and its limit where both are alike.
    const T x = depth * std::abs(1 / i - 1 / o);
    const T top = std::exp(-depth / std::max(o, i)) * depth / (o * i);
    return phase * top * (x == 0 ? T(1) : -std::expm1(-x) / x);
  }
};

}  // namespace
}  // namespace fifth

void add_sealed_layers_cases(std::vector<Case>& cases) {
  using namespace fifth;
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fifth varnish/1.5/double", "wood without 1 - F in pdf",
           because("B31: the reflection is chosen with probability F, pdf lacks 1 - F"),
           {CauseKind::lobe_probability, CauseKind::fresnel}, Varnish<double>{1.5, 0.7, put(1)},
           seen_from({30, 70}));
  twin<F3>(cases, "fifth varnish/1.7/float", "light let in once",
           because("f has Fresnel's transmission for wo, not for wi; the weight has both"),
           {CauseKind::fresnel}, Varnish<float>{1.7F, 0.6F, put(2)}, seen_from({20, 65}));
  twin<D3>(cases, "fifth varnish/1.4/double", "mirror with the pdf 1",
           because("B19: the atom states 1 for the probability with which it is chosen"),
           {CauseKind::atom_as_density}, Varnish<double>{1.4, 0.8, put(3)}, seen_from({10, 60}));
  twin<D3>(cases, "fifth coated metal/double", "through the coat once in the weight",
           because("the weight of the metal has 1 - F of the coat for wo alone"),
           {CauseKind::fresnel, CauseKind::weight}, CoatedMetal<double>{0.15, 0.4, put(1)},
           seen_from({30, 65}));
  twin<D3>(cases, "fifth coated metal/base 0.5/double", "alpha of the base squared in pdf",
           because("pdf squares the metal's alpha once more"), {CauseKind::roughness},
           CoatedMetal<double>{0.1, 0.5, put(2)}, seen_from({15, 55}));
  twin<D3>(cases, "fifth haze/0.5/double", "scattering without its probability",
           because("pdf lacks the probability that light does not pass straight through"),
           {CauseKind::lobe_probability, CauseKind::constant}, Haze<double>{0.5, 0.8, put(1)},
           from_both_faces({0, 60}));
  twin<F3>(cases, "fifth haze/1/float", "depth times cosine",
           because("the atom's mass has depth times cosine, not depth over cosine"),
           {CauseKind::atom_as_density}, Haze<float>{1, 0.9F, put(2)}, from_both_faces({30, 60}));
}

}  // namespace plumbline::tests::corpus
