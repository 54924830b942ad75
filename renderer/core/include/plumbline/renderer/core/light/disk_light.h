#pragma once

#include <optional>

#include <plumbline/renderer/core/light/light_sample.h>
#include <plumbline/renderer/core/sampling/warps.h>

namespace plumbline::renderer {

/// One-sided disk, sampled uniformly by area.
struct DiskLight {
  Vec3f center;
  Vec3f normal;  ///< unit, emitting side
  float radius;  ///< [m]
  Rgbf radiance;

  template <class T>
  T area() const {
    return pi<T>() * sqr(T(radius));
  }

  /// @param ref  reference point, world space
  /// @param u    in [0, 1)²
  /// @return     nullopt where ref lies behind
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>& ref, const Vec2<T>& u) const {
    const Vec3<T> n = unit<T>(normal);
    const Vec2<T> d = square_to_uniform_disk(u);
    const Vec3<T> offset = Frame<T>(n).to_world({T(d.x * T(radius)), T(d.y * T(radius)), T(0)});
    return from_area_sample(vec_cast<T>(center) + offset - ref, n, T(T(1) / area<T>()),
                            rgb_cast<T>(radiance));
  }

  /// @return pdf_w [1/sr] of `sample(ref, u)`; 0 where wi misses the front
  template <class T>
  T pdf(const Vec3<T>& ref, const Vec3<T>& wi) const {
    const auto hit = hit_front_of_plane(ref, wi, vec_cast<T>(center), unit<T>(normal));
    if (!hit) return T(0);
    const Vec3<T> p = ref + wi * hit->distance - vec_cast<T>(center);
    return length_squared(p) <= sqr(T(radius)) ? pdf_at(*hit) : T(0);
  }

  /// @return the same where a ray along wi is known to end on the light. At its edge rounding can
  ///         say otherwise here, and a hit without a density would not be weighted down at all.
  template <class T>
  T pdf_at_hit(const Vec3<T>& ref, const Vec3<T>& wi) const {
    const auto hit = hit_front_of_plane(ref, wi, vec_cast<T>(center), unit<T>(normal));
    return hit ? pdf_at(*hit) : T(0);
  }

 private:
  template <class T>
  T pdf_at(const PlaneHit<T>& hit) const {
    return sqr(hit.distance) / (hit.cos_light * area<T>());
  }
};

}  // namespace plumbline::renderer
