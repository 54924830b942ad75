#pragma once

#include <optional>

#include <plumbline/renderer/light/light_sample.h>
#include <plumbline/renderer/light/spherical_rectangle.h>

namespace plumbline::renderer {

/// Rectangle origin + s·edge_u + t·edge_v, sampled uniformly by area, or by the solid angle that it
/// subtends.
struct RectangleLight {
  Vec3f origin, edge_u, edge_v;  ///< perpendicular edges [m]
  Vec3f normal;                  ///< unit, of the emitting side
  Rgbf radiance;
  bool by_solid_angle = false;
  bool two_sided = false;  ///< the other side emits alike

  template <class T>
  T area() const {
    return length(vec_cast<T>(edge_u)) * length(vec_cast<T>(edge_v));
  }

  /// @param ref  reference point, world space
  /// @param u    in [0, 1)²
  /// @return     nullopt where ref sees no emitting side
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>& ref, const Vec2<T>& u) const {
    if (by_solid_angle) {
      const SphericalRectangle<Wide<T>> seen = seen_from(ref);
      if (!(seen.height() > Wide<T>(0))) return std::nullopt;
      if (large_enough(seen)) return sample_solid_angle(seen, u);
    }
    const Vec3<T> point =
        vec_cast<T>(origin) + vec_cast<T>(edge_u) * u.x + vec_cast<T>(edge_v) * u.y;
    return from_area_sample(point - ref, normal_of_side(ref), T(T(1) / area<T>()),
                            rgb_cast<T>(radiance));
  }

  /// @return pdf_w [1/sr] of `sample(ref, u)`; 0 where wi misses or meets a dark side
  template <class T>
  T pdf(const Vec3<T>& ref, const Vec3<T>& wi) const {
    const auto hit = hit_front_of_plane(ref, wi, vec_cast<T>(origin), normal_of_side(ref));
    if (!hit) return T(0);
    const Vec3<T> p = ref + wi * hit->distance - vec_cast<T>(origin);
    const Vec3<T> eu = vec_cast<T>(edge_u), ev = vec_cast<T>(edge_v);
    const T s = dot(p, eu), t = dot(p, ev);
    if (!(s >= T(0) && s <= dot(eu, eu) && t >= T(0) && t <= dot(ev, ev))) return T(0);
    if (by_solid_angle) {
      const SphericalRectangle<Wide<T>> seen = seen_from(ref);
      if (large_enough(seen)) return static_cast<T>(Wide<T>(1) / seen.solid_angle());
    }
    return sqr(hit->distance) / (hit->cos_light * area<T>());
  }

 private:
  /// Unit normal of the side that emits towards ref, if one does.
  template <class T>
  Vec3<T> normal_of_side(const Vec3<T>& ref) const {
    const Vec3<T> n = plane_normal<T>(normal, edge_u, edge_v);
    return two_sided && dot(n, ref - vec_cast<T>(origin)) < T(0) ? -n : n;
  }

  template <class T>
  SphericalRectangle<Wide<T>> seen_from(const Vec3<T>& ref) const {
    using W = Wide<T>;
    return {vec_cast<W>(origin) - vec_cast<W>(ref), vec_cast<W>(edge_u), vec_cast<W>(edge_v),
            normal_of_side(vec_cast<W>(ref))};
  }

  template <class W>
  static bool large_enough(const SphericalRectangle<W>& seen) {
    return seen.solid_angle() >= W(kSmallestSolidAngle);
  }

  template <class T>
  LightSample<T> sample_solid_angle(const SphericalRectangle<Wide<T>>& seen,
                                    const Vec2<T>& u) const {
    using W = Wide<T>;
    const Vec3<W> to_light = seen.sample({static_cast<W>(u.x), static_cast<W>(u.y)});
    const W distance = length(to_light);
    return {.wi = vec_cast<T>(to_light / distance),
            .distance = static_cast<T>(distance),
            .cos_light = static_cast<T>(seen.height() / distance),
            .radiance = rgb_cast<T>(radiance),
            .pdf_w = static_cast<T>(W(1) / seen.solid_angle())};
  }
};

}  // namespace plumbline::renderer
