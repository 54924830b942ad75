#pragma once

#include <cstdint>
#include <limits>

#include "bsdf_math.h"

/// Microfacet reflection: GGX, isotropic and anisotropic, and Beckmann.
namespace plumbline::tests::corpus {

enum class Normals { caps, disk, all };  ///< visible by two ways, or D·cosθh

/// The distribution of normals.
///
/// @source Walter et al. 2007; Heitz 2014, Eq. 71, 85, 86; Heitz 2018; Dupuy, Benyoub 2023
template <class T>
struct Ggx {
  T ax = T(0.2), ay = T(0.2);
  bool textbook = false;  ///< D with (a² − 1)cos² + 1, which cancels where a is small

  T d(const V3<T>& h) const {
    if (textbook) {
      const T a2 = ax * ax, q = (a2 - 1) * h.z * h.z + 1;
      return a2 / (pi_v<T> * q * q);
    }
    const T q = sqr(h.x / ax) + sqr(h.y / ay) + h.z * h.z;
    return 1 / (pi_v<T> * ax * ay * q * q);
  }
  T lambda(const V3<T>& w) const {
    return (std::sqrt(1 + (sqr(ax * w.x) + sqr(ay * w.y)) / (w.z * w.z)) - 1) / 2;
  }
  T g1(const V3<T>& w) const { return 1 / (1 + lambda(w)); }
  T g2(const V3<T>& wo, const V3<T>& wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }

  /// Of normals that wo sees; reflected it still lacks 1/(4 wo·h).
  T visible(const V3<T>& wo, const V3<T>& h) const {
    return g1(wo) * std::max(T(0), dot(wo, h)) * d(h) / wo.z;
  }
  V3<T> sample_caps(const V3<T>& wo, T u, T v) const {
    const V3<T> w = unit(V3<T>{ax * wo.x, ay * wo.y, wo.z});
    const T phi = 2 * pi_v<T> * u, z = (1 - v) * (1 + w.z) - w.z, s = safe_sqrt(1 - z * z);
    const V3<T> c{s * std::cos(phi) + w.x, s * std::sin(phi) + w.y, z + w.z};
    return unit(V3<T>{ax * c.x, ay * c.y, std::max(T(0), c.z)});
  }
  V3<T> sample_disk(const V3<T>& wo, T u, T v, int fault = 0) const {
    const V3<T> w = unit(V3<T>{ax * wo.x, ay * wo.y, wo.z});
    const T l2 = w.x * w.x + w.y * w.y;
    V3<T> t1 = l2 > 0 || fault == 31 ? 1 / std::sqrt(l2) * V3<T>{-w.y, w.x, 0} : V3<T>{1, 0, 0};
    if (fault == 30) t1 = Frame<T>(w).s;
    const V3<T> t2 = cross(w, t1);
    const T r = std::sqrt(u), phi = 2 * pi_v<T> * v;
    const T p1 = r * std::cos(phi), s = (1 + w.z) / 2;
    const T p2 = (1 - s) * safe_sqrt(1 - p1 * p1) + s * (r * std::sin(phi));
    const V3<T> n = p1 * t1 + p2 * t2 + safe_sqrt(1 - p1 * p1 - p2 * p2) * w;
    return unit(V3<T>{ax * n.x, ay * n.y, std::max(T(0), n.z)});
  }
  V3<T> sample_all(T u, T v) const {
    const T phi = std::atan2(ay * std::sin(2 * pi_v<T> * v), ax * std::cos(2 * pi_v<T> * v));
    const T c = std::cos(phi), s = std::sin(phi);
    const T tan2 = u / (1 - u) / (sqr(c / ax) + sqr(s / ay));
    const T cosine = 1 / std::sqrt(1 + tan2), sine = std::sqrt(tan2) * cosine;
    return {sine * c, sine * s, cosine};
  }
};

/// A metal.
template <class T>
struct Conductor {
  Ggx<T> ggx;
  Normals normals = Normals::caps;
  bool two_sided = false;
  T f0 = T(0.9);
  int fault = 0;

  Ggx<T> ggx_of_sample() const {
    const T least = fault == 1 ? T(0.05) : T(0);
    Ggx<T> g = ggx;
    if (fault == 2) g.ax = g.ay = std::sqrt(ggx.ax);
    if (fault == 3) std::swap(g.ax, g.ay);
    g.ax = std::max(g.ax, least), g.ay = std::max(g.ay, least);
    return g;
  }
  V3<T> sample_half(const V3<T>& wo, T u, T v) const {
    const Ggx<T> g = ggx_of_sample();
    if (normals == Normals::caps) return g.sample_caps(wo, u, v);
    return normals == Normals::disk ? g.sample_disk(wo, u, v, fault) : g.sample_all(u, v);
  }
  std::optional<Sampled<T>> sample(const V3<T>& given, T u, T v) const {
    if (given.z == 0 || (!two_sided && given.z < 0)) return std::nullopt;
    V3<T> wo = given;
    const bool flipped = wo.z < 0;
    if (flipped) wo = fault == 4 ? -wo : V3<T>{wo.x, wo.y, -wo.z};
    const V3<T> h = sample_half(wo, u, v);
    V3<T> wi = mirrored_at(wo, h);
    if (fault == 5 && wi.z < 0) wi.z = -wi.z;
    if (fault == 6 && wi.z <= 0) return Sampled<T>{wi, 0, ggx.visible(wo, h) / (4 * dot(wo, h))};
    if (!(wi.z > 0)) return std::nullopt;
    if (flipped) wi.z = -wi.z;
    const T q = pdf(given, wi);
    if (normals != Normals::all) {
      const V3<T> far{wi.x, wi.y, std::abs(wi.z)};
      const T masked = fault == 7 ? ggx.g1(wo) : ggx.g2(wo, far) / ggx.g1(wo);
      return Sampled<T>{wi, schlick(f0, dot(wo, h)) * masked, q};
    }
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(given, wi) * std::abs(wi.z) / q, q};
  }
  static bool turn(V3<T>& wo, V3<T>& wi) {
    if (wo.z < 0) wo.z = -wo.z, wi.z = -wi.z;
    return wo.z > 0 && wi.z > 0;
  }
  T pdf(V3<T> wo, V3<T> wi) const {
    if ((!two_sided && wo.z < 0) || !turn(wo, wi)) return 0;
    const V3<T> h = unit(wo + wi);
    if (fault == 8) std::swap(wo, wi);
    const T jacobian = 1 / (4 * dot(wo, h));
    if (normals == Normals::all) {
      const T dh = ggx.d(h);
      return fault == 9 ? dh * jacobian : fault == 10 ? dh * h.z : dh * h.z * jacobian;
    }
    if (fault == 10) return ggx.visible(wo, h);
    if (fault == 11) return ggx.visible(wo, h) / ggx.g1(wo) * jacobian;
    if (fault == 12) return ggx.visible(wo, h) * jacobian / 2;
    if (fault == 13) return ggx.visible(wo, h) / (4 * wo.z);
    if (fault == 14) {
      const V3<T> other{-wo.x, -wo.y, wo.z}, k = unit(other + wi);
      return ggx.visible(other, k) / (4 * dot(other, k));
    }
    return ggx.visible(wo, h) * jacobian;
  }
  T eval(V3<T> wo, V3<T> wi) const {
    if ((!two_sided && wo.z < 0) || !turn(wo, wi)) return 0;
    const V3<T> h = unit(wo + wi);
    Ggx<T> rough = ggx;
    if (fault == 15) rough.ax = rough.ay = std::sqrt(ggx.ax);
    T g = rough.g2(wo, wi);
    if (fault == 16) g = ggx.g1(wo);
    if (fault == 17) g = 1;
    const T f = schlick(f0, fault == 18 ? wo.z : dot(wo, h)) * ggx.d(h) * g / (4 * wo.z * wi.z);
    return fault == 19 ? f * wi.z : fault == 20 ? f * pi_v<T> : f;
  }
};

/// A generator of a renderer's own.
///
/// @source O'Neill 2014, PCG
class Pcg32 {
 public:
  using result_type = std::uint32_t;
  explicit Pcg32(std::uint32_t seed) {
    state_ = seed * 0x9e3779b97f4a7c15u + kIncrement, (*this)();
  }
  static constexpr std::uint32_t min() { return 0; }
  static constexpr std::uint32_t max() { return ~std::uint32_t{0}; }
  std::uint32_t operator()() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005u + kIncrement;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto turn = static_cast<std::uint32_t>(old >> 59);
    return (shifted >> turn) | (shifted << ((~turn + 1) & 31));
  }

 private:
  static constexpr std::uint64_t kIncrement = 1442695040888963407u;
  std::uint64_t state_ = 0;
};

/// A metal with Beckmann's normals, all of them sampled, not only the visible.
///
/// @source Walter et al. 2007, Eq. 25, 28, 29; Λ of Heitz 2014, Eq. 66
template <class T>
struct Beckmann {
  T alpha = T(0.3), f0 = T(0.8);
  int fault = 0;

  static T lambda(const V3<T>& w, T roughness) {
    const T sine = std::sqrt(w.x * w.x + w.y * w.y);
    if (sine < std::numeric_limits<T>::min()) return 0;
    const T a = w.z / (roughness * sine);
    return (std::exp(-a * a) / (a * std::sqrt(pi_v<T>)) - std::erfc(a)) / 2;
  }
  T d(const V3<T>& h) const {
    const T c2 = h.z * h.z, a2 = alpha * alpha;
    return std::exp(-(1 - c2) / (c2 * a2)) / (pi_v<T> * a2 * c2 * c2);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, Pcg32& generator) const {
    if (!(wo.z > 0)) return std::nullopt;
    const auto number = [&generator] { return std::ldexp(static_cast<T>(generator() >> 9), -23); };
    const T u = number(), v = number();
    const T tan2 = -(fault == 1 ? alpha : alpha * alpha) * std::log(1 - u);
    const T cosine = 1 / std::sqrt(1 + tan2), phi = 2 * pi_v<T> * v;
    const T sine = std::sqrt(tan2) * cosine;
    const V3<T> h{sine * std::cos(phi), sine * std::sin(phi), cosine};
    const V3<T> wi = mirrored_at(wo, h);
    if (!(wi.z > 0)) return fault == 2 ? sample(wo, generator) : std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    return d(h) * (fault == 3 ? T(1) : h.z) / (4 * std::abs(dot(wo, h)));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    const T roughness = fault == 4 ? alpha * alpha : alpha;
    const T lambdas = lambda(wo, roughness) + (fault == 5 ? T(0) : lambda(wi, roughness));
    return schlick(f0, dot(wo, h)) * d(h) / (1 + lambdas) / (4 * wo.z * wi.z);
  }
};

}  // namespace plumbline::tests::corpus
