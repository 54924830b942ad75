#pragma once

#include <optional>

#include <plumbline/renderer/core/light/light_sample.h>

namespace plumbline::renderer {

/// A point that emits alike in all directions. An atom: no other technique can find it, and it has
/// no density.
struct PointLight {
  Vec3f position;
  Rgbf intensity;  ///< [W/sr]

  /// @param ref  reference point, world space
  /// @return     an atom of mass 1; nullopt where ref is the light's own position
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>& ref, const Vec2<T>&) const {
    using std::sqrt;
    const Vec3<T> to_light = vec_cast<T>(position) - ref;
    const T distance_squared = length_squared(to_light);
    if (!(distance_squared > T(0))) return std::nullopt;
    const T distance = sqrt(distance_squared);
    return LightSample<T>{.wi = to_light / distance,
                          .distance = distance,
                          .cos_light = T(1),
                          .radiance = rgb_cast<T>(intensity) / distance_squared,
                          .mass = T(1)};
  }

  /// @return 0: an atom is no density
  template <class T>
  T pdf(const Vec3<T>&, const Vec3<T>&) const {
    return T(0);
  }
};

}  // namespace plumbline::renderer
