#pragma once

#include "bsdf_math.h"

/// Facets and small things that several BSDFs of the fifth set share.
namespace plumbline::tests::corpus::fifth {

template <class T>
V3<T> upside_down(const V3<T>& w) {
  return {w.x, w.y, -w.z};
}

template <class T>
V3<T> halfway(const V3<T>& a, const V3<T>& b) {
  return unit(a + b);
}

template <class T>
bool both_above(const V3<T>& a, const V3<T>& b) {
  return a.z > 0 && b.z > 0;
}

template <class T>
V3<T> lambert_direction(T u, T v) {
  const T r = std::sqrt(u), turn = 2 * pi_v<T> * v;
  return {r * std::cos(turn), r * std::sin(turn), std::sqrt(std::max(T(0), 1 - u))};
}

/// GGX with its Smith functions, all of them in terms of |z| and of the stretched sine.
template <class T>
struct Ggx {
  T ax, ay;

  T ndf(const V3<T>& h) const {
    const T k = sqr(h.x / ax) + sqr(h.y / ay) + sqr(h.z);
    return 1 / (pi_v<T> * ax * ay * k * k);
  }
  /// |z| and the sine as the stretched surface sees it, put together.
  T slanted(const V3<T>& w) const { return std::sqrt(sqr(w.z) + sqr(ax * w.x) + sqr(ay * w.y)); }
  T shadow(const V3<T>& w) const { return 2 * std::abs(w.z) / (std::abs(w.z) + slanted(w)); }
  T shadows(const V3<T>& a, const V3<T>& b) const {
    const T za = std::abs(a.z), zb = std::abs(b.z);
    return 2 * za * zb / (zb * slanted(a) + za * slanted(b));
  }
  /// Density of h among the normals that wo sees.
  T seen(const V3<T>& wo, const V3<T>& h) const {
    return shadow(wo) * std::max(T(0), dot(wo, h)) * ndf(h) / wo.z;
  }

  /// @source Heitz 2018 (JCGT 7:4), "Sampling the GGX Distribution of Visible Normals", listing 1
  V3<T> seen_normal(const V3<T>& wo, T u, T v) const {
    const V3<T> s = unit(V3<T>{ax * wo.x, ay * wo.y, wo.z});
    const T flat = s.x * s.x + s.y * s.y;
    const V3<T> e =
        flat > 0 ? (1 / std::sqrt(flat)) * V3<T>{-s.y, s.x, T(0)} : V3<T>{T(1), T(0), T(0)};
    const V3<T> f = cross(s, e);
    const T r = std::sqrt(u), turn = 2 * pi_v<T> * v, p = r * std::cos(turn);
    const T bent = (1 + s.z) / 2;
    const T q = (1 - bent) * safe_sqrt(1 - p * p) + bent * r * std::sin(turn);
    const V3<T> n = p * e + q * f + safe_sqrt(1 - p * p - q * q) * s;
    return unit(V3<T>{ax * n.x, ay * n.y, std::max(T(1e-7), n.z)});
  }
  /// A normal of the whole surface: density ndf(h) h.z.
  V3<T> any_normal(T u, T v) const {
    const T turn = 2 * pi_v<T> * v, tangent = std::sqrt(u / (1 - u));
    return unit(V3<T>{ax * tangent * std::cos(turn), ay * tangent * std::sin(turn), T(1)});
  }
};

}  // namespace plumbline::tests::corpus::fifth
