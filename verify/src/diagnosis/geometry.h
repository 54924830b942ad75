#pragma once

#include <cmath>
#include <numbers>

#include "diagnosis/ask.h"
#include "vec3.h"

/// Quantities of a pair of directions that densities are made of.
namespace plumbline::verify {

/// Smith's masking of the GGX distribution. @source Walter et al. 2007, Eq. 34
inline double smith_g1(const Vec3& w, double alpha) {
  const double tan2 = (w[0] * w[0] + w[1] * w[1]) / (w[2] * w[2]);
  return 2 / (1 + std::sqrt(1 + alpha * alpha * tan2));
}

/// GGX distribution of normals. @source Walter et al. 2007, Eq. 33
inline double ggx_d(const Vec3& h, double alpha) {
  const double a2 = alpha * alpha;
  const double d = h[2] * h[2] * a2 + h[0] * h[0] + h[1] * h[1];
  return a2 / (std::numbers::pi * d * d);
}

/// Beckmann distribution of normals. @source Walter et al. 2007, Eq. 25
inline double beckmann_d(const Vec3& h, double alpha) {
  const double c2 = h[2] * h[2], a2 = alpha * alpha;
  return std::exp(-(h[0] * h[0] + h[1] * h[1]) / (c2 * a2)) / (std::numbers::pi * a2 * c2 * c2);
}

inline bool transmits(const Vec3& wo, const Vec3& wi) { return wo[2] * wi[2] < 0; }

/// Refractive index of the medium that a direction points into.
inline double index_of(const Vec3& w, double eta) { return w[2] < 0 ? eta : 1; }

/// Half vector of a reflection or refraction, with z ≥ 0. @source Walter et al. 2007, Eqs. 13, 16
inline Vec3 half_vector_of(const Vec3& wo, const Vec3& wi, double eta) {
  Vec3 h = sum(wo, wi);
  if (transmits(wo, wi)) {
    h = sum(scaled(wo, index_of(wo, eta)), scaled(wi, index_of(wi, eta)));
  }
  const double l = length(h);
  if (!(l > 0)) return {0, 0, 1};
  return scaled(h, (h[2] < 0 ? -1 : 1) / l);
}

inline Vec3 half_of(const Place& p) { return half_vector_of(p.wo, p.x, p.view->eta); }

/// dω_h/dω_i of a refraction, for indices on the side of wo and of wi.
/// @source Walter et al. 2007, Eq. 17
inline double refraction_jacobian(const Vec3& wo, const Vec3& wi, const Vec3& h, double eta_o,
                                  double eta_i) {
  const double s = eta_o * dot(wo, h) + eta_i * dot(wi, h);
  return eta_i * eta_i * std::abs(dot(wi, h)) / (s * s);
}

/// Unpolarised Fresnel reflectance. @param eta  index behind over index before
inline double fresnel_dielectric(double cosine, double eta) {
  cosine = std::abs(cosine);
  const double sin2 = (1 - cosine * cosine) / (eta * eta);
  if (sin2 >= 1) return 1;
  const double t = std::sqrt(1 - sin2);
  const double parallel = (eta * cosine - t) / (eta * cosine + t);
  const double perpendicular = (cosine - eta * t) / (cosine + eta * t);
  return (parallel * parallel + perpendicular * perpendicular) / 2;
}

/// @source Schlick 1994, Eq. 15
inline double fresnel_schlick(double cosine, double f0) {
  return f0 + (1 - f0) * std::pow(1 - std::abs(cosine), 5);
}

}  // namespace plumbline::verify
