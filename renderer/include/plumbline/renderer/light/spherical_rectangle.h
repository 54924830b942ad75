#pragma once

#include <optional>

#include <plumbline/renderer/math.h>

namespace plumbline::renderer {

/// A rectangle as the solid angle that it subtends, sampled uniformly in it.
///
/// In float everything is computed in double: the solid angle is a difference of angles.
///
/// @source Ureña et al. 2013 (CGF 32:4), Section 4. Written with β = a_u − π and with the arc
///         tangents of the corners in place of arc cosines, so that nothing cancels but what is
///         small against the whole.
template <class T>
class SphericalRectangle {
 public:
  /// @param corner          seen from the reference point
  /// @param edge_u, edge_v  perpendicular
  /// @param normal          unit, towards the reference point
  SphericalRectangle(const Vec3<T>& corner, const Vec3<T>& edge_u, const Vec3<T>& edge_v,
                     const Vec3<T>& normal)
      : x_axis_(normalize(edge_u)),
        y_axis_(normalize(edge_v)),
        normal_(normal),
        height_(-dot(corner, normal)),
        x0_(dot(corner, x_axis_)),
        x1_(x0_ + length(edge_u)),
        y0_(dot(corner, y_axis_)),
        y1_(y0_ + length(edge_v)) {
    first_ = corner_angle(x0_, y1_) - corner_angle(x0_, y0_);
    solid_angle_ = corner_angle(x1_, y1_) - corner_angle(x1_, y0_) - first_;
  }

  /// [sr]; not positive where the reference point lies in the plane or behind
  const T& solid_angle() const { return solid_angle_; }

  /// Of the reference point above the plane [m]; not positive in the plane or behind.
  const T& height() const { return height_; }

  /// @param u  in [0, 1)²
  /// @return   point of the rectangle, seen from the reference point
  Vec3<T> sample(const Vec2<T>& u) const {
    using std::sin, std::cos, std::sqrt;
    const T beta = first_ + u.x * solid_angle_;
    const T b0 = -y0_ / sqrt(sqr(height_) + sqr(y0_));
    const T b1 = y1_ / sqrt(sqr(height_) + sqr(y1_));
    const T sine = sin(beta);
    const T numerator = b0 * cos(beta) + b1;
    // x = h c/√(1 − c²) with c² = numerator²/(numerator² + (1 − b0²) sin²β) turned round.
    const T one_minus_b0_squared = sqr(height_) / (sqr(height_) + sqr(y0_));
    const T root = safe_sqrt(T(sqr(numerator) - one_minus_b0_squared * sqr(sine)));
    const T x = (numerator >= T(0) ? T(1) : T(-1)) * height_ * sine / root;
    const T d = sqrt(sqr(x) + sqr(height_));
    const T h0 = y0_ / sqrt(sqr(d) + sqr(y0_)), h1 = y1_ / sqrt(sqr(d) + sqr(y1_));
    const T h = h0 + u.y * (h1 - h0);
    const T y = h * d / sqrt(T((T(1) - h) * (T(1) + h)));
    // Rounding may leave the rectangle by its last digits, at the very edge.
    return x_axis_ * clamp(x, x0_, x1_) + y_axis_ * clamp(y, y0_, y1_) - normal_ * height_;
  }

 private:
  static T clamp(const T& x, const T& low, const T& high) {
    return x < low ? low : (x > high ? high : x);
  }

  /// π/2 minus the angle of the spherical rectangle at a corner, or its negative.
  T corner_angle(const T& x, const T& y) const {
    using std::atan2, std::sqrt;
    return atan2(T(x * y), T(height_ * sqrt(sqr(x) + sqr(y) + sqr(height_))));
  }

  Vec3<T> x_axis_, y_axis_, normal_;
  T height_, x0_, x1_, y0_, y1_;
  T first_{}, solid_angle_{};
};

}  // namespace plumbline::renderer
