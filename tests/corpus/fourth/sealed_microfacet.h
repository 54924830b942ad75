#pragma once

#include "bsdf_math.h"

/// Microfacets of the fourth set, written apart from those of the others.
namespace plumbline::tests::corpus::fourth {

/// Trowbridge and Reitz's distribution, anisotropic, with Smith's masking.
///
/// @source Heitz 2014 (JCGT 3:2), Eq. 72, 85, 86, 99
template <class T>
struct TrowbridgeReitz {
  T ax, ay;

  T d(const V3<T>& m) const {
    if (!(m.z > 0)) return 0;
    const T e = sqr(m.x / ax) + sqr(m.y / ay) + sqr(m.z);
    return 1 / (pi_v<T> * ax * ay * sqr(e));
  }
  T lambda(const V3<T>& w) const {
    const T tan2 = (sqr(ax * w.x) + sqr(ay * w.y)) / sqr(w.z);
    return tan2 / (2 * (1 + std::sqrt(1 + tan2)));
  }
  T g1(const V3<T>& w) const { return 1 / (1 + lambda(w)); }
  T g2(const V3<T>& wo, const V3<T>& wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }

  /// Per solid angle of the normal, wo above.
  T visible_density(const V3<T>& wo, const V3<T>& m) const {
    return g1(wo) * std::max(T(0), dot(wo, m)) * d(m) / wo.z;
  }

  /// @source Dupuy, Benyoub 2023 (CGF 42:8), "Sampling Visible GGX Normals with Spherical Caps"
  V3<T> visible(const V3<T>& wo, T u, T v) const {
    const V3<T> w = unit(V3<T>{ax * wo.x, ay * wo.y, wo.z});
    const T z = (1 - u) * (1 + w.z) - w.z, r = safe_sqrt(1 - z * z), phi = 2 * pi_v<T> * v;
    const V3<T> h{r * std::cos(phi) + w.x, r * std::sin(phi) + w.y, z + w.z};
    return unit(V3<T>{ax * h.x, ay * h.y, std::max(T(1e-7), h.z)});
  }

  /// @source Walter et al. 2007, Eq. 35
  V3<T> any(T u, T v) const {
    const T phi = 2 * pi_v<T> * v, slope = std::sqrt(u / (1 - u));
    return unit(V3<T>{ax * slope * std::cos(phi), ay * slope * std::sin(phi), 1});
  }
};

template <class T>
V3<T> turned_about_z(const V3<T>& w, T angle) {
  const T c = std::cos(angle), s = std::sin(angle);
  return {c * w.x - s * w.y, s * w.x + c * w.y, w.z};
}

template <class T>
V3<T> over(const V3<T>& w) {
  return {w.x, w.y, -w.z};
}

}  // namespace plumbline::tests::corpus::fourth
