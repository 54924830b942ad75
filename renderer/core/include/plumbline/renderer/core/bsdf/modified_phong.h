#pragma once

#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_sample.h>
#include <plumbline/renderer/core/math.h>

namespace plumbline::renderer {

/// Phong lobe about the mirror direction, normalised so that at normal incidence the albedo is
/// `reflectance`; at other angles the part of the lobe below the horizon is lost. Black from
/// behind.
///
/// f = reflectance (n + 2)/(2π) cosⁿα, α between wi and the mirrored wo.
/// @source Lafortune, Willems 1994, "Using the modified Phong reflectance model for physically
///         based rendering", Section 3 (specular part)
struct ModifiedPhong {
  Rgbf reflectance;  ///< per channel, [0, 1]
  float exponent;    ///< n, 1 … 1e6

  static constexpr BsdfParts parts() { return {.density = true}; }

  /// @param wo, wi  unit vectors in the local frame, pointing away from the surface
  /// @return        f [1/sr], without the cosine; 0 unless both are above the horizon
  template <class T>
  Rgb<T> eval(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return evaluate(wo, wi).f;
  }

  template <class T>
  BsdfValue<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi) const {
    const T pdf_w = pdf(wo, wi);
    return {rgb_cast<T>(reflectance) * T((T(exponent) + T(2)) / (T(exponent) + T(1)) * pdf_w),
            pdf_w};
  }

  /// @param u  in [0, 1)²
  /// @return   wi with cosα = (1 − u.y)^(1/(n+1)); nullopt for wo from behind, or wi below the
  ///           horizon
  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec2<T>& u) const {
    if (!(wo.z > T(0))) return std::nullopt;
    const T log_cos = log_1_plus(T(-u.y)) / (T(exponent) + T(1));
    const T cos_minus_1 = exp_minus_1(log_cos), cos_alpha = T(1) + cos_minus_1;
    const T sin_alpha = safe_sqrt(T(-cos_minus_1 * (T(1) + cos_alpha)));
    const SinCos<T> phi = sin_cos_turns(u.x);
    const Vec3<T> wi =
        Frame<T>(mirror(wo)).to_world({T(sin_alpha * phi.cos), T(sin_alpha * phi.sin), cos_alpha});
    if (!(wi.z > T(0))) return std::nullopt;
    // f cosθi/pdf_w: the lobe cancels.
    const T scale = (T(exponent) + T(2)) / (T(exponent) + T(1));
    return density_sample(wi, rgb_cast<T>(reflectance) * T(scale * wi.z), density(log_cos));
  }

  /// @return pdf_w [1/sr] of `sample(wo, u)`: (n + 1)/(2π) cosⁿα above the horizon
  template <class T>
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
    if (!(wo.z > T(0) && wi.z > T(0))) return T(0);
    // By way of 1 − cosα = |wi − r|²/2 for unit vectors: a cosine in float is wrong by 6e-8, which
    // n = 1e6 would turn into 6 %.
    const T one_minus_cos = length_squared(wi - mirror(wo)) / T(2);
    if (!(one_minus_cos < T(1))) return T(0);  // behind the lobe, also where n is even
    return density(log_1_plus(T(-one_minus_cos)));
  }

 private:
  /// pdf_w by ln cosα.
  template <class T>
  T density(const T& log_cos) const {
    using std::exp;
    return (T(exponent) + T(1)) * (T(0.5) / pi<T>()) * exp(T(T(exponent) * log_cos));
  }
};

}  // namespace plumbline::renderer
