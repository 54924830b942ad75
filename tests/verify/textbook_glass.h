#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <plumbline/verify/bsdf.h>

/// BSDFs written down as in the textbook, with the cancellation that this has, in float or double.
namespace plumbline::tests {

template <class T>
struct Vector {
  T x, y, z;
};

template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// a·s + b·t
template <class T>
Vector<T> combined(const Vector<T>& a, T s, const Vector<T>& b, T t) {
  return {a.x * s + b.x * t, a.y * s + b.y * t, a.z * s + b.z * t};
}

template <class T>
Vector<T> unit(const Vector<T>& a) {
  const T l = std::sqrt(dot(a, a));
  return {a.x / l, a.y / l, a.z / l};
}

/// Rough glass, GGX. Radiance is scaled across the refraction. As a mirror it reflects everything.
///
/// @source Walter et al. 2007, Eqs. 16, 19 to 23, 33 and 34
template <class T>
struct TextbookGlass {
  using V = Vector<T>;
  struct Record {
    V wi;
  };
  T alpha = T(0.1);
  T eta = T(1.5);  ///< below over above; 0: a mirror

  /// Loses 2^-52/α² (2^-23/α² in float) of itself at the peak.
  T distribution(const V& h) const {
    const T a2 = alpha * alpha, q = 1 + (a2 - 1) * h.z * h.z;
    return a2 / (std::numbers::pi_v<T> * q * q);
  }
  T lambda(const V& w) const {
    const T tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
  }
  T reflectance(T c, T e) const {
    const T s2 = (1 - c * c) / (e * e);
    if (eta == 0 || s2 >= 1) return 1;
    const T t = std::sqrt(1 - s2), a = (c - e * t) / (c + e * t), b = (e * c - t) / (e * c + t);
    return (a * a + b * b) / 2;
  }
  /// η on the far side of wo over that on its own.
  T relative(const V& wo) const { return eta == 0 || wo.z > 0 ? eta : 1 / eta; }

  T eval(V wo, V wi) const {
    if (wo.z == 0 || wi.z == 0 || (eta == 0 && (wo.z < 0 || wi.z < 0))) return 0;
    const T e = relative(wo);
    if (wo.z < 0) wo.z = -wo.z, wi.z = -wi.z;
    const bool reflected = wi.z > 0;
    const V v = reflected ? combined(wo, T(1), wi, T(1)) : combined(wo, T(-1), wi, -e);
    if (!(dot(v, v) > 0)) return 0;
    V h = unit(v);
    if (h.z < 0) h = combined(h, T(-1), h, T(0));
    const T o = dot(wo, h), i = dot(wi, h);
    if (!(o > 0) || (reflected ? !(i > 0) : !(i < 0))) return 0;
    const T f = reflectance(o, e), dg = distribution(h) / (1 + lambda(wo) + lambda(wi));
    if (reflected) return f * dg / (4 * wo.z * wi.z);
    const T q = o + e * i;
    return (1 - f) * dg * o * -i / (wo.z * -wi.z * q * q);
  }

  /// Cosine-distributed tangents around the specular directions: any sampler near the peak will do.
  std::optional<Record> sample(V wo, T u, T v) const {
    const bool below = wo.z < 0;
    if (wo.z == 0 || (below && eta == 0)) return std::nullopt;
    const T e = relative(wo);
    if (below) wo.z = -wo.z;
    const bool transmits = eta != 0 && v < T(0.5);
    const T phi = 4 * std::numbers::pi_v<T> * v, tan = alpha * std::sqrt(u / (1 - u));
    const V h = unit(V{tan * std::cos(phi), tan * std::sin(phi), 1});
    const T c = dot(wo, h), k2 = 1 - (1 - c * c) / (e * e);
    if (!(c > 0) || (transmits && k2 <= 0)) return std::nullopt;
    V wi =
        transmits ? combined(wo, -1 / e, h, c / e - std::sqrt(k2)) : combined(h, 2 * c, wo, T(-1));
    if (transmits ? wi.z >= 0 : wi.z <= 0) return std::nullopt;
    if (below) wi.z = -wi.z;
    return Record{wi};
  }

  T pdf(V, V) const { return 1; }  // not looked at
};

}  // namespace plumbline::tests
