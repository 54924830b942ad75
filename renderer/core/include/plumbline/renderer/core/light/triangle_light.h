#pragma once

#include <limits>
#include <optional>

#include <plumbline/renderer/core/light/light_sample.h>
#include <plumbline/renderer/core/light/spherical_triangle.h>
#include <plumbline/renderer/core/sampling/warps.h>

namespace plumbline::renderer {

/// One-sided triangle v0, v0 + edge_1, v0 + edge_2, sampled uniformly by area, or by the solid
/// angle that it subtends.
struct TriangleLight {
  Vec3f v0, edge_1, edge_2;
  Vec3f normal;  ///< unit, emitting side
  Rgbf radiance;
  bool by_solid_angle = false;

  template <class T>
  T area() const {
    return length(cross(vec_cast<T>(edge_1), vec_cast<T>(edge_2))) / T(2);
  }

  /// @param ref  reference point, world space
  /// @param u    in [0, 1)²
  /// @return     nullopt where ref lies behind
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>& ref, const Vec2<T>& u) const {
    if (by_solid_angle) {
      const SphericalTriangle<Wide<T>> seen = seen_from(ref);
      if (large_enough(seen)) return sample_solid_angle(seen, ref, u);
    }
    const Vec2<T> b = square_to_uniform_triangle(u);
    const Vec3<T> point = vec_cast<T>(v0) + vec_cast<T>(edge_1) * b.x + vec_cast<T>(edge_2) * b.y;
    return from_area_sample(point - ref, plane_normal<T>(normal, edge_1, edge_2),
                            T(T(1) / area<T>()), rgb_cast<T>(radiance));
  }

  /// @return pdf_w [1/sr] of `sample(ref, u)`; 0 where wi misses the front
  template <class T>
  T pdf(const Vec3<T>& ref, const Vec3<T>& wi) const {
    return is_along(vec_cast<Wide<T>>(wi), vec_cast<Wide<T>>(v0) - vec_cast<Wide<T>>(ref))
               ? pdf_at_hit(ref, wi)
               : T(0);
  }

  /// @return the same where a ray along wi is known to end on the light. At its edge rounding can
  ///         say otherwise here, and a hit without a density would not be weighted down at all.
  template <class T>
  T pdf_at_hit(const Vec3<T>& ref, const Vec3<T>& wi) const {
    const auto hit =
        hit_front_of_plane(ref, wi, vec_cast<T>(v0), plane_normal<T>(normal, edge_1, edge_2));
    if (!hit) return T(0);
    if (by_solid_angle) {
      const SphericalTriangle<Wide<T>> seen = seen_from(ref);
      if (large_enough(seen)) return static_cast<T>(Wide<T>(1) / seen.solid_angle());
    }
    return sqr(hit->distance) / (hit->cos_light * area<T>());
  }

 private:
  /// Whether wi points into the triangle, edges included: it lies on the same side of the planes
  /// through them, or as near to one as the rounding of this very test. Unlike the point where it
  /// meets the triangle's plane, these keep their digits however flat it is seen.
  template <class W>
  bool is_along(const Vec3<W>& wi, const Vec3<W>& to_v0) const {
    const Vec3<W> e1 = vec_cast<W>(edge_1), e2 = vec_cast<W>(edge_2);
    const W a = dot(wi, cross(to_v0, e1));
    const W b = dot(wi, cross(to_v0 + e1, e2 - e1));
    const W c = dot(wi, cross(e2, to_v0));
    const W lengths = (length_squared(to_v0) + length_squared(e1) + length_squared(e2)) *
                      (length_squared(e1) + length_squared(e2));
    const W rounding = sqr(W(8) * std::numeric_limits<W>::epsilon()) * lengths;
    const auto inside = [&](const W& side) { return side >= W(0) || sqr(side) <= rounding; };
    return (inside(a) && inside(b) && inside(c)) ||
           (inside(W(-a)) && inside(W(-b)) && inside(W(-c)));
  }

  template <class T>
  SphericalTriangle<Wide<T>> seen_from(const Vec3<T>& ref) const {
    using W = Wide<T>;
    return {vec_cast<W>(v0) - vec_cast<W>(ref), vec_cast<W>(edge_1), vec_cast<W>(edge_2)};
  }

  template <class W>
  static bool large_enough(const SphericalTriangle<W>& seen) {
    return seen.solid_angle() >= W(kSmallestSolidAngle);
  }

  template <class T>
  std::optional<LightSample<T>> sample_solid_angle(const SphericalTriangle<Wide<T>>& seen,
                                                   const Vec3<T>& ref, const Vec2<T>& u) const {
    using W = Wide<T>;
    const Vec3<W> from = vec_cast<W>(ref), corner = vec_cast<W>(v0);
    const Vec3<W> n = plane_normal<W>(normal, edge_1, edge_2);
    const Vec3<W> w = seen.sample({static_cast<W>(u.x), static_cast<W>(u.y)});
    const auto hit = hit_front_of_plane(from, w, corner, n);
    if (!hit) return std::nullopt;
    return LightSample<T>{.wi = vec_cast<T>(w),
                          .distance = static_cast<T>(hit->distance),
                          .cos_light = static_cast<T>(hit->cos_light),
                          .radiance = rgb_cast<T>(radiance),
                          .pdf_w = static_cast<T>(W(1) / seen.solid_angle())};
  }
};

}  // namespace plumbline::renderer
