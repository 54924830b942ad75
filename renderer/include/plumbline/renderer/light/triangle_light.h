#pragma once

#include <optional>

#include <plumbline/renderer/light/light_sample.h>
#include <plumbline/renderer/sampling/warps.h>

namespace plumbline::renderer {

/// One-sided triangle v0, v0 + edge_1, v0 + edge_2, sampled uniformly by area.
struct TriangleLight {
  Vec3f v0, edge_1, edge_2;
  Vec3f normal;  ///< unit, emitting side
  Rgbf radiance;

  template <class T>
  T area() const {
    return length(cross(vec_cast<T>(edge_1), vec_cast<T>(edge_2))) / T(2);
  }

  /// @param ref  reference point, world space
  /// @param u    in [0, 1)²
  /// @return     nullopt where ref lies behind
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>& ref, const Vec2<T>& u) const {
    const Vec2<T> b = square_to_uniform_triangle(u);
    const Vec3<T> point = vec_cast<T>(v0) + vec_cast<T>(edge_1) * b.x + vec_cast<T>(edge_2) * b.y;
    return from_area_sample(point - ref, plane_normal<T>(normal, edge_1, edge_2),
                            T(T(1) / area<T>()), rgb_cast<T>(radiance));
  }

  /// @return pdf_w [1/sr] of `sample(ref, u)`; 0 where wi misses the front
  template <class T>
  T pdf(const Vec3<T>& ref, const Vec3<T>& wi) const {
    const auto hit =
        hit_front_of_plane(ref, wi, vec_cast<T>(v0), plane_normal<T>(normal, edge_1, edge_2));
    if (!hit) return T(0);
    // Barycentric coordinates by Cramer's rule on p = b1·e1 + b2·e2.
    const Vec3<T> p = ref + wi * hit->distance - vec_cast<T>(v0);
    const Vec3<T> e1 = vec_cast<T>(edge_1), e2 = vec_cast<T>(edge_2);
    const Vec3<T> n = cross(e1, e2);
    const T n_squared = dot(n, n);
    const T b1 = dot(cross(p, e2), n) / n_squared;
    const T b2 = dot(cross(e1, p), n) / n_squared;
    if (!(b1 >= T(0) && b2 >= T(0) && b1 + b2 <= T(1))) return T(0);
    return sqr(hit->distance) / (hit->cos_light * area<T>());
  }
};

}  // namespace plumbline::renderer
