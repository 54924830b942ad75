#pragma once

#include "bsdf_ggx.h"
#include "bsdf_math.h"

/// Interfaces: atoms of smooth ones, alone and beside a diffuse part, and rough glass.
namespace plumbline::tests::corpus {

/// What pbrt calls a delta distribution: the pdf of the record is the probability.
template <class T>
struct DeltaRecord {
  V3<T> wi;
  T weight, pdf;
  bool is_delta;
};

/// Smooth glass: nothing but atoms.
template <class T>
struct SmoothGlass {
  T eta = T(1.5);
  bool radiance = true;  ///< a transmitted weight of 1/η², as radiance is scaled
  int fault = 0;

  DeltaRecord<T> sample(const V3<T>& wo, const P2<T>& u) const {
    const T e = wo.z > 0 || fault == 1 ? eta : 1 / eta;
    const T f = fresnel_dielectric(std::abs(wo.z), e);
    if (u.x < f) {
      return {{-wo.x, -wo.y, wo.z}, 1, fault == 2 ? T(1) : f, true};
    }
    const T cos_t = safe_sqrt(1 - (1 - wo.z * wo.z) / (e * e));
    const V3<T> wi{-wo.x / e, -wo.y / e, wo.z > 0 ? -cos_t : cos_t};
    const T scale = fault == 4 ? e * e : radiance ? 1 / (e * e) : T(1);
    return {wi, scale, fault == 2 ? T(1) : fault == 3 ? f : 1 - f, true};
  }
  T pdf(const V3<T>&, const V3<T>&) const { return 0; }
  T eval(const V3<T>&, const V3<T>&) const { return 0; }
};

/// A pane: what is not reflected, after any number of bounces inside, goes straight on.
struct ThinPane {
  double eta = 1.5;
  int fault = 0;

  struct Record {
    V3<double> wi;
    double weight, mass;
  };
  Record sample(const V3<double>& wo, double u, double) const {
    const double once = fresnel_dielectric(std::abs(wo.z), eta);
    const double r = once < 1 ? 2 * once / (1 + once) : 1;
    if (u < r) return {{-wo.x, -wo.y, wo.z}, 1, fault == 1 ? once : r};
    return {-wo, 1, fault == 1 ? 1 - once : 1 - r};
  }
  double pdf(const V3<double>&, const V3<double>&) const { return 0; }
  double eval(const V3<double>&, const V3<double>&) const { return 0; }
};

/// Smooth clear coat over diffuse: an atom and a density. What passes the coat twice is dimmed
/// twice.
template <class T>
struct SmoothCoat {
  T eta = T(1.5), albedo = T(0.6);
  bool two_sided = false;
  int fault = 0;

  /// Mean over directions of the reflectance from inside, of which the diffuse light is caught.
  ///
  /// @source d'Eon, Irving 2011, A quantized-diffusion model, appendix; 0.5963 at 1.5
  static constexpr T kInside = T(0.596);

  T fresnel(const V3<T>& w) const { return fresnel_dielectric(std::abs(w.z), eta); }
  T specular_probability(const V3<T>& wo) const {
    const T s = fresnel(wo), d = (1 - s) * albedo;
    return s / (s + d);
  }
  DeltaRecord<T> sample(const V3<T>& wo, const P2<T>& u) const {
    if (wo.z == 0 || (!two_sided && wo.z < 0)) return {wo, 0, 0, false};
    const T p = specular_probability(wo);
    if (u.x < p) return {{-wo.x, -wo.y, wo.z}, fresnel(wo) / p, fault == 4 ? T(1) : p, fault != 5};
    V3<T> wi = cosine_hemisphere(below_one((u.x - p) / (1 - p)), u.y);
    if (wo.z < 0) wi.z = -wi.z;
    const T q = pdf(wo, wi);
    return {wi, eval(wo, wi) * std::abs(wi.z) / q, q, false};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z * wi.z <= 0 || (!two_sided && wo.z < 0)) return 0;
    const T cosine = std::abs(wi.z) / pi_v<T>;
    if (fault == 1) return cosine;
    if (fault == 2) return specular_probability(wo) * cosine;
    return (1 - specular_probability(fault == 3 ? wi : wo)) * cosine;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z * wi.z <= 0 || (!two_sided && wo.z < 0)) return 0;
    if (fault == 6) return albedo / pi_v<T>;
    if (fault == 7) return (1 - fresnel(wo)) * albedo / pi_v<T>;
    const T trapped = 1 / (eta * eta) / (1 - albedo * kInside);
    return (1 - fresnel(wo)) * (1 - fresnel(wi)) * trapped * albedo / pi_v<T>;
  }
};

/// Rough glass by visible normals, radiance scaled by η² or not. Three numbers.
///
/// @source Walter et al. 2007, Eq. 16, 17, 20, 21
template <class T>
struct RoughGlass {
  Ggx<T> ggx;
  T eta = T(1.5);
  bool radiance = true;
  int fault = 0;

  T index_from(const V3<T>& wo) const { return wo.z > 0 ? eta : 1 / eta; }

  /// From the side of wo, which lies above then.
  ///
  /// @param e  index on the far side over that on the side of wo
  std::optional<V3<T>> half(const V3<T>& wo, const V3<T>& wi, T e) const {
    const V3<T> v = wi.z > 0 ? wo + wi : wo + e * wi;
    if (dot(v, v) == 0) return std::nullopt;
    V3<T> h = unit(v);
    if (h.z < 0) h = -h;
    if (dot(wo, h) <= 0 || dot(wi, h) * wi.z <= 0) return std::nullopt;
    return h;
  }
  static void turn(V3<T>& wo, V3<T>& wi) {
    if (wo.z < 0) wo.z = -wo.z, wi.z = -wi.z;
  }
  T refraction_jacobian(const V3<T>& wo, const V3<T>& wi, const V3<T>& h, T e) const {
    const T q = dot(wo, h) + e * dot(wi, h);
    if (fault == 1) return e * e / (q * q);
    if (fault == 2) return std::abs(dot(wi, h)) / (q * q);
    return e * e * std::abs(dot(wi, h)) / (q * q);
  }
  T reflect_probability(T f) const {
    if (fault == 3) return T(0.5);
    return fault == 4 ? 1 - f : f;
  }
  T pdf(V3<T> wo, V3<T> wi) const {
    if (wo.z == 0 || wi.z == 0) return 0;
    const T e = index_from(wo);
    turn(wo, wi);
    const auto h = half(wo, wi, e);
    if (!h) return 0;
    const T f = reflect_probability(fresnel_dielectric(dot(wo, *h), e));
    const T dh = ggx.visible(wo, *h);
    if (wi.z > 0) return (fault == 5 ? T(1) : f) * dh / (4 * dot(wo, *h));
    return (fault == 5 || fault == 6 ? T(1) : 1 - f) * dh * refraction_jacobian(wo, wi, *h, e);
  }
  T eval(V3<T> wo, V3<T> wi) const {
    if (wo.z == 0 || wi.z == 0) return 0;
    const T e = index_from(wo);
    turn(wo, wi);
    const auto h = half(wo, wi, e);
    if (!h) return 0;
    const T f = fresnel_dielectric(dot(wo, *h), e);
    const T g = ggx.g2(wo, wi);
    if (wi.z > 0) return f * ggx.d(*h) * g / (4 * wo.z * wi.z);
    const T q = dot(wo, *h) + e * dot(wi, *h);
    const T scale = fault == 7 ? e * e : fault == 8 ? 1 / (e * e) : radiance ? T(1) : e * e;
    const T through = fault == 9 ? T(1) : 1 - f;
    return through * scale * ggx.d(*h) * g * dot(wo, *h) * std::abs(dot(wi, *h)) /
           (wo.z * std::abs(wi.z) * q * q);
  }
  std::optional<Sampled<T>> sample(const V3<T>& given, T choice, T u, T v) const {
    if (given.z == 0) return std::nullopt;
    const T e = fault == 10 ? eta : index_from(given);
    const V3<T> wo{given.x, given.y, std::abs(given.z)};
    const V3<T> h = ggx.sample_caps(wo, u, v);
    const T c = dot(wo, h), f = fresnel_dielectric(c, e);
    V3<T> wi{};
    if (choice < f) {
      wi = mirrored_at(wo, h);
      if (wi.z <= 0) return std::nullopt;
    } else {
      const T cos_t = safe_sqrt(1 - (1 - c * c) / (e * e));
      wi = (c / e - cos_t) * h - (1 / e) * wo;
      if (wi.z >= 0) return std::nullopt;
    }
    if (given.z < 0) wi.z = -wi.z;
    const T q = pdf(given, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(given, wi) * std::abs(wi.z) / q, q};
  }
};

/// The same on two numbers, of which the first chooses and is used again.
template <class T>
struct RoughGlassOfTwo : RoughGlass<T> {
  int choice_fault = 0;

  /// The probability is the Fresnel reflectance of the surface itself, since the normal is not
  /// known when the lobe is chosen.
  T choose_reflection(const V3<T>& wo) const {
    const T f = fresnel_dielectric(std::abs(wo.z), this->index_from(wo));
    return std::clamp(f, T(0.1), T(0.9));
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (wo.z == 0) return std::nullopt;
    const T p = choose_reflection(wo);
    const bool reflected = u < p;
    const T again = below_one(reflected ? u / p : (u - p) / (1 - p));
    const T e = this->index_from(wo);
    const V3<T> up{wo.x, wo.y, std::abs(wo.z)};
    const V3<T> h = this->ggx.sample_caps(up, choice_fault == 1 ? u : again, v);
    V3<T> wi = mirrored_at(up, h);
    if (!reflected) {
      const T c = dot(up, h), sin2 = (1 - c * c) / (e * e);
      if (sin2 >= 1) return std::nullopt;
      wi = (c / e - std::sqrt(1 - sin2)) * h - (1 / e) * up;
    }
    if (wi.z == 0 || (wi.z > 0) != reflected) return std::nullopt;
    if (wo.z < 0) wi.z = -wi.z;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, this->eval(wo, wi) * std::abs(wi.z) / q, q};
  }
  T pdf(V3<T> wo, V3<T> wi) const {
    if (wo.z == 0 || wi.z == 0) return 0;
    const T e = this->index_from(wo);
    T p = choose_reflection(wo);
    if (choice_fault == 2) p = std::max(p, T(0.5));
    this->turn(wo, wi);
    const auto h = this->half(wo, wi, e);
    if (!h) return 0;
    if (choice_fault == 3) p = fresnel_dielectric(dot(wo, *h), e);
    const T dh = this->ggx.visible(wo, *h);
    if (wi.z > 0) return p * dh / (4 * dot(wo, *h));
    return (choice_fault == 2 ? T(0.9) : 1 - p) * dh * this->refraction_jacobian(wo, wi, *h, e);
  }
};

}  // namespace plumbline::tests::corpus
