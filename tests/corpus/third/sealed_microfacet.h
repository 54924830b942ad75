#pragma once

#include "bsdf_math.h"

/// Microfacets of the fresh half, written apart from those of the open one.
namespace plumbline::tests::corpus::fresh {

/// GGX, anisotropic.
///
/// @source Heitz 2018 (JCGT 7:4), "Sampling the GGX Distribution of Visible Normals", listing 1
template <class T>
struct Facets {
  T ax, ay;

  T ndf(const V3<T>& m) const {
    if (!(m.z > 0)) return 0;
    const T e = sqr(m.x / ax) + sqr(m.y / ay) + sqr(m.z);
    return 1 / (pi_v<T> * ax * ay * e * e);
  }
  T g1(const V3<T>& w) const {
    const T z = std::abs(w.z);
    return 2 * z / (z + std::sqrt(z * z + sqr(ax * w.x) + sqr(ay * w.y)));
  }
  T g2(const V3<T>& wo, const V3<T>& wi) const { return 1 / (1 / g1(wo) + 1 / g1(wi) - 1); }

  /// Per solid angle of the normal.
  T visible_pdf(const V3<T>& wo, const V3<T>& m) const {
    return g1(wo) * std::max(T(0), dot(wo, m)) * ndf(m) / wo.z;
  }
  V3<T> visible_normal(const V3<T>& wo, T u, T v) const {
    const V3<T> w = unit(V3<T>{ax * wo.x, ay * wo.y, wo.z});
    const T flat = w.x * w.x + w.y * w.y;
    const V3<T> a = flat > 0 ? (1 / std::sqrt(flat)) * V3<T>{-w.y, w.x, 0} : V3<T>{1, 0, 0};
    const V3<T> b = cross(w, a);
    const T r = std::sqrt(u), phi = 2 * pi_v<T> * v, s = (1 + w.z) / 2;
    const T p = r * std::cos(phi);
    const T q = (1 - s) * safe_sqrt(1 - p * p) + s * r * std::sin(phi);
    const V3<T> n = p * a + q * b + safe_sqrt(1 - p * p - q * q) * w;
    return unit(V3<T>{ax * n.x, ay * n.y, std::max(T(0), n.z)});
  }
  V3<T> any_normal(T u, T v) const {
    const T phi = 2 * pi_v<T> * v, slope = std::sqrt(u / (1 - u));
    return unit(V3<T>{ax * slope * std::cos(phi), ay * slope * std::sin(phi), 1});
  }
};

/// Fresnel reflectance of a dielectric, pbrt's way round: cosine may be of either sign.
template <class T>
T reflectance(T cosine, T eta) {
  return fresnel_dielectric(std::abs(cosine), cosine > 0 ? eta : 1 / eta);
}

}  // namespace plumbline::tests::corpus::fresh
