#pragma once

#include <plumbline/renderer/math.h>

/// Fresnel's equations for unpolarised light, written without differences that cancel.
namespace plumbline::renderer {

/// What an interface between two dielectrics does with light.
template <class T>
struct DielectricFresnel {
  T reflected, transmitted;  ///< shares of the power, sum 1
};

/// From the cosines on both sides, which say by themselves where total reflection starts.
///
/// @param cos_o  on the side that the light comes from, ≥ 0
/// @param g      η cosθt ≥ 0, with η = η_t/η_o; 0 where all is reflected
/// @param eta    η_t/η_o > 0
/// @source       Born, Wolf, Principles of Optics, Section 1.5.2, Eqs. 20–21a; with
///               g² − cos² = η² − 1 the differences r_s ∝ cos − g and r_p ∝ η² cos − g are products
template <class T>
DielectricFresnel<T> fresnel_dielectric(const T& cos_o, const T& g, const T& eta) {
  if (!(g > T(0))) return {T(1), T(0)};
  const T eta2 = sqr(eta);
  const T gap = (eta - T(1)) * (eta + T(1));
  const T s = T(1) / sqr(T(cos_o + g)), p = T(1) / sqr(T(eta2 * cos_o + g));
  const T r_s = gap * s;
  const T r_p = gap * ((eta2 + T(1)) * sqr(cos_o) - T(1)) * p;
  return {T((sqr(r_s) + sqr(r_p)) / T(2)), T(T(2) * cos_o * g * (s + eta2 * p))};
}

/// η cosθt by Snell's law; 0 where all is reflected. In double where T is float, because next to
/// the critical angle two numbers close to each other are subtracted.
template <class T>
T refracted_cosine(const T& cos_o, const T& eta) {
  const auto c = static_cast<Wide<T>>(cos_o), n = static_cast<Wide<T>>(eta);
  return static_cast<T>(safe_sqrt(Wide<T>((n - Wide<T>(1)) * (n + Wide<T>(1)) + c * c)));
}

template <class T>
DielectricFresnel<T> fresnel_dielectric(const T& cos_o, const T& eta) {
  return fresnel_dielectric(cos_o, refracted_cosine(cos_o, eta), eta);
}

/// Reflectance of a conductor in vacuum or air.
///
/// @param cos_o  in [0, 1]
/// @param eta    real part of the refractive index relative to the outside
/// @param k      imaginary part, ≥ 0
/// @source       Born, Wolf, Section 14.2, with η² − k² − sin² = a² − b², ηk = ab: the smaller of a
///               and b comes from their product, not from a difference
template <class T>
T fresnel_conductor(const T& cos_o, const T& eta, const T& k) {
  using std::sqrt;
  const T c2 = sqr(cos_o), s2 = T(1) - c2;
  const T product = eta * k;
  const T difference = (eta - k) * (eta + k) - s2;
  const T sum = sqrt(sqr(difference) + T(4) * sqr(product));  // a² + b²
  const T larger = sqrt((sum + (difference > T(0) ? difference : T(-difference))) / T(2));
  const T a = difference > T(0) ? larger : T(product / larger);
  const T s_sum = sum + c2, s_cross = T(2) * a * cos_o;
  const T r_s = (s_sum - s_cross) / (s_sum + s_cross);
  const T p_sum = c2 * sum + sqr(s2), p_cross = s_cross * s2;
  return r_s * (T(1) + (p_sum - p_cross) / (p_sum + p_cross)) / T(2);
}

/// Reflectance of a conductor per channel. The default is a mirror without loss, as Mitsuba's
/// `material` "none".
struct ConductorFresnel {
  Rgbf eta{0, 0, 0};  ///< index relative to the outside: η + ik
  Rgbf k{1, 1, 1};

  /// @param cos_o  in [0, 1]
  template <class T>
  Rgb<T> operator()(const T& cos_o) const {
    // η = 0 reflects everything at every angle: no light can enter, and nothing is to compute.
    if (eta == Rgbf{0, 0, 0}) return {T(1), T(1), T(1)};
    return {fresnel_conductor(cos_o, T(eta.r), T(k.r)), fresnel_conductor(cos_o, T(eta.g), T(k.g)),
            fresnel_conductor(cos_o, T(eta.b), T(k.b))};
  }
};

}  // namespace plumbline::renderer
