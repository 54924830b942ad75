#pragma once

#include "bsdf_math.h"

/// Powers of a cosine: Phong around the mirror direction, Blinn and Ashikhmin–Shirley around the
/// half vector.
namespace plumbline::tests::corpus {

/// Diffuse and Phong; the lobe is chosen by the first number, which is used again. A direction
/// below the horizon comes back with a pdf of 0.
///
/// @source Lafortune, Willems 1994, Using the modified Phong reflectance model
template <class T>
struct Phong {
  T kd = T(0.4), ks = T(0.5), exponent = 30;
  int fault = 0;

  T diffuse_probability() const { return kd / (kd + ks); }
  V3<T> lobe_direction(const V3<T>& wo, T u, T v) const {
    const V3<T> mirror{-wo.x, -wo.y, wo.z};
    const T cosine = std::pow(1 - u, 1 / (exponent + 1));
    return Frame<T>(mirror).to_world(spherical(cosine, 2 * pi_v<T> * v));
  }
  Sampled<T> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return {wo, 0, 0};
    const T p = diffuse_probability();
    V3<T> wi{};
    if (u < p) {
      wi = cosine_hemisphere(below_one(u / p), v);
    } else {
      wi = lobe_direction(wo, fault == 1 ? u : below_one((u - p) / (1 - p)), v);
    }
    const T q = fault == 2 ? (u < p ? diffuse_pdf(wi) : lobe_pdf(wo, wi)) : pdf(wo, wi);
    if (!(wi.z > 0) || !(q > 0)) return {wi, 0, 0};
    return {wi, eval(wo, wi) * wi.z / q, q};
  }
  T diffuse_pdf(const V3<T>& wi) const { return std::max(T(0), wi.z) / pi_v<T>; }
  T lobe_pdf(const V3<T>& wo, const V3<T>& wi) const {
    const T cosine = std::max(T(0), wo.z * wi.z - wo.x * wi.x - wo.y * wi.y);
    return (exponent + (fault == 3 ? T(2) : T(1))) / (2 * pi_v<T>)*std::pow(cosine, exponent);
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T p = fault == 4 ? T(0.5) : diffuse_probability();
    if (fault == 5) return p * diffuse_pdf(wi) + lobe_pdf(wo, wi);
    return p * diffuse_pdf(wi) + (1 - p) * lobe_pdf(wo, wi);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T cosine = std::max(T(0), wo.z * wi.z - wo.x * wi.x - wo.y * wi.y);
    const T lobe = (exponent + 2) / (2 * pi_v<T>)*std::pow(cosine, exponent);
    return (fault == 6 ? kd : kd / pi_v<T>)+ks * lobe;
  }
};

/// Blinn's lobe: a power of cosθh.
template <class T>
struct Blinn {
  T exponent = 100, f0 = T(0.9);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> h = spherical(std::pow(1 - u.x, 1 / (exponent + 1)), 2 * pi_v<T> * u.y);
    const V3<T> wi = mirrored_at(wo, h);
    if (fault == 4 && dot(wo, h) > 0 && wi.z < 0) return sample(wo, {below_one(u.x / 2), u.y});
    if (!(wi.z > 0) || !(dot(wo, h) > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    const T pdf_h = (exponent + 1) / (2 * pi_v<T>)*std::pow(h.z, exponent);
    if (fault == 1) return pdf_h;
    if (fault == 2) return pdf_h / 4;
    return pdf_h / (4 * dot(fault == 3 ? V3<T>{0, 0, 1} : wo, h));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    const T d = (exponent + 2) / (2 * pi_v<T>)*std::pow(h.z, exponent);
    const T g = std::min({T(1), 2 * h.z * wo.z / dot(wo, h), 2 * h.z * wi.z / dot(wo, h)});
    return schlick(f0, dot(wo, h)) * d * g / (4 * wo.z * wi.z);
  }
};

/// Anisotropic, over a diffuse part that fades where the coat reflects.
///
/// @source Ashikhmin, Shirley 2000, An anisotropic Phong BRDF model, Eq. 4, 5, 6, 8, 9
template <class T>
struct AshikhminShirley {
  T nu = 10, nv = 100, rd = T(0.5), rs = T(0.2);
  int fault = 0;

  T half_density(const V3<T>& h, T n_x, T n_y) const {
    const T s2 = h.x * h.x + h.y * h.y;
    const T power = s2 > 0 ? (n_x * h.x * h.x + n_y * h.y * h.y) / s2 : T(0);
    return std::sqrt((n_x + 1) * (n_y + 1)) * std::pow(h.z, power);
  }
  T first_quadrant(T u) const {
    return std::atan(std::sqrt((nu + 1) / (nv + 1)) * std::tan(pi_v<T> / 2 * u));
  }
  V3<T> sample_half(T u, T v) const {
    T phi = 0;
    if (u < T(0.25)) {
      phi = first_quadrant(fault == 1 ? u : 4 * u);
    } else if (u < T(0.5)) {
      phi = pi_v<T> - first_quadrant(4 * (T(0.5) - u));
    } else if (u < T(0.75)) {
      phi = pi_v<T> + first_quadrant(4 * (u - T(0.5)));
    } else {
      phi = 2 * pi_v<T> - first_quadrant(4 * (1 - u));
    }
    const T c = std::cos(phi), s = std::sin(phi);
    return spherical(std::pow(1 - v, 1 / (nu * c * c + nv * s * s + 1)), phi);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    V3<T> wi{};
    if (u.x < T(0.5)) {
      wi = cosine_hemisphere(2 * u.x, u.y);
    } else {
      wi = mirrored_at(wo, sample_half(2 * (u.x - T(0.5)), u.y));
    }
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    const T d = fault == 2 ? half_density(h, nv, nu) : half_density(h, nu, nv);
    const T glossy = d / (2 * pi_v<T>) / (4 * dot(wo, h));
    return (wi.z / pi_v<T> + glossy) / (fault == 3 ? T(1) : T(2));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    const T fade_i = 1 - std::pow(1 - wi.z / 2, T(5)), fade_o = 1 - std::pow(1 - wo.z / 2, T(5));
    const T under = fault == 4 ? T(1) : 1 - rs;
    const T diffuse = 28 * rd / (23 * pi_v<T>)*under * fade_i * fade_o;
    const T fresnel = schlick(rs, dot(wo, h));
    return diffuse + half_density(h, nu, nv) / (8 * pi_v<T>)*fresnel /
                         (dot(wo, h) * std::max(wi.z, fault == 5 ? wi.z : wo.z));
  }
};

}  // namespace plumbline::tests::corpus
