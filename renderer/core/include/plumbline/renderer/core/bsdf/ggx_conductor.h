#pragma once

#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_sample.h>
#include <plumbline/renderer/core/bsdf/fresnel.h>
#include <plumbline/renderer/core/bsdf/ggx.h>

namespace plumbline::renderer {

/// Rough metal: single scattering between GGX microfacets. Black from behind, like Mitsuba's
/// `roughconductor` with the distribution `ggx`.
///
/// With F ≡ 1 its albedo is what the microsurface does not mask: 1 minus the light that a second
/// bounce would get, which this model loses.
struct GgxConductor {
  Ggx ggx;
  ConductorFresnel fresnel;

  static constexpr BsdfParts parts() { return {.density = true}; }

  /// @param wo, wi  unit vectors in the local frame, pointing away from the surface
  /// @return        f [1/sr], without the cosine; 0 unless both are above the horizon
  template <class T>
  Rgb<T> eval(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return evaluate(wo, wi).f;
  }

  template <class T>
  BsdfValue<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return evaluate_with(fresnel, wo, wi);
  }

  /// @param u  in [0, 1)²
  /// @return   nullopt for wo from behind, or wi below the horizon: light that is lost
  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec2<T>& u) const {
    return sample_with(fresnel, wo, u);
  }

  /// @return pdf_w [1/sr] of `sample(wo, u)`
  /// @source Heitz 2018 (JCGT 7:4), Eq. 3, with the half-vector Jacobian 1/(4 wo·h) of Walter et
  ///         al. 2007, Eq. 14: G1 (wo·h) D/cosθo /(4 wo·h), where G1/cosθo = 2/(cosθo + S)
  template <class T>
  [[gnu::always_inline]] T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
    if (!(wo.z > T(0) && wi.z > T(0))) return T(0);
    return ggx.density(wo + wi) * T(T(0.5) / ggx.visible_area(wo));
  }

  /// The same under another reflectance, a function of the cosine's square: what a film makes of
  /// it.
  ///
  /// @source Walter et al. 2007, Eq. 20: f = F D G/(4 cosθo cosθi) = F G1(wi)/cosθi pdf_w, where
  ///         Smith's G1/cosθ = 2/(cosθ + S) takes the cosine out, so that nothing is divided by one
  ///         near 0
  template <class T, class Reflectance>
  [[gnu::always_inline]] BsdfValue<T> evaluate_with(const Reflectance& reflectance,
                                                    const Vec3<T>& wo, const Vec3<T>& wi) const {
    if (!(wo.z > T(0) && wi.z > T(0))) return {};
    // wo·h = |wo + wi|/2 for unit vectors; the scalar product would cancel where wi → −wo.
    const T cos2 = std::min(T(length_squared(wo + wi) / T(4)), T(1)), pdf_w = pdf(wo, wi);
    return {reflectance(cos2) * T(pdf_w * (T(2) / ggx.visible_area(wi))), pdf_w};
  }

  template <class T, class Reflectance>
  std::optional<BsdfSample<T>> sample_with(const Reflectance& reflectance, const Vec3<T>& wo,
                                           const Vec2<T>& u) const {
    if (!(wo.z > T(0))) return std::nullopt;
    const auto visible = ggx.sample_visible(wo, u);
    const Vec3<T> wi = reflect(wo, visible);
    if (!(wi.z > T(0))) return std::nullopt;
    // f cosθi/pdf_w = F G1(wi): D, which may be huge, never enters. Heitz 2018, Eq. 19.
    const T cos2 = std::min(T(sqr(visible.cosine) / length_squared(visible.normal)), T(1));
    return density_sample(wi, reflectance(cos2) * ggx.masking(wi), pdf(wo, wi));
  }
};

}  // namespace plumbline::renderer
