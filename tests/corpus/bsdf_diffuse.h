#pragma once

#include <plumbline/verify/detail/random.h>

#include "bsdf_math.h"

/// Lobes without a half vector: diffuse, sheen, retroreflection.
namespace plumbline::tests::corpus {

/// Diffuse reflection by Malley's method.
template <class T>
struct Lambert {
  T albedo = T(0.7);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T r = fault == 1 ? u.x : std::sqrt(u.x), phi = 2 * pi_v<T> * u.y;
    const V3<T> wi{r * std::cos(phi), r * std::sin(phi), safe_sqrt(1 - r * r)};
    const T pdf_w = fault == 7 ? pdf(wo, wi) * pi_v<T> : pdf(wo, wi);
    return Sampled<T>{wi, fault == 6 ? albedo / pi_v<T> : albedo, pdf_w};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    if (fault == 2) return 1 / (2 * pi_v<T>);
    return fault == 3 ? wi.z : wi.z / pi_v<T>;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T f = albedo / pi_v<T>;
    return fault == 4 ? f * wi.z : fault == 5 ? f / pi_v<T> : f;
  }
};

/// A leaf: diffuse on both sides. The side is chosen by the first number, which is used again.
template <class T>
struct DiffuseTransmitter {
  Rgb<T> reflectance{T(0.5), T(0.3), T(0.2)}, transmittance{T(0.1), T(0.3), T(0.1)};
  int fault = 0;

  T reflect_probability() const {
    const T r = std::max({reflectance.r, reflectance.g, reflectance.b});
    const T t = std::max({transmittance.r, transmittance.g, transmittance.b});
    return r / (r + t);
  }
  SampledRgb<T> sample(const V3<T>& wo, T u, T v) const {
    const T p = reflect_probability();
    const bool reflected = u < p;
    const T again = reflected ? u / p : (u - p) / (1 - p);
    V3<T> wi = cosine_hemisphere(fault == 1 ? u : below_one(again), v);
    if (reflected != (wo.z > 0)) wi.z = -wi.z;
    const T q = pdf(wo, wi);
    return {wi, (std::abs(wi.z) / q) * eval(wo, wi), q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    const T cosine = std::abs(wi.z) / pi_v<T>;
    if (fault == 2) return cosine;
    if (fault == 3) return cosine / 2;
    const T p = fault == 4 ? 1 - reflect_probability() : reflect_probability();
    return wo.z * wi.z > 0 ? p * cosine : (1 - p) * cosine;
  }
  Rgb<T> eval(const V3<T>& wo, const V3<T>& wi) const {
    return 1 / pi_v<T> * (wo.z * wi.z > 0 ? reflectance : transmittance);
  }
};

/// The qualitative model, wi before wo, the cosine in eval.
///
/// @source Oren, Nayar 1994, Eq. 30
template <class T>
struct OrenNayar {
  T albedo = T(0.8), sigma = T(0.5);
  int fault = 0;

  struct Record {
    V3<T> wi;
    T value, pdf;
  };
  std::optional<Record> sample(const V3<T>& wo, const P2<T>& u) const {
    if (wo.z <= 0) return std::nullopt;
    const P2<T> d = concentric_disk(u.x, u.y);
    const V3<T> wi{d.x, d.y, safe_sqrt(1 - d.x * d.x - d.y * d.y)};
    if (wi.z <= 0) return std::nullopt;
    return Record{wi, eval(wi, wo), pdf(wi, wo)};
  }
  T pdf(const V3<T>& wi, const V3<T>& wo) const {
    return wi.z > 0 && wo.z > 0 ? wi.z / pi_v<T> : T(0);
  }
  T eval(const V3<T>& wi, const V3<T>& wo) const {
    if (wi.z <= 0 || wo.z <= 0) return 0;
    const T s2 = sigma * sigma;
    const T a = 1 - s2 / (2 * (s2 + T(0.33))), b = T(0.45) * s2 / (s2 + T(0.09));
    const T sin_i = safe_sqrt(1 - wi.z * wi.z), sin_o = safe_sqrt(1 - wo.z * wo.z);
    T cos_difference = 0;
    if (sin_i > T(1e-4) && sin_o > T(1e-4)) {
      cos_difference = std::max(T(0), (wi.x * wo.x + wi.y * wo.y) / (sin_i * sin_o));
    }
    const bool wi_steeper = fault == 1 ? true : fault == 2 ? wi.z <= wo.z : wi.z > wo.z;
    const T sin_alpha = wi_steeper ? sin_o : sin_i;
    const T tan_beta = wi_steeper ? sin_i / wi.z : sin_o / wo.z;
    const T f = albedo / pi_v<T> * (a + b * cos_difference * sin_alpha * tan_beta);
    return fault == 3 ? f * wi.z * wi.z : fault == 4 ? f : f * wi.z;
  }
};

/// Cloth: sheen sampled uniformly over the hemisphere.
///
/// @source Estevez, Kulla 2017, Production friendly microfacet sheen BRDF, Eq. 2, with the
/// denominator of Neubelt, Pettineo 2013
template <class T>
struct Sheen {
  T roughness = T(0.5);
  int fault = 0;

  struct Record {
    V3<T> direction;
    T throughput, pdf;
  };
  std::optional<Record> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T z = fault == 1 ? std::cos(u * pi_v<T> / 2) : fault == 2 ? std::sqrt(1 - u) : 1 - u;
    const V3<T> wi = spherical(z, 2 * pi_v<T> * v);
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Record{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return fault == 3 ? 1 / (4 * pi_v<T>) : 1 / (2 * pi_v<T>);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    const T sin_h = std::sqrt(h.x * h.x + h.y * h.y), k = 1 / roughness;
    const T d = (2 + k) * std::pow(sin_h, k) / (2 * pi_v<T>);
    return d / (4 * (wi.z + wo.z - wi.z * wo.z));
  }
};

/// A power of the cosine around wo itself; directions below the horizon are rejected.
template <class T>
struct Retroreflector {
  T exponent = 50, albedo = T(0.9);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T cosine = std::pow(u.x, 1 / (exponent + (fault == 3 ? T(2) : T(1))));
    V3<T> wi = Frame<T>(wo).to_world(spherical(cosine, 2 * pi_v<T> * u.y));
    if (fault == 4) wi = {-wi.x, -wi.y, wi.z};
    if (fault == 1 && !(wi.z > 0)) return Sampled<T>{wi, 0, lobe(dot(wo, wi))};
    if (fault == 2 && !(wi.z > 0)) wi.z = -wi.z;
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    const T cosine = dot(wo, wi);
    return wo.z > 0 && wi.z > 0 && cosine > 0 ? lobe(cosine) : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    const T cosine = dot(wo, wi);
    if (!(wo.z > 0) || !(wi.z > 0) || cosine <= 0) return 0;
    return albedo * lobe(cosine) / std::max(wo.z, wi.z);
  }
  T lobe(T cosine) const { return (exponent + 1) / (2 * pi_v<T>)*std::pow(cosine, exponent); }
};

/// Dusty ground after Lommel and Seeliger. It draws from the caller's generator.
struct Regolith {
  double albedo = 0.6;
  int fault = 0;

  std::optional<Sampled<double>> sample(const V3<double>& wo, verify::Random& random) const {
    if (!(wo.z > 0)) return std::nullopt;
    const double u = random.uniform(), v = fault == 1 ? u : random.uniform();
    V3<double> wi = cosine_hemisphere(u, v);
    if (fault == 2) wi = spherical(std::max(wi.z, 0.1), std::atan2(wi.y, wi.x));
    const double q = pdf(wo, wi);
    return Sampled<double>{wi, eval(wo, wi) * wi.z / q, q};
  }
  double pdf(const V3<double>& wo, const V3<double>& wi) const {
    return wo.z > 0 && wi.z > 0 ? wi.z / pi_v<double> : 0;
  }
  double eval(const V3<double>& wo, const V3<double>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return albedo / (4 * pi_v<double>) / (fault == 3 ? wo.z + wo.z : wo.z + wi.z);
  }
};

}  // namespace plumbline::tests::corpus
