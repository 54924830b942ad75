#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "bsdf_ggx.h"
#include "bsdf_glass.h"
#include "bsdf_math.h"

/// Materials of many parts: layers by mean albedo, and the principled one.
namespace plumbline::tests::corpus {

/// A rough dielectric coat over diffuse, energy shared by the coat's directional albedo, which is
/// tabulated when the material is made.
///
/// @source Kelemen, Szirmay-Kalos 2001, A microfacet based coupled specular-matte BRDF model
template <class T>
class AlbedoLayers {
 public:
  explicit AlbedoLayers(T alpha, T albedo = T(0.7), int fault = 0)
      : coat_{alpha, alpha}, albedo_(albedo), fault_(fault) {
    constexpr int kSteps = 48;
    for (std::size_t i = 0; i < kSize; ++i) {
      const T c = std::max(T(0.002), T(i) / T(kSize - 1));
      const V3<T> wo{std::sqrt(1 - c * c), 0, c};
      T sum = 0;
      for (int j = 0; j < kSteps * kSteps; ++j) {
        const T u = (T(j % kSteps) + T(0.5)) / kSteps, v = (T(j / kSteps) + T(0.5)) / kSteps;
        const V3<T> h = coat_.sample_caps(wo, u, v), wi = mirrored_at(wo, h);
        if (wi.z > 0) sum += schlick(kF0, dot(wo, h)) * coat_.g2(wo, wi) / coat_.g1(wo);
      }
      table_[i] = sum / (kSteps * kSteps);
    }
    // E is piecewise linear in cosθ, so that its mean 2∫E·c dc is known.
    for (std::size_t i = 0; i + 1 < kSize; ++i) {
      const T a = T(i) / (kSize - 1), b = T(i + 1) / (kSize - 1);
      mean_ += (b - a) / 3 * (table_[i] * (2 * a + b) + table_[i + 1] * (a + 2 * b));
    }
  }

  T coat_albedo(T cosine) const {
    const T x = std::clamp(cosine, T(0), T(1)) * (kSize - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(x), kSize - 2);
    const T t = x - T(i);
    return (1 - t) * table_[i] + t * table_[i + 1];
  }
  T coat_probability(const V3<T>& wo) const {
    const T e = coat_albedo(wo.z);
    return e / (e + (1 - e) * albedo_);
  }
  const Sampled<T>* sample(const V3<T>& wo, T choice, T u, T v) const {
    if (!(wo.z > 0)) return nullptr;
    const T p = coat_probability(wo);
    const V3<T> wi =
        choice < p ? mirrored_at(wo, coat_.sample_caps(wo, u, v)) : cosine_hemisphere(u, v);
    if (!(wi.z > 0)) return nullptr;
    const T q = pdf(wo, wi);
    static thread_local Sampled<T> record;
    record = {wi, eval(wo, wi) * wi.z / q, q};
    return &record;
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T p = coat_probability(fault_ == 1 ? wi : wo);
    const T coat = coat_.g1(wo) * coat_.d(unit(wo + wi)) / (4 * wo.z);
    return (fault_ == 2 ? T(1) : p) * coat + (1 - p) * wi.z / pi_v<T>;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    const T f = schlick(kF0, dot(wo, h)) * coat_.d(h) * coat_.g2(wo, wi) / (4 * wo.z * wi.z);
    T base = (1 - coat_albedo(wo.z)) * (1 - coat_albedo(wi.z)) / (1 - mean_);
    if (fault_ == 3) base = 1;
    if (fault_ == 4) base = 1 - coat_albedo(wo.z);
    if (fault_ == 5) base /= 1 - mean_;
    return f + albedo_ / pi_v<T> * base;
  }

 private:
  static constexpr std::size_t kSize = 32;
  static constexpr T kF0 = T(0.06);
  Ggx<T> coat_;
  T albedo_;
  int fault_;
  std::array<T, kSize> table_{};
  T mean_ = 0;
};

/// Retro-reflecting diffuse, sheen, metallic highlight, clear coat and rough glass in one, each
/// with its share of the samples. Glass alone is left from below. Three numbers; the first chooses
/// and chooses again between the sides of the glass.
///
/// @source Burley 2012 (course notes), Eq. 4 and appendix B; Burley 2015
template <class T>
struct Principled {
  T roughness = T(0.5), metallic = T(0.3), transmission = T(0.3), sheen = T(0.4);
  T clearcoat = T(0.8), gloss = T(0.6), anisotropy = T(0.5), colour = T(0.7);
  int fault = 0;

  Ggx<T> metal() const {
    const T aspect = std::sqrt(1 - T(0.9) * anisotropy), a = roughness * roughness;
    return {std::max(T(1e-3), a / aspect), std::max(T(1e-3), a * aspect)};
  }
  RoughGlass<T> glass() const {
    const T a = roughness * roughness;
    return {{a, a}, T(1.45)};
  }
  T coat_alpha() const { return T(0.1) + gloss * (T(0.001) - T(0.1)); }

  /// Shares of diffuse (with sheen), highlight, coat, glass.
  std::array<T, 4> shares(const V3<T>& wo) const {
    if (wo.z < 0) return {0, 0, 0, 1};
    const T dielectric = (1 - metallic) * (1 - transmission);
    std::array<T, 4> s{dielectric * colour, metallic + dielectric * T(0.04), clearcoat / 4,
                       (1 - metallic) * transmission};
    T sum = 0;
    for (const T x : s) sum += x;
    for (T& x : s) x /= sum;
    return s;
  }

  /// log in place of α², as the coat has wider tails than GGX.
  T gtr1(T cos_h, T a) const {
    const T a2 = a * a, t = 1 + (a2 - 1) * cos_h * cos_h;
    return (a2 - 1) / (pi_v<T> * std::log(a2) * t);
  }
  V3<T> sample_coat(T u, T v) const {
    const T a2 = fault == 1 ? coat_alpha() : sqr(coat_alpha());
    return spherical(safe_sqrt((1 - std::pow(a2, 1 - u)) / (1 - a2)), 2 * pi_v<T> * v);
  }
  std::optional<SampledRgb<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (wo.z == 0) return std::nullopt;
    const auto share = shares(wo);
    std::size_t i = 0;
    T below = 0;
    while (i < 3 && u.x >= below + share[i]) below += share[i++];
    const T again = below_one((u.x - below) / share[i]);
    V3<T> wi{};
    if (i == 0) {
      wi = cosine_hemisphere(u.y, u.z);
    } else if (i == 1) {
      wi = mirrored_at(wo, metal().sample_caps(wo, u.y, u.z));
    } else if (i == 2) {
      wi = mirrored_at(wo, sample_coat(u.y, u.z));
    } else {
      const auto s = glass().sample(wo, fault == 2 ? u.x : again, u.y, u.z);
      if (!s) return std::nullopt;
      wi = s->wi;
    }
    if (i < 3 && !(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return SampledRgb<T>{wi, (std::abs(wi.z) / q) * eval(wo, wi), q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    const auto share = fault == 3 ? shares(V3<T>{0, 0, 1}) : shares(wo);
    T sum = share[3] * glass().pdf(wo, wi);
    if (!(wo.z > 0) || !(wi.z > 0)) return sum;
    const V3<T> h = unit(wo + wi);
    const T half = 1 / (4 * dot(wo, h));
    sum += share[0] * wi.z / pi_v<T> + share[1] * metal().visible(wo, h) * half;
    const T coat = gtr1(h.z, coat_alpha()) * (fault == 4 ? T(1) : h.z);
    return sum + (fault == 5 ? clearcoat / 4 : share[2]) * coat * (fault == 6 ? T(0.25) : half);
  }
  Rgb<T> eval(const V3<T>& wo, const V3<T>& wi) const {
    const T through = (1 - metallic) * transmission * glass().eval(wo, wi);
    const Rgb<T> grey{1, 1, 1}, tint{colour, colour / 2, colour / 4};
    if (!(wo.z > 0) || !(wi.z > 0)) return through * grey;
    const V3<T> h = unit(wo + wi);
    const T d = dot(wo, h), fifth = schlick(T(0), d);
    const T f90 = T(0.5) + 2 * roughness * d * d;
    const auto rise = [f90](T c) { return 1 + (f90 - 1) * schlick(T(0), c); };
    const T dielectric = (1 - metallic) * (1 - transmission);
    const T diffuse = dielectric / pi_v<T> * rise(wo.z) * (fault == 7 ? T(1) : rise(wi.z));
    const T g = metal().d(h) * metal().g2(wo, wi) / (4 * wo.z * wi.z);
    const Ggx<T> coat_mask{T(0.25), T(0.25)};
    const T coat = clearcoat / 4 * gtr1(h.z, coat_alpha()) * schlick(T(0.04), d) *
                   coat_mask.g1(wo) * coat_mask.g1(wi) / (4 * wo.z * wi.z);
    const Rgb<T> f0 = (dielectric * T(0.04)) * grey + metallic * tint;
    const Rgb<T> fresnel = (1 - fifth) * f0 + ((dielectric * T(0.04) + metallic) * fifth) * grey;
    return diffuse * tint + (dielectric * sheen * fifth / pi_v<T> + coat + through) * grey +
           g * fresnel;
  }
};

}  // namespace plumbline::tests::corpus
