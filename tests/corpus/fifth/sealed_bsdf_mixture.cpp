#include <array>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_facets.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {
namespace fifth {
namespace {

/// Matte below, gloss above; which of them, by what they reflect, with a number of its own.
template <class T>
struct Plastic {
  T matte, gloss, alpha;
  int fault = 0;

  Ggx<T> facets() const { return {alpha, alpha}; }
  T share() const { return gloss / (gloss + matte); }
  T gloss_pdf(const V3<T>& wo, const V3<T>& wi) const {
    const V3<T> h = halfway(wo, wi);
    return facets().seen(wo, h) / (4 * dot(wo, h));
  }
  static T matte_pdf(const V3<T>& wi) { return wi.z / pi_v<T>; }
  T gloss_f(const V3<T>& wo, const V3<T>& wi) const {
    const V3<T> h = halfway(wo, wi);
    return gloss * facets().ndf(h) * facets().shadows(wo, wi) / (4 * wo.z * wi.z);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const bool glossy = u.x < (fault == 4 ? 1 - share() : share());
    const V3<T> wi =
        glossy ? mirrored_at(wo, facets().seen_normal(wo, u.y, u.z)) : lambert_direction(u.y, u.z);
    if (!(wi.z > 0)) return std::nullopt;
    const T all = pdf(wo, wi), one = glossy ? gloss_pdf(wo, wi) : matte_pdf(wi);
    if (fault == 2) return Sampled<T>{wi, eval(wo, wi) * wi.z / all, one};
    const T f = fault != 3 ? eval(wo, wi) : glossy ? gloss_f(wo, wi) : matte / pi_v<T>;
    return Sampled<T>{wi, f * wi.z / all, all};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    if (fault == 1) return gloss_pdf(wo, wi) + matte_pdf(wi);
    return share() * gloss_pdf(wo, wi) + (1 - share()) * matte_pdf(wi);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? matte / pi_v<T> + gloss_f(wo, wi) : T(0);
  }
};

template <class T>
Plastic<T> plastic(T matte, T gloss, T alpha, int fault) {
  return {matte, gloss, alpha, put(fault)};
}

/// Wax on a floor: the first of two numbers chooses as well, by Fresnel's term of wo.
template <class T>
struct Linoleum {
  T alpha = T(0.3), index = T(1.6), matte = T(0.5);
  int fault = 0;

  T glossy_share(const V3<T>& w) const {
    const T f = fresnel_dielectric(w.z, index);
    return f / (f + matte * (1 - f));
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, P2<T> u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T p = glossy_share(wo);
    const bool glossy = u.x < p;
    const Ggx<T> facets{alpha, alpha};
    if (fault != 1) u.x = below_one(glossy ? u.x / p : (u.x - p) / (1 - p));
    const V3<T> wi =
        glossy ? mirrored_at(wo, facets.any_normal(u.x, u.y)) : lambert_direction(u.x, u.y);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    const T p = glossy_share(fault == 2 ? wi : wo);
    return p * Ggx<T>{alpha, alpha}.ndf(h) * h.z / (4 * dot(wo, h)) + (1 - p) * wi.z / pi_v<T>;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    const Ggx<T> facets{alpha, alpha};
    const T f = fresnel_dielectric(dot(wo, h), index);
    const T under = (1 - fresnel_dielectric(wo.z, index)) * (1 - fresnel_dielectric(wi.z, index));
    return f * facets.ndf(h) * facets.shadows(wo, wi) / (4 * wo.z * wi.z) + under * matte / pi_v<T>;
  }
};

/// Metallic paint of a car, whose lobes can be asked one by one: matte, flakes, clear coat.
template <class T>
struct CarPaint {
  std::array<T, 3> strength{T(0.3), T(0.4), T(0.1)};
  std::array<T, 3> alpha{T(1), T(0.45), T(0.12)};
  int fault = 0;

  int lobe_count() const { return 3; }
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  T lobe_probability(const V3<T>&, int i) const {
    return strength[index(i)] / (strength[0] + strength[1] + strength[2]);
  }
  std::optional<Sampled<T>> sample_lobe(const V3<T>& wo, int i, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const Ggx<T> facets{alpha[index(i)], alpha[index(i)]};
    const V3<T> wi =
        i == 0 ? lambert_direction(u.x, u.y) : mirrored_at(wo, facets.seen_normal(wo, u.x, u.y));
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf_lobe(const V3<T>& wo, const V3<T>& wi, int i) const {
    if (!both_above(wo, wi)) return 0;
    if (i == 0) return wi.z / pi_v<T>;
    const V3<T> h = halfway(wo, wi);
    return Ggx<T>{alpha[index(i)], alpha[index(i)]}.seen(wo, h) / (4 * dot(wo, h));
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    int i = 0;
    T rest = u.x;
    while (i < 2 && rest >= lobe_probability(wo, i)) rest -= lobe_probability(wo, i++);
    return sample_lobe(wo, i, {u.y, u.z});
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    T sum = 0;
    for (int i = 0; i < 3; ++i) {
      const T p = fault == 1 ? T(1) / 3 : lobe_probability(wo, i);
      sum += p * pdf_lobe(wo, wi, i);
    }
    return sum;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    T f = strength[0] / pi_v<T>;
    for (std::size_t i = 1; i < 3; ++i) {
      const Ggx<T> facets{alpha[i], alpha[i]};
      f += strength[i] * facets.ndf(halfway(wo, wi)) * facets.shadows(wo, wi) / (4 * wo.z * wi.z);
    }
    return f;
  }
};

/// A narrow lobe with a few matte samples among its own, so that no weight is large.
template <class T>
struct Guarded {
  T alpha = T(0.2), matte_share = T(0.15);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, verify::Random& random) const {
    if (!(wo.z > 0)) return std::nullopt;
    const bool matte = verify::uniform<T>(random) < matte_share;
    const T u = verify::uniform<T>(random), v = verify::uniform<T>(random);
    const V3<T> wi = matte ? lambert_direction(u, v)
                           : mirrored_at(wo, Ggx<T>{alpha, alpha}.seen_normal(wo, u, v));
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    const T narrow = Ggx<T>{alpha, alpha}.seen(wo, h) / (4 * dot(wo, h));
    if (fault == 1) return narrow;
    if (fault == 2) return matte_share * wi.z / pi_v<T> + narrow;
    return matte_share * wi.z / pi_v<T> + (1 - matte_share) * narrow;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const Ggx<T> facets{alpha, alpha};
    const V3<T> h = halfway(wo, wi);
    return schlick(T(0.8), dot(wo, h)) * facets.ndf(h) * facets.shadows(wo, wi) / (4 * wo.z * wi.z);
  }
};

/// Tinted matte and tinted gloss, in colour; which of them, by luminance.
template <class T>
struct Tinted {
  Rgb<T> matte{T(0.05), T(0.1), T(0.8)}, gloss{T(0.3), T(0.25), T(0.04)};
  T power = 25;
  int fault = 0;

  static T luminance(const Rgb<T>& c) {
    return T(0.2126) * c.r + T(0.7152) * c.g + T(0.0722) * c.b;
  }
  static T mean(const Rgb<T>& c) { return (c.r + c.g + c.b) / 3; }
  T matte_share(bool of_pdf) const {
    if (of_pdf && fault == 1) return mean(matte) / (mean(matte) + mean(gloss));
    return luminance(matte) / (luminance(matte) + luminance(gloss));
  }
  static T along_mirror(const V3<T>& wo, const V3<T>& wi) {
    return std::max(T(0), wo.z * wi.z - wo.x * wi.x - wo.y * wi.y);
  }
  std::optional<SampledRgb<T>> sample(const V3<T>& wo, T choice, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    V3<T> wi = lambert_direction(u, v);
    if (!(choice < matte_share(false))) {
      const V3<T> around = spherical(std::pow(1 - u, 1 / (power + 1)), 2 * pi_v<T> * v);
      wi = Frame<T>(V3<T>{-wo.x, -wo.y, wo.z}).to_world(around);
    }
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return SampledRgb<T>{wi, (wi.z / q) * eval(wo, wi), q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const T p = matte_share(true), lobe = std::pow(along_mirror(wo, wi), power);
    return p * wi.z / pi_v<T> + (1 - p) * (power + 1) / (2 * pi_v<T>)*lobe;
  }
  Rgb<T> eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return {0, 0, 0};
    const T lobe = (power + 2) / (2 * pi_v<T>)*std::pow(along_mirror(wo, wi), power);
    return (1 / pi_v<T>)*matte + lobe * gloss;
  }
};

}  // namespace
}  // namespace fifth

void add_sealed_mixture_cases(std::vector<Case>& cases) {
  using namespace fifth;
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fifth plastic/alpha 0.3/double", "sum without probabilities",
           because("pdf adds both lobes' densities as they are"), {CauseKind::lobe_probability},
           plastic(0.5, 0.3, 0.3, 1), seen_from({20, 60}));
  twin<D3>(cases, "fifth plastic/alpha 0.2/double", "chosen lobe's pdf in the record",
           because("B7: the record states the pdf of the lobe that was chosen"),
           {CauseKind::chosen_lobe_only, CauseKind::record_pdf}, plastic(0.4, 0.4, 0.2, 2),
           seen_from({10, 55}));
  twin<F3>(cases, "fifth plastic/alpha 0.4/float", "chosen lobe's f in the weight",
           because("B8: the weight is the chosen lobe's f over the mixture's pdf"),
           {CauseKind::chosen_lobe_only, CauseKind::weight}, plastic(0.5F, 0.2F, 0.4F, 3),
           seen_from({30, 65}));
  twin<F3>(cases, "fifth plastic/alpha 0.25/float", "lobes exchanged in sample",
           because("sample takes the gloss with the matte lobe's probability"),
           {CauseKind::lobe_probability}, plastic(0.6F, 0.2F, 0.25F, 4), seen_from({15, 50}));
  twin<D3>(cases, "fifth linoleum/double", "number not stretched",
           because("the number that chose the lobe samples it as it is"),
           {CauseKind::numbers_reused}, Linoleum<double>{0.3, 1.6, 0.5, put(1)},
           seen_from({20, 65}));
  twin<D3>(cases, "fifth linoleum/index 2/double", "F of wi in pdf",
           because("pdf has the choice by Fresnel's term of wi, sample by that of wo"),
           {CauseKind::lobe_probability, CauseKind::directions_swapped, CauseKind::fresnel},
           Linoleum<double>{0.35, 2, 0.3, put(2)}, seen_from({50, 75}));
  twin<D3>(cases, "fifth car paint/double", "lobes as if even",
           because("pdf gives each lobe a third, sample goes by their strength"),
           {CauseKind::lobe_probability},
           CarPaint<double>{{0.3, 0.4, 0.1}, {1, 0.45, 0.12}, put(1)}, seen_from({25, 60}));
  twin<D3>(cases, "fifth guarded gloss/generator/double", "matte samples not in pdf",
           because("pdf is that of the narrow lobe alone, 15 % of the samples are matte"),
           {CauseKind::lobe_probability, CauseKind::chosen_lobe_only},
           Guarded<double>{0.2, 0.15, put(1)}, seen_from({20, 60}));
  twin<F3>(cases, "fifth guarded gloss/generator/float", "1 - p forgotten",
           because("M7: the narrow lobe lacks the probability that it is chosen"),
           {CauseKind::lobe_probability}, Guarded<float>{0.3F, 0.3F, put(2)}, seen_from({10, 50}));
  twin<D3>(cases, "fifth tinted/three numbers/double", "mean for luminance in pdf",
           because("T1: pdf has the share by the channels' mean, sample by luminance"),
           {CauseKind::lobe_probability},
           Tinted<double>{{0.05, 0.1, 0.8}, {0.3, 0.25, 0.04}, 25, put(1)}, seen_from({15, 60}));
}

}  // namespace plumbline::tests::corpus
