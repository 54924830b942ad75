#pragma once

#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_sample.h>
#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/sampling/warps.h>

namespace plumbline::renderer {

/// Perfectly diffuse reflection on the side of the normal; black from behind, like Mitsuba's
/// `diffuse`.
///
/// f = albedo/π: the cosine-weighted integral over the hemisphere is π, so the directional albedo
/// is `albedo` for every wo.
struct Lambertian {
  Rgbf albedo;  ///< per channel, [0, 1]

  static constexpr BsdfParts parts() { return {.density = true}; }

  /// @param wo, wi  unit vectors in the local frame, pointing away from the surface
  /// @return        f [1/sr], without the cosine; 0 unless both are above the horizon
  template <class T>
  Rgb<T> eval(const Vec3<T>& wo, const Vec3<T>& wi) const {
    if (!(wo.z > T(0) && wi.z > T(0))) return {};
    return rgb_cast<T>(albedo) * T(T(1) / pi<T>());
  }

  /// @param u  in [0, 1)²
  /// @return   wi cosine-distributed; nullopt for wo at or below the horizon, or wi on it
  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec2<T>& u) const {
    const Vec3<T> wi = square_to_cosine_hemisphere(u);
    if (!(wo.z > T(0) && wi.z > T(0))) return std::nullopt;
    // f cosθ / pdf_w = (albedo/π) cosθ / (cosθ/π): the cosine never enters, so nothing is lost at
    // grazing.
    return density_sample(wi, rgb_cast<T>(albedo), pdf(wo, wi));
  }

  /// @return pdf_w [1/sr] of `sample(wo, u)`
  template <class T>
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return wo.z > T(0) ? square_to_cosine_hemisphere_pdf_w(wi) : T(0);
  }
};

}  // namespace plumbline::renderer
