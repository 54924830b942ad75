#pragma once

#include <optional>

#include <plumbline/renderer/light/light_sample.h>

namespace plumbline::renderer {

/// One-sided rectangle origin + s·edge_u + t·edge_v, sampled uniformly by area.
struct RectangleLight {
  Vec3f origin, edge_u, edge_v;  ///< perpendicular edges [m]
  Vec3f normal;                  ///< unit, emitting side
  Rgbf radiance;

  template <class T>
  T area() const {
    return length(vec_cast<T>(edge_u)) * length(vec_cast<T>(edge_v));
  }

  /// @param ref  reference point, world space
  /// @param u    in [0, 1)²
  /// @return     nullopt where ref lies behind
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>& ref, const Vec2<T>& u) const {
    const Vec3<T> point =
        vec_cast<T>(origin) + vec_cast<T>(edge_u) * u.x + vec_cast<T>(edge_v) * u.y;
    return from_area_sample(point - ref, plane_normal<T>(normal, edge_u, edge_v),
                            T(T(1) / area<T>()), rgb_cast<T>(radiance));
  }

  /// @return pdf_w [1/sr] of `sample(ref, u)`; 0 where wi misses the front
  template <class T>
  T pdf(const Vec3<T>& ref, const Vec3<T>& wi) const {
    const auto hit =
        hit_front_of_plane(ref, wi, vec_cast<T>(origin), plane_normal<T>(normal, edge_u, edge_v));
    if (!hit) return T(0);
    const Vec3<T> p = ref + wi * hit->distance - vec_cast<T>(origin);
    const Vec3<T> eu = vec_cast<T>(edge_u), ev = vec_cast<T>(edge_v);
    const T s = dot(p, eu), t = dot(p, ev);
    if (!(s >= T(0) && s <= dot(eu, eu) && t >= T(0) && t <= dot(ev, ev))) return T(0);
    return sqr(hit->distance) / (hit->cos_light * area<T>());
  }
};

}  // namespace plumbline::renderer
