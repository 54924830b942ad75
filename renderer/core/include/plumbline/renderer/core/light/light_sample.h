#pragma once

#include <optional>
#include <type_traits>

#include <plumbline/renderer/core/math.h>

namespace plumbline::renderer {

/// One sampled direction towards a light: a point of a density, or an atom with probability mass.
/// Exactly one of `pdf_w` and `mass` is positive, so an atom that is taken for a density has none.
template <class T>
struct LightSample {
  Vec3<T> wi;   ///< unit, world space, from the reference point towards the light
  T distance;   ///< to the light [m]; infinity for an environment
  T cos_light;  ///< cosine at the light between its normal and −wi, > 0
  /// Emitted towards the reference point [W/(m² sr)]; of an atom the irradiance of a surface at the
  /// reference point that faces it [W/m²].
  Rgb<T> radiance;
  T pdf_w{0};  ///< [1/sr] at the reference point, the same value as pdf(ref, wi); 0 for an atom
  T mass{0};   ///< [1] with which the atom was chosen; 0 for a density

  bool is_atom() const { return mass > T(0); }
};

/// Turns a point sampled by area on a flat or curved one-sided emitter into a direction sample:
/// pdf_w = pdf_a · d²/cosθ_light.
///
/// @param to_light  from the reference point to the sampled point
/// @param normal    unit, of the emitting side there
/// @param pdf_a     [1/m²]
/// @return          nullopt where the reference point lies behind the emitter
template <class T>
std::optional<LightSample<T>> from_area_sample(const Vec3<T>& to_light, const Vec3<T>& normal,
                                               const T& pdf_a, const Rgb<T>& radiance) {
  using std::sqrt;
  const T distance_squared = length_squared(to_light);
  if (!(distance_squared > T(0))) return std::nullopt;
  const T distance = sqrt(distance_squared);
  const Vec3<T> wi = to_light / distance;
  const T cos_light = -dot(normal, wi);
  if (!(cos_light > T(0))) return std::nullopt;
  return LightSample<T>{wi, distance, cos_light, radiance, T(pdf_a * distance_squared / cos_light)};
}

/// A unit vector stored in float, of unit length in the precision of T: in float it has it to 2⁻²⁴
/// only, which is right for rendering.
template <class T>
Vec3<T> unit(const Vec3f& v) {
  if constexpr (std::is_same_v<T, float>) {
    return v;
  } else {
    return normalize(vec_cast<T>(v));
  }
}

/// The stored unit normal in the precision of T. Stored in float it is perpendicular to the edges
/// to 2⁻²⁴ only, which is right for rendering; in other scalars it is made anew from the edges, so
/// that the light is one consistent shape to the last digit.
template <class T>
Vec3<T> plane_normal(const Vec3f& normal, const Vec3f& edge_1, const Vec3f& edge_2) {
  if constexpr (std::is_same_v<T, float>) {
    return normal;
  } else {
    const Vec3<T> n = normalize(cross(vec_cast<T>(edge_1), vec_cast<T>(edge_2)));
    return dot(n, vec_cast<T>(normal)) > T(0) ? n : -n;
  }
}

/// Below this a light that is sampled by solid angle is sampled by area instead, which is as good:
/// so small a light hardly varies over its surface. The formulas keep six digits down to here.
inline constexpr double kSmallestSolidAngle = 1e-6;

/// Where the ray ref + t·wi meets the front of a plane.
template <class T>
struct PlaneHit {
  T distance, cos_light;
};

/// @return nullopt from behind, parallel to the plane, or for t ≤ 0
template <class T>
std::optional<PlaneHit<T>> hit_front_of_plane(const Vec3<T>& ref, const Vec3<T>& wi,
                                              const Vec3<T>& point, const Vec3<T>& normal) {
  const T cos_light = -dot(normal, wi);
  if (!(cos_light > T(0))) return std::nullopt;
  const T height = dot(normal, ref - point);
  if (!(height > T(0))) return std::nullopt;
  return PlaneHit<T>{T(height / cos_light), cos_light};
}

}  // namespace plumbline::renderer
