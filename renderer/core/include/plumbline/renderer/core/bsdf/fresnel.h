#pragma once

#include <plumbline/renderer/core/bsdf/reflectance_table.h>
#include <plumbline/renderer/core/math.h>

/// Fresnel's equations for unpolarised light, written without differences that cancel.
namespace plumbline::renderer {

/// η_t/η_o, wide because critical angles hang on its last digits.
///
/// @param eta           index inside (z < 0) over index outside
/// @param from_outside  whether wo is outside
template <class T>
Wide<T> relative_index(float eta, bool from_outside) {
  const auto inside = static_cast<Wide<T>>(eta);
  return from_outside ? inside : Wide<T>(Wide<T>(1) / inside);
}

/// What an interface does with the power that falls on it. `S` is a scalar, or an Rgb<T> where the
/// channels differ.
template <class S>
struct PowerSplit {
  S reflected, transmitted;  ///< sum 1, each ≥ 0 and with relative precision of its own
};

/// η cosθt by Snell's law; 0 where all is reflected.
///
/// @param cos_o  on the side that the light comes from, of either sign
/// @param eta    η_t/η_o > 0
template <class T>
T refracted_cosine(const T& cos_o, const T& eta) {
  return safe_sqrt(T((eta - T(1)) * (eta + T(1)) + sqr(cos_o)));
}

/// The square of the cosine on the thinner side of an interface. What is lossless splits light
/// alike from both sides, and from the thinner one no angle is critical.
///
/// @param eta, cos2_o, from_outside  as for BareInterface::split
/// @return                           ≤ 0 where all is reflected
template <class T>
[[gnu::always_inline]] inline T thin_cosine_squared(float eta, const Wide<T>& cos2_o,
                                                    bool from_outside) {
  using W = Wide<T>;
  if (from_outside == (eta > 1)) return static_cast<T>(cos2_o);
  const W ratio = relative_index<T>(eta, eta > 1);
  return static_cast<T>(sqr(ratio) * cos2_o - (ratio - W(1)) * (ratio + W(1)));
}

/// Fresnel's equations where two dielectrics meet, seen from the thinner one: nothing cancels.
///
/// @param cos2_o  square of the cosine on the thinner side, in [0, 1]
/// @param eta     index of the denser over the thinner, ≥ 1
/// @param gap     η² − 1, which cannot be had from a rounded η
/// @source        Born, Wolf, Principles of Optics, Section 1.5.2, Eqs. 20–21a; with g = η cosθt,
///                g² − cos² = η² − 1 turns cos − g and η² cos − g into products
template <class T>
[[gnu::always_inline]] inline PowerSplit<T> fresnel_dielectric(const T& cos2_o, const T& eta,
                                                               const T& gap) {
  const T cos_o = safe_sqrt(cos2_o), g = safe_sqrt(T(gap + cos2_o));
  const T eta2 = sqr(eta);
  const T sum_s = cos_o + g, sum_p = eta2 * cos_o + g, scale = T(1) / (sum_s * sum_p);
  const T s = sqr(T(sum_p * scale)), p = sqr(T(sum_s * scale));
  const T r_s = gap * s;
  const T r_p = gap * ((eta2 + T(1)) * cos2_o - T(1)) * p;
  // Rounding can exceed 1 along the surface.
  return {std::min(T((sqr(r_s) + sqr(r_p)) / T(2)), T(1)), T(T(2) * cos_o * g * (s + eta2 * p))};
}

/// The bare interface of a dielectric, in the form that a film can take the place of.
struct BareInterface {
  float eta;  ///< index inside (z < 0) over index outside

  /// @param cos2_o        square of the cosine on the side of wo, in [0, 1]; wide, because next to
  ///                      the critical angle close numbers are subtracted
  /// @param from_outside  whether wo is outside
  template <class T>
  [[gnu::always_inline]] PowerSplit<T> split(const Wide<T>& cos2_o, bool from_outside) const {
    using W = Wide<T>;
    if (eta == 1) return {T(0), T(1)};  // also along the surface, where the formula is 0/0
    const T thin = thin_cosine_squared<T>(eta, cos2_o, from_outside);
    if (!(thin > T(0))) return {T(1), T(0)};
    const W ratio = relative_index<T>(eta, eta > 1), gap = (ratio - W(1)) * (ratio + W(1));
    return fresnel_dielectric(thin, static_cast<T>(ratio), static_cast<T>(gap));
  }
};

/// A complex number over any scalar; std::complex is for built-in ones only.
template <class T>
struct Complex {
  T re, im;

  friend Complex operator*(const Complex& a, const Complex& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend Complex operator+(const Complex& a, const Complex& b) {
    return {a.re + b.re, a.im + b.im};
  }
  friend Complex operator*(const Complex& a, const T& s) { return {a.re * s, a.im * s}; }
};

template <class T>
T square_of_modulus(const Complex<T>& a) {
  return sqr(a.re) + sqr(a.im);
}

/// (η + ik) cosθt in an absorbing medium.
///
/// The smaller of both parts comes from the product of them, not from a difference.
/// @param cos_o  in [0, 1]
/// @param eta    real part of the index relative to the side that the light comes from
/// @param k      imaginary part, ≥ 0
template <class T>
Complex<T> refracted_cosine(const T& cos_o, const T& eta, const T& k) {
  using std::sqrt;
  const T product = eta * k;
  const T difference = (eta - k) * (eta + k) - (T(1) - sqr(cos_o));
  const T magnitude = difference > T(0) ? difference : T(-difference);
  const T larger = sqrt((sqrt(sqr(difference) + T(4) * sqr(product)) + magnitude) / T(2));
  const T smaller = larger > T(0) ? T(product / larger) : T(0);
  return difference > T(0) ? Complex<T>{larger, smaller} : Complex<T>{smaller, larger};
}

/// Reflectance of a conductor.
///
/// @param cos_o, eta, k  as for refracted_cosine
/// @source               Born, Wolf, Section 14.2
template <class T>
T fresnel_conductor(const T& cos_o, const T& eta, const T& k) {
  const Complex<T> g = refracted_cosine(cos_o, eta, k);
  const T c2 = sqr(cos_o), s2 = T(1) - c2;
  const T g2 = square_of_modulus(g);
  const T s_sum = g2 + c2, s_cross = T(2) * g.re * cos_o;
  const T r_s = (s_sum - s_cross) / (s_sum + s_cross);
  const T p_sum = c2 * g2 + sqr(s2), p_cross = s_cross * s2;
  return r_s * (T(1) + (p_sum - p_cross) / (p_sum + p_cross)) / T(2);
}

/// Reflectance of a conductor per channel. The default is a mirror without loss, as Mitsuba's
/// `material` "none".
class ConductorFresnel {
 public:
  ConductorFresnel() = default;

  /// @param eta, k  per channel, η + ik the index relative to the outside; η = 0 in all channels
  ///                reflects everything at every angle, for no light can enter
  ConductorFresnel(const Rgbf& eta, const Rgbf& k) : eta_(eta), k_(k) {
    if (!is_black(eta)) table_ = ReflectanceTable([this](double c) { return by_formula(c); });
  }

  const Rgbf& eta() const { return eta_; }
  const Rgbf& k() const { return k_; }
  bool tabulated() const { return !table_.empty(); }  ///< what floats take, in place of the formula

  /// @param cos2_o  square of the cosine, in [0, 1]
  template <class T>
  [[gnu::always_inline]] Rgb<T> operator()(const T& cos2_o) const {
    if constexpr (std::is_same_v<T, float>) {
      if (!table_.empty()) return table_(safe_sqrt(cos2_o));
    }
    if (is_black(eta_)) return {T(1), T(1), T(1)};
    return by_formula(safe_sqrt(cos2_o));
  }

 private:
  template <class T>
  Rgb<T> by_formula(const T& cos_o) const {
    return {fresnel_conductor(cos_o, T(eta_.r), T(k_.r)),
            fresnel_conductor(cos_o, T(eta_.g), T(k_.g)),
            fresnel_conductor(cos_o, T(eta_.b), T(k_.b))};
  }

  Rgbf eta_{0, 0, 0}, k_{1, 1, 1};
  ReflectanceTable table_;
};

}  // namespace plumbline::renderer
