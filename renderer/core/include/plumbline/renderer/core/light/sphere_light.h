#pragma once

#include <optional>

#include <plumbline/renderer/core/light/light_sample.h>
#include <plumbline/renderer/core/sampling/warps.h>

namespace plumbline::renderer {

/// A sphere that emits from its outside, or with `inward` from its inside. From outside, directions
/// are uniform in the cone that the sphere subtends; from inside, points are uniform by area.
struct SphereLight {
  Vec3f center;
  float radius;  ///< [m]
  bool inward;   ///< normals, and so emission, point to the centre
  Rgbf radiance;

  template <class T>
  T area() const {
    return T(4) * pi<T>() * sqr(T(radius));
  }

  /// @param ref  reference point, world space
  /// @param u    in [0, 1)²
  /// @return     nullopt where ref is inside a sphere that emits outwards, or a sample sees no
  ///             front
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>& ref, const Vec2<T>& u) const {
    return inward ? sample_from_inside(ref, u) : sample_cone(ref, u);
  }

  /// @return pdf_w [1/sr] of `sample(ref, u)`; 0 where wi misses
  template <class T>
  T pdf(const Vec3<T>& ref, const Vec3<T>& wi) const {
    return inward ? pdf_from_inside(ref, wi) : pdf_cone(ref, wi);
  }

  /// @return the same where a ray along wi is known to end on the light. At its edge rounding can
  ///         say otherwise here, and a hit without a density would not be weighted down at all.
  template <class T>
  T pdf_at_hit(const Vec3<T>& ref, const Vec3<T>& wi) const {
    if (inward) return pdf_from_inside(ref, wi);
    const Cone<T> cone = cone_from(ref);
    return is_outside(cone) ? uniform_cone_pdf_w(cone) : T(0);
  }

 private:
  /// The cone that the sphere subtends from a point outside; from inside numbers without a meaning.
  template <class T>
  struct Cone {
    Vec3<T> axis;         // unit, towards the centre
    T distance;           // to the centre
    T gap;                // d² − R²
    T sin2_max;           // R²/d²
    T one_minus_cos_max;  // sin²/(1 + cos): 1 − cosθ would cancel for small cones
  };

  template <class T>
  Cone<T> cone_from(const Vec3<T>& ref) const {
    const Vec3<T> to_center = vec_cast<T>(center) - ref;
    const T r = T(radius);
    const T d = length(to_center);
    const T gap = (d - r) * (d + r);
    const T cos_max = safe_sqrt(gap) / d;
    const T sin2_max = sqr(T(r / d));
    return {to_center / d, d, gap, sin2_max, T(sin2_max / (T(1) + cos_max))};
  }

  template <class T>
  bool is_outside(const Cone<T>& cone) const {
    return cone.distance > T(radius);
  }

  // One way out, and that last: loops over many samples vectorise.
  template <class T>
  std::optional<LightSample<T>> sample_cone(const Vec3<T>& ref, const Vec2<T>& u) const {
    const Cone<T> cone = cone_from(ref);
    // h = 1 − cosθ is uniform in [0, 1 − cosθmax]; sin²θ = h (2 − h).
    const T h = u.x * cone.one_minus_cos_max;
    const T sin2 = h * (T(2) - h);
    const T sin_theta = safe_sqrt(sin2);
    const T cos_theta = T(1) - h;
    const SinCos<T> phi = sin_cos_turns(u.y);
    const Vec3<T> wi =
        Frame<T>(cone.axis).to_world({T(sin_theta * phi.cos), T(sin_theta * phi.sin), cos_theta});
    // Half chord: distance from the closest approach to the sphere. The nearer root is written as
    // (d² − R²)/(d cosθ + half chord), which does not cancel.
    const T half_chord = safe_sqrt(T(sqr(T(radius)) - sqr(cone.distance) * sin2));
    const T distance = cone.gap / (cone.distance * cos_theta + half_chord);
    if (!is_outside(cone)) return std::nullopt;
    return LightSample<T>{.wi = wi,
                          .distance = distance,
                          .cos_light = T(half_chord / T(radius)),
                          .radiance = rgb_cast<T>(radiance),
                          .pdf_w = uniform_cone_pdf_w(cone)};
  }

  template <class T>
  static T uniform_cone_pdf_w(const Cone<T>& cone) {
    return T(1) / (T(2) * pi<T>() * cone.one_minus_cos_max);
  }

  template <class T>
  T pdf_cone(const Vec3<T>& ref, const Vec3<T>& wi) const {
    const Cone<T> cone = cone_from(ref);
    if (!is_outside(cone) || !(dot(wi, cone.axis) > T(0))) return T(0);
    // sin²θ from the cross product: exact for small angles, where cosθ has no digits left.
    return length_squared(cross(wi, cone.axis)) <= cone.sin2_max ? uniform_cone_pdf_w(cone) : T(0);
  }

  // A reference point on the sphere itself (a closed furnace) may lie outside by a rounding error,
  // so none is refused for its side: from outside the far wall is sampled, and the near one shadows
  // it.
  template <class T>
  std::optional<LightSample<T>> sample_from_inside(const Vec3<T>& ref, const Vec2<T>& u) const {
    const Vec3<T> n = square_to_uniform_sphere(u);
    const Vec3<T> point = vec_cast<T>(center) + n * T(radius);
    auto s = from_area_sample(point - ref, -n, T(T(1) / area<T>()), rgb_cast<T>(radiance));
    if (!s) return std::nullopt;
    // From outside the density grows like 1/cosθ towards the limb, and of a direction that is ε off
    // the cosine's square is off by about ε. There the rounded wi decides, not the point it came
    // from: whoever meets wi by another technique knows no more, and both have to weigh it alike.
    s->pdf_w = pdf_from_inside(ref, s->wi);
    if (!(s->pdf_w > T(0))) return std::nullopt;
    return s;
  }

  // The far root of |m + t wi|² = R² is −m·wi + half chord. The half chord is the root of
  // R² − |m|² + (m·wi)², a sum of squares from inside; R² − |m|² sin² would cancel at grazing
  // angles of a point on the sphere. Where wi leaves the centre behind, the root is the quotient of
  // R² − |m|² and the sum.
  template <class T>
  T pdf_from_inside(const Vec3<T>& ref, const Vec3<T>& wi) const {
    const Vec3<T> m = ref - vec_cast<T>(center);
    const T away = dot(m, wi), from_center = length(m);
    const T gap = (T(radius) - from_center) * (T(radius) + from_center);
    const T half_chord = safe_sqrt(T(gap + sqr(away)));
    if (!(half_chord > T(0))) return T(0);
    const T distance = away > T(0) ? T(gap / (half_chord + away)) : T(half_chord - away);
    if (!(distance > T(0))) return T(0);
    return sqr(distance) * T(radius) / (half_chord * area<T>());
  }
};

}  // namespace plumbline::renderer
