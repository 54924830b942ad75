#pragma once

#include <optional>

#include <plumbline/renderer/core/light/light_sample.h>
#include <plumbline/renderer/core/light/spherical_rectangle.h>

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
    if (by_solid_angle) return sample_solid_angle(ref, u);
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
    const bool inside = s >= T(0) && s <= dot(eu, eu) && t >= T(0) && t <= dot(ev, ev);
    return inside ? pdf_at(ref, *hit) : T(0);
  }

  /// @return the same where a ray along wi is known to end on the light. At its edge rounding can
  ///         say otherwise here, and a hit without a density would not be weighted down at all.
  template <class T>
  T pdf_at_hit(const Vec3<T>& ref, const Vec3<T>& wi) const {
    const auto hit = hit_front_of_plane(ref, wi, vec_cast<T>(origin), normal_of_side(ref));
    return hit ? pdf_at(ref, *hit) : T(0);
  }

 private:
  template <class T>
  T pdf_at(const Vec3<T>& ref, const PlaneHit<T>& hit) const {
    if (by_solid_angle) {
      const SphericalRectangle<T> seen = seen_from(ref);
      if (large_enough(seen)) return T(1) / seen.solid_angle();
    }
    return sqr(hit.distance) / (hit.cos_light * area<T>());
  }

  /// Unit normal of the side that emits towards ref, if one does.
  template <class T>
  Vec3<T> normal_of_side(const Vec3<T>& ref) const {
    const Vec3<T> n = plane_normal<T>(normal, edge_u, edge_v);
    const T other_side(two_sided ? -1 : 1);
    return n * (dot(n, ref - vec_cast<T>(origin)) < T(0) ? other_side : T(1));
  }

  template <class T>
  SphericalRectangle<T> seen_from(const Vec3<T>& ref) const {
    using W = Wide<T>;
    return {vec_cast<W>(origin) - vec_cast<W>(ref), vec_cast<W>(edge_u), vec_cast<W>(edge_v),
            plane_normal<W>(normal, edge_u, edge_v)};
  }

  template <class T>
  static bool large_enough(const SphericalRectangle<T>& seen) {
    return seen.solid_angle() >= T(kSmallestSolidAngle);
  }

  // Both ways of choosing the point and one way out: loops over many samples vectorise.
  template <class T>
  std::optional<LightSample<T>> sample_solid_angle(const Vec3<T>& ref, const Vec2<T>& u) const {
    const SphericalRectangle<T> seen = seen_from(ref);
    const bool large = large_enough(seen);
    const Vec3<T> by_angle = seen.sample(u), by_area = seen.sample_area(u);
    const Vec3<T> to_light{large ? by_angle.x : by_area.x, large ? by_angle.y : by_area.y,
                           large ? by_angle.z : by_area.z};
    const T distance = length(to_light), per_distance = T(1) / distance;
    const T cos_front = static_cast<T>(seen.height()) * per_distance;
    const T cos_light = two_sided && cos_front < T(0) ? -cos_front : cos_front;
    const T angle_by_area = cos_light * area<T>() * sqr(per_distance);
    if (!(cos_light > T(0))) return std::nullopt;
    return LightSample<T>{.wi = to_light * per_distance,
                          .distance = distance,
                          .cos_light = cos_light,
                          .radiance = rgb_cast<T>(radiance),
                          .pdf_w = T(1) / (large ? seen.solid_angle() : angle_by_area)};
  }
};

}  // namespace plumbline::renderer
