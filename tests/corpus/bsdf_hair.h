#pragma once

#include <array>

#include "bsdf_math.h"

/// Fibres: lobes over the whole sphere around a hair that lies along x.
namespace plumbline::tests::corpus {

/// Reflection, transmission and one inner bounce, and what is left over, each a longitudinal lobe
/// times an azimuthal one. eval divides by |cosθ| with the surface's normal, as code that was
/// written for curves and hangs off a surface's interface does.
///
/// @source Marschner et al. 2003; d'Eon et al. 2011, Eq. 7; Chiang et al. 2016 (azimuthal logistic)
template <class T>
struct Hair {
  T offset = T(0.3);  ///< across the fibre, −1 … 1
  T longitudinal = T(0.15), azimuthal = T(0.8), eta = T(1.55);
  std::array<T, 4> strength{T(0.1), T(0.45), T(0.2), T(0.15)};
  int fault = 0;

  struct Record {
    V3<T> wi;
    T f, pdf;
  };

  /// Longitudinal: over sinθ, a von Mises–Fisher lobe around the opposite cone.
  T longitudinal_pdf(T sin_i, T sin_o, T v) const {
    const T a = safe_sqrt(1 - sin_i * sin_i) * safe_sqrt(1 - sin_o * sin_o) / v;
    const T b = sin_i * sin_o / v;
    // log(1/sinh(1/v)) without overflow
    const T log_sinh = 1 / v + std::log1p(-std::exp(-2 / v)) - std::log(T(2));
    return std::exp(log_i0(a) - b - log_sinh - std::log(2 * v));
  }
  static T log_i0(T x) {
    if (x > 20) {
      const T y = 1 / (8 * x);
      return x - std::log(2 * pi_v<T> * x) / 2 +
             std::log1p(y * (1 + y * (T(4.5) + y * (T(37.5) + y * T(459.375)))));
    }
    T term = 1, sum = 1;
    for (int k = 1; k < 60; ++k) {
      term *= sqr(x / (2 * T(k)));
      sum += term;
    }
    return std::log(sum);
  }
  T sample_longitudinal(T sin_o, T v, T u1, T u2) const {
    const T cosine = 1 + v * std::log(std::max(u1, T(1e-7)) + (1 - u1) * std::exp(-2 / v));
    const T sine = safe_sqrt(1 - cosine * cosine);
    const T cos_o = safe_sqrt(1 - sin_o * sin_o);
    return -cosine * sin_o + sine * std::cos(2 * pi_v<T> * u2) * cos_o;
  }

  /// Where light of lobe p leaves, about the fibre, over where it came in.
  T exit_azimuth(std::size_t p) const {
    const T gamma_o = std::asin(offset), gamma_t = std::asin(offset / eta);
    return 2 * T(p) * gamma_t - 2 * gamma_o + T(p) * pi_v<T>;
  }
  T logistic_cdf(T x) const { return 1 / (1 + std::exp(-x / azimuthal)); }
  T azimuthal_pdf(T phi, std::size_t p) const {
    T x = phi - exit_azimuth(p);
    x -= 2 * pi_v<T> * std::floor((x + pi_v<T>) / (2 * pi_v<T>));
    const T e = std::exp(-std::abs(x) / azimuthal);
    const T density = e / (azimuthal * sqr(1 + e));
    const T inside = logistic_cdf(pi_v<T>) - logistic_cdf(-pi_v<T>);
    return fault == 1 ? density : density / inside;
  }
  T sample_azimuthal(std::size_t p, T u) const {
    const T low = logistic_cdf(-pi_v<T>), k = low + u * (logistic_cdf(pi_v<T>) - low);
    const T x = std::clamp(-azimuthal * std::log(1 / k - 1), -pi_v<T>, pi_v<T>);
    return exit_azimuth(p) + (fault == 2 ? -x + T(0.3) : x);
  }
  T width(std::size_t p) const {
    const T v = sqr(longitudinal);
    return p == 0 ? v : p == 1 ? v / 4 : 4 * v;
  }
  T probability(std::size_t p) const {
    return strength[p] / (strength[0] + strength[1] + strength[2] + strength[3]);
  }

  std::optional<Record> sample(const V3<T>& wo, const P3<T>& u) const {
    std::size_t p = 0;
    T below = 0;
    while (p < 3 && u.x >= below + probability(p)) below += probability(p++);
    const T again = below_one((u.x - below) / probability(p));
    const T sin_i = sample_longitudinal(wo.x, width(p), u.y, u.z);
    const T cos_i = safe_sqrt(1 - sin_i * sin_i);
    T phi = p < 3 ? sample_azimuthal(p, fault == 3 ? u.x : again) : 2 * pi_v<T> * again;
    phi += std::atan2(wo.z, wo.y);
    const V3<T> wi{sin_i, cos_i * std::cos(phi), cos_i * std::sin(phi)};
    return Record{wi, eval(wo, wi), pdf(wo, wi)};
  }
  T lobe(const V3<T>& wo, const V3<T>& wi, std::size_t p) const {
    const T phi = std::atan2(wi.z, wi.y) - std::atan2(wo.z, wo.y);
    T m = longitudinal_pdf(wi.x, wo.x, fault == 4 ? longitudinal : width(p));
    if (fault == 5) m /= std::max(T(1e-4), safe_sqrt(1 - wi.x * wi.x));
    return m * (p < 3 ? azimuthal_pdf(fault == 6 ? -phi : phi, p) : 1 / (2 * pi_v<T>));
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    T sum = 0;
    for (std::size_t p = 0; p < 4; ++p) {
      const T share = fault == 7 ? T(0.25) : probability(p);
      sum += (fault == 8 && p == 3 ? T(0) : share) * lobe(wo, wi, p);
    }
    return sum;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    Hair right = *this;
    right.fault = 0;
    T sum = 0;
    for (std::size_t p = 0; p < 4; ++p) sum += strength[p] * right.lobe(wo, wi, p);
    return std::abs(wi.z) > 0 ? sum / std::abs(wi.z) : T(0);
  }
};

}  // namespace plumbline::tests::corpus
