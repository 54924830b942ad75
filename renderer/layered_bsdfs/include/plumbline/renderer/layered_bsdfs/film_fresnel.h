#pragma once

#include <array>

#include <plumbline/renderer/core/bsdf/fresnel.h>

/// Reflectance of a thin film on a base, averaged over the band of wavelengths that a colour
/// channel stands for.
///
/// With r12 at the top of the film, r23 at its bottom and the phase φ = 4π d g/λ (g = η_film
/// cosθ_film), Airy's sum over all bounces in the film is
///
///   r = (r12 + r23 e^iφ)/(1 + z e^iφ),  z = r12 r23,  so that, for real r12 and ρ = |r23|,
///   1 − |r|² = (1 − r12²)(1 − ρ²)/|1 + z e^iφ|².
///
/// |z| < 1, so the mean of 1/|1 + z e^iφ|² over φ in [a, b] has a closed form that needs no
/// unwrapping (the antiderivative of Poisson's kernel):
///
///   (1 − 2 (arg(1 + z e^ib) − arg(1 + z e^ia))/(b − a)) / (1 − |z|²).
///
/// @source Born, Wolf, Principles of Optics, Section 1.6.4, Eq. 57 (the sum); the mean is ours
namespace plumbline::renderer {

/// Wavelengths [nm] between which the channels lie: red, green, blue. Within a channel every
/// wavenumber 1/λ counts the same.
inline constexpr std::array<float, 4> kBandEdges{700, 590, 490, 400};

/// Optically no thinner than both of its neighbours: between denser ones light would tunnel, which
/// this is not a model of.
struct FilmLayer {
  float thickness;  ///< [nm], times the index outside; ≥ 0
  float eta;        ///< index over the index outside
};

namespace film_detail {

/// r = (X − Y)/(X + Y) between two media, and 1 − |r|² without cancellation.
template <class T>
struct Step {
  Complex<T> r;
  T lost;
};

template <class T>
Step<T> step(const Complex<T>& x, const Complex<T>& y) {
  const T scale = T(1) / square_of_modulus(x + y);
  const T real_part = x.re * y.re + x.im * y.im, imaginary_part = x.im * y.re - x.re * y.im;
  return {
      {T((square_of_modulus(x) - square_of_modulus(y)) * scale), T(T(2) * imaginary_part * scale)},
      T(T(4) * real_part * scale)};
}

/// Phase over a band: its middle and half its width.
template <class T>
struct BandPhase {
  SinCos<T> middle, half;
  T half_angle;
};

/// @param path  2 d g [nm]
template <class T>
BandPhase<T> band_phase(const T& path, std::size_t channel) {
  using std::floor;
  const T low = T(1) / T(kBandEdges[channel]), high = T(1) / T(kBandEdges[channel + 1]);
  const T middle = path * (low + high) / T(2), half = path * (high - low) / T(2);
  return {sin_cos_turns(T(middle - floor(middle))), sin_cos_turns(T(half - floor(half))),
          T(T(2) * pi<T>() * half)};
}

/// Share of the power, in one polarisation, that a band does not reflect.
template <class T>
T mean_transmittance(const Step<T>& top, const Step<T>& bottom, const BandPhase<T>& phase) {
  using std::atan2;
  const Complex<T> z = top.r * bottom.r;
  const T z2 = square_of_modulus(z);
  const T real_part = z.re * phase.middle.cos - z.im * phase.middle.sin;
  // Both arguments lie within ±π/2, so their difference is the principal argument of the quotient.
  const T across = T(2) * (real_part + z2 * phase.half.cos);
  const T along =
      T(1) + T(2) * real_part * phase.half.cos + z2 * (sqr(phase.half.cos) - sqr(phase.half.sin));
  const T turned = phase.half_angle > T(0)
                       ? T(atan2(T(across * phase.half.sin), along) / phase.half_angle)
                       : T(across / along);
  // 1 − |z|² from the losses, because |z| → 1 at grazing.
  return top.lost * bottom.lost / (top.lost + bottom.lost - top.lost * bottom.lost) *
         (T(1) - turned);
}

/// The film as one direction meets it: what all channels share.
template <class T>
struct FilmView {
  T cosine;  // film: η cosθ
  Step<T> top_s, top_p;
  T path;
  T eta2;

  /// @param cos_o  outside
  FilmView(const FilmLayer& film, const T& cos_o, const T& film_cosine)
      : cosine(film_cosine),
        top_s(step<T>({cos_o, T(0)}, {film_cosine, T(0)})),
        top_p(step<T>({T(sqr(T(film.eta)) * cos_o), T(0)}, {film_cosine, T(0)})),
        path(T(2) * T(film.thickness) * film_cosine),
        eta2(sqr(T(film.eta))) {}

  /// @param base_square  square of the base's index
  /// @param base_cosine  index times cosine in the base
  T transmittance(const Complex<T>& base_square, const Complex<T>& base_cosine,
                  std::size_t channel) const {
    const BandPhase<T> phase = band_phase(path, channel);
    const T s = mean_transmittance(top_s, step({cosine, T(0)}, base_cosine), phase);
    const T p = mean_transmittance(top_p, step(base_square * cosine, base_cosine * eta2), phase);
    return (s + p) / T(2);
  }
};

}  // namespace film_detail

/// In the place of ConductorFresnel.
class FilmOnConductor {
 public:
  FilmOnConductor(const FilmLayer& film, const ConductorFresnel& base)
      : film_(film), eta_(base.eta()), k_(base.k()) {
    table_ = ReflectanceTable([this](double c) { return by_formula(c); });
  }

  /// @param cos2_o  square of the cosine, in [0, 1]
  template <class T>
  [[gnu::always_inline]] Rgb<T> operator()(const T& cos2_o) const {
    if constexpr (std::is_same_v<T, float>) {
      if (!table_.empty()) return table_(safe_sqrt(cos2_o));
    }
    return by_formula(safe_sqrt(cos2_o));
  }

 private:
  template <class T>
  Rgb<T> by_formula(const T& cos_o) const {
    const auto film_cosine =
        refracted_cosine(static_cast<Wide<T>>(cos_o), static_cast<Wide<T>>(film_.eta));
    if (!(film_cosine > Wide<T>(0))) return {T(1), T(1), T(1)};
    const film_detail::FilmView<T> view(film_, cos_o, static_cast<T>(film_cosine));
    const auto reflected = [&](float eta, float k, std::size_t channel) {
      const T n = T(eta), m = T(k);
      return T(T(1) - view.transmittance({T((n - m) * (n + m)), T(T(2) * n * m)},
                                         refracted_cosine(cos_o, n, m), channel));
    };
    return {reflected(eta_.r, k_.r, 0), reflected(eta_.g, k_.g, 1), reflected(eta_.b, k_.b, 2)};
  }

  FilmLayer film_;
  Rgbf eta_, k_;
  ReflectanceTable table_;
};

/// In the place of BareInterface.
class FilmOnDielectric {
 public:
  /// @param eta  of the base over the outside
  FilmOnDielectric(const FilmLayer& film, float eta) : film_(film), eta_(eta) {
    const auto split_at = [this](double cosine) { return by_formula<double>(cosine); };
    reflected_ = ReflectanceTable([&](double c) { return split_at(c).reflected; });
    transmitted_ = ReflectanceTable([&](double c) { return split_at(c).transmitted; });
    tabulated_ = !reflected_.empty() && !transmitted_.empty();
  }

  bool tabulated() const { return tabulated_; }  ///< what floats take, in place of the formula

  /// @param cos2_o, from_outside  as for BareInterface::split
  template <class T>
  [[gnu::always_inline]] PowerSplit<Rgb<T>> split(const Wide<T>& cos2_o, bool from_outside) const {
    const T cosine = safe_sqrt(thin_cosine_squared<T>(eta_, cos2_o, from_outside));
    if constexpr (std::is_same_v<T, float>) {
      if (tabulated_) {
        return {reflected_(cosine), transmitted_(cosine)};
      }
    }
    return by_formula<T>(static_cast<Wide<T>>(cosine));
  }

 private:
  /// @param thin  cosine in the thinner one of outside and base
  template <class T>
  PowerSplit<Rgb<T>> by_formula(const Wide<T>& thin) const {
    using W = Wide<T>;
    const W across = refracted_cosine(thin, relative_index<T>(eta_, eta_ > 1));
    const W outside = eta_ > 1 ? thin : W(across * static_cast<W>(eta_));
    const W inside = eta_ > 1 ? across : W(thin * static_cast<W>(eta_));
    const W in_film = refracted_cosine(outside, static_cast<W>(film_.eta));
    if (!(thin > W(0) && in_film > W(0))) return {{T(1), T(1), T(1)}, {T(0), T(0), T(0)}};
    const film_detail::FilmView<T> view(film_, static_cast<T>(outside), static_cast<T>(in_film));
    const Complex<T> square{sqr(T(eta_)), T(0)}, cosine{static_cast<T>(inside), T(0)};
    const Rgb<T> t{view.transmittance(square, cosine, 0), view.transmittance(square, cosine, 1),
                   view.transmittance(square, cosine, 2)};
    return {{T(T(1) - t.r), T(T(1) - t.g), T(T(1) - t.b)}, t};
  }

  FilmLayer film_;
  float eta_;
  ReflectanceTable reflected_, transmitted_;
  bool tabulated_;
};

}  // namespace plumbline::renderer
