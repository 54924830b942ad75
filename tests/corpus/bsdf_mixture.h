#pragma once

#include <array>

#include <plumbline/verify/detail/random.h>

#include "bsdf_ggx.h"
#include "bsdf_math.h"

/// Mixtures, in every way that a lobe is chosen and numbers are handed in.
namespace plumbline::tests::corpus {

/// Diffuse under a glossy lobe by visible normals: what the lobes are, without how one is chosen.
template <class T>
struct PaintLobes {
  Ggx<T> ggx{T(0.2), T(0.2)};
  T kd = T(0.3), ks = T(0.6), diffuse_probability = T(0.3);
  int fault = 0;

  using Direction = std::optional<V3<T>>;
  Direction sample_direction(const V3<T>& wo, bool diffuse, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = diffuse ? cosine_hemisphere(u, v) : mirrored_at(wo, ggx.sample_caps(wo, u, v));
    return wi.z > 0 ? Direction(wi) : std::nullopt;
  }
  T pdf_of(const V3<T>& wo, const V3<T>& wi, bool diffuse) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return diffuse ? wi.z / pi_v<T> : ggx.g1(wo) * ggx.d(unit(wo + wi)) / (4 * wo.z);
  }
  T f_of(const V3<T>& wo, const V3<T>& wi, bool diffuse) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    if (diffuse) return kd / pi_v<T>;
    return ks * ggx.d(unit(wo + wi)) * ggx.g2(wo, wi) / (4 * wo.z * wi.z);
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    T p = diffuse_probability;
    if (fault == 1) p = kd;
    if (fault == 2) return pdf_of(wo, wi, true) + (1 - p) * pdf_of(wo, wi, false);
    if (fault == 3) return pdf_of(wo, wi, true) + pdf_of(wo, wi, false);
    if (fault == 4) return std::max(pdf_of(wo, wi, true), pdf_of(wo, wi, false));
    if (fault == 5) return pdf_of(wo, wi, false);
    const T glossy = fault == 6 ? pdf_of(wi, wo, false) : pdf_of(wo, wi, false);
    return p * pdf_of(wo, wi, true) + (1 - p) * glossy;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return f_of(wo, wi, true) + f_of(wo, wi, false);
  }
  std::optional<Sampled<T>> finish(const V3<T>& wo, const Direction& wi, bool diffuse) const {
    if (!wi) return std::nullopt;
    T q = pdf(wo, *wi), f = eval(wo, *wi);
    if (fault == 7) q = pdf_of(wo, *wi, diffuse);
    if (fault == 8) f = f_of(wo, *wi, diffuse);
    return Sampled<T>{*wi, f * wi->z / q, q};
  }
};

/// The first of two numbers chooses and is used again.
template <class T>
struct PaintOfTwo : PaintLobes<T> {
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    const T p = this->diffuse_probability;
    const bool diffuse = u < p;
    T again = diffuse ? u / p : (u - p) / (1 - p);
    if (this->fault == 10) again = u;
    if (this->fault == 11 && !diffuse) again = (u - p) / p - std::floor((u - p) / p);
    return this->finish(wo, this->sample_direction(wo, diffuse, below_one(again), v), diffuse);
  }
};

/// The same, lobes exposed; the numbers come as a vector.
template <class T>
struct PaintWithLobes : PaintLobes<T> {
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    PaintOfTwo<T> plain;
    static_cast<PaintLobes<T>&>(plain) = *this;
    return plain.sample(wo, u.x, u.y);
  }
  int lobe_count() const { return 2; }
  T lobe_probability(const V3<T>&, int i) const {
    return i == 0 ? this->diffuse_probability : 1 - this->diffuse_probability;
  }
  std::optional<Sampled<T>> sample_lobe(const V3<T>& wo, int i, const P2<T>& u) const {
    const auto wi = this->sample_direction(wo, i == 0, u.x, u.y);
    if (!wi) return std::nullopt;
    const T q = this->pdf_of(wo, *wi, i == 0);
    return Sampled<T>{*wi, this->f_of(wo, *wi, i == 0) * wi->z / q, q};
  }
  T pdf_lobe(const V3<T>& wo, const V3<T>& wi, int i) const { return this->pdf_of(wo, wi, i == 0); }
};

/// Lobes exposed, the numbers two scalars.
template <class T>
struct PaintWithLobesOfScalars : PaintWithLobes<T> {
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    return PaintWithLobes<T>::sample(wo, {u, v});
  }
};

/// A number of its own for the choice.
template <class T>
struct PaintOfThree : PaintLobes<T> {
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    const bool diffuse = u.x < this->diffuse_probability;
    if (this->fault == 10)
      return this->finish(wo, this->sample_direction(wo, diffuse, u.x, u.z), diffuse);
    return this->finish(wo, this->sample_direction(wo, diffuse, u.y, u.z), diffuse);
  }
};

/// Takes the caller's generator; a rejected glossy sample gives nothing.
template <class T>
struct PaintOfGenerator : PaintLobes<T> {
  std::optional<Sampled<T>> sample(const V3<T>& wo, verify::Random& random) const {
    const bool diffuse = verify::uniform<T>(random) < this->diffuse_probability;
    typename PaintLobes<T>::Direction wi;
    for (int tries = 0; !wi && tries < (this->fault == 12 ? 4 : 1); ++tries) {
      const T u = verify::uniform<T>(random), v = verify::uniform<T>(random);
      wi = this->sample_direction(wo, diffuse, u, v);
    }
    return this->finish(wo, wi, diffuse);
  }
};

/// Five glossy lobes of different roughness and weight, chosen by running sums of the weights with
/// the number used again, as a fitted measured material comes.
template <class T>
struct FiveLobes {
  std::array<T, 5> weight{T(0.3), T(0.25), T(0.2), T(0.15), T(0.1)};
  std::array<T, 5> alpha{T(0.05), T(0.12), T(0.3), T(0.6), T(1)};
  int fault = 0;

  Ggx<T> lobe(std::size_t i) const { return {alpha[i], alpha[i]}; }
  T pdf_of(const V3<T>& wo, const V3<T>& wi, std::size_t i) const {
    return lobe(i).g1(wo) * lobe(i).d(unit(wo + wi)) / (4 * wo.z);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    std::size_t i = 0;
    T below = 0;
    while (i < 4 && u >= (fault == 1 ? weight[i] : below + weight[i])) below += weight[i++];
    T again = (u - below) / weight[i];
    if (fault == 1) again -= std::floor(again);
    if (fault == 2) again = u;
    const V3<T> wi = mirrored_at(wo, lobe(i).sample_caps(wo, below_one(std::max(T(0), again)), v));
    if (!(wi.z > 0)) return std::nullopt;
    const T q = fault == 3 ? pdf_of(wo, wi, i) : pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    T sum = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      const std::size_t k = fault == 4 ? (i + 1) % 5 : i;
      const T w = fault == 5 ? T(0.2) : fault == 6 && i == 4 ? 1 : weight[k];
      sum += w * pdf_of(wo, wi, i);
    }
    return sum;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    T sum = 0;
    const V3<T> h = unit(wo + wi);
    for (std::size_t i = 0; i < 5; ++i) {
      sum += weight[i] * lobe(i).d(h) * lobe(i).g2(wo, wi) / (4 * wo.z * wi.z);
    }
    return sum;
  }
};

/// Two BSDFs of any kind by a weight, each asked on its own, as a node of a shading graph does it.
template <class T, class A, class B>
struct Blend {
  A a;
  B b;
  T weight = T(0.4);  ///< of the second
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    const bool second = u.x < weight;
    const auto s = second ? take(b, wo, u) : take(a, wo, u);
    if (!s) return std::nullopt;
    const T q = fault == 1 ? s->pdf : pdf(wo, s->wi);
    if (fault == 2) return Sampled<T>{s->wi, s->weight, q};
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{s->wi, eval(wo, s->wi) * std::abs(s->wi.z) / q, q};
  }
  template <class C>
  std::optional<Sampled<T>> take(const C& bsdf, const V3<T>& wo, const P3<T>& u) const {
    if constexpr (requires { bsdf.sample(wo, u); }) {
      // A blend itself: it stretches what is left of the number that chose it.
      const T p = u.x < weight ? weight : 1 - weight;
      return bsdf.sample(wo, P3<T>{below_one((u.x < weight ? u.x : u.x - weight) / p), u.y, u.z});
    } else if constexpr (requires { bsdf.sample(wo, u.y, u.z); }) {
      return bsdf.sample(wo, u.y, u.z);
    } else {
      return bsdf.sample(wo, P2<T>{u.y, u.z});
    }
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    const T w = fault == 3 ? 1 - weight : weight;
    return (1 - w) * a.pdf(wo, wi) + w * (fault == 4 ? a.pdf(wo, wi) : b.pdf(wo, wi));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return (1 - weight) * a.eval(wo, wi) + weight * b.eval(wo, wi);
  }
};

}  // namespace plumbline::tests::corpus
