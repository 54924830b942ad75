#pragma once

#include <optional>

#include <plumbline/renderer/core/math.h>

namespace plumbline::renderer {

/// A rectangle as the solid angle that it subtends, sampled uniformly in it.
///
/// Angles are kept as the complex numbers e^{iα} in double until they are small or final: their
/// differences then lose nothing, and a single arc tangent in the renderer's float remains.
///
/// @tparam Angle  scalar of the angles; lengths are Wide<Angle>
/// @source Ureña et al. 2013 (CGF 32:4), Section 4. Written with β = a_u − π and with the arc
///         tangents of the corners in place of arc cosines, so that nothing cancels but what is
///         small against the whole.
template <class Angle>
class SphericalRectangle {
  using T = Wide<Angle>;

 public:
  /// @param corner          seen from the reference point
  /// @param edge_u, edge_v  perpendicular
  /// @param normal          unit, of either side
  SphericalRectangle(const Vec3<T>& corner, const Vec3<T>& edge_u, const Vec3<T>& edge_v,
                     const Vec3<T>& normal)
      : x_axis_(normalize(edge_u)),
        y_axis_(normalize(edge_v)),
        normal_(normal),
        side_(-dot(corner, normal)),
        height_(side_ < T(0) ? -side_ : side_),
        x0_(dot(corner, x_axis_)),
        x1_(x0_ + length(edge_u)),
        y0_(dot(corner, y_axis_)),
        y1_(y0_ + length(edge_v)),
        first_(turned_back(corner_turn(x0_, y1_), corner_turn(x0_, y0_))) {
    const Turn second = turned_back(corner_turn(x1_, y1_), corner_turn(x1_, y0_));
    const Turn between = turned_back(second, first_);
    const Angle angle = angle_of<Angle>(between.sine, between.cosine);
    // More than π is seen only from right below or above, nearer than the rectangle is large. A
    // negative angle elsewhere is rounding.
    const bool all_around = x0_ < T(0) && x1_ > T(0) && y0_ < T(0) && y1_ > T(0) &&
                            sqr(height_) < (x1_ - x0_) * (y1_ - y0_);
    solid_angle_ = all_around && angle < Angle(0) ? Angle(angle + Angle(2) * pi<Angle>()) : angle;
  }

  /// [sr]; not positive where the reference point lies in the plane
  const Angle& solid_angle() const { return solid_angle_; }

  /// Of the reference point above the plane, along the normal [m]; negative behind.
  const T& height() const { return side_; }

  /// @param u  in [0, 1)²
  /// @return   point of the rectangle, seen from the reference point
  Vec3<T> sample(const Vec2<Angle>& u) const {
    using std::sqrt;
    const Turn beta = turned_on(u.x * solid_angle_);
    const T b0 = -y0_ / sqrt(sqr(height_) + sqr(y0_));
    const T b1 = y1_ / sqrt(sqr(height_) + sqr(y1_));
    const T numerator = b0 * beta.cosine + b1;
    // x = h c/√(1 − c²) with c² = numerator²/(numerator² + (1 − b0²) sin²β) turned round.
    const T one_minus_b0_squared = sqr(height_) / (sqr(height_) + sqr(y0_));
    const T root = safe_sqrt(T(sqr(numerator) - one_minus_b0_squared * sqr(beta.sine)));
    const T x = (numerator >= T(0) ? T(1) : T(-1)) * height_ * beta.sine / root;
    const T d = sqrt(sqr(x) + sqr(height_));
    const T h0 = y0_ / sqrt(sqr(d) + sqr(y0_)), h1 = y1_ / sqrt(sqr(d) + sqr(y1_));
    const T h = h0 + static_cast<T>(u.y) * (h1 - h0);
    const T y = h * d / sqrt(T((T(1) - h) * (T(1) + h)));
    // Rounding may leave the rectangle by its last digits, at the very edge.
    return x_axis_ * clamp(x, x0_, x1_) + y_axis_ * clamp(y, y0_, y1_) - normal_ * side_;
  }

 private:
  /// cosα and sinα, of any common length.
  struct Turn {
    T cosine, sine;
  };

  static T clamp(const T& x, const T& low, const T& high) {
    return x < low ? low : (x > high ? high : x);
  }

  /// By π/2 minus the angle of the spherical rectangle at a corner, or its negative.
  Turn corner_turn(const T& x, const T& y) const {
    using std::sqrt;
    return {T(height_ * sqrt(sqr(x) + sqr(y) + sqr(height_))), T(x * y)};
  }

  /// By the difference of two angles.
  static Turn turned_back(const Turn& a, const Turn& b) {
    return {T(a.cosine * b.cosine + a.sine * b.sine), T(a.sine * b.cosine - a.cosine * b.sine)};
  }

  /// By the first angle and `angle` more. From half of it, made unit again: 1 − 2 sin² keeps the
  /// digits of a small angle that the cosine of a float has lost.
  Turn turned_on(const Angle& angle) const {
    using std::sqrt;
    const SinCos<Angle> half = sin_cos_turns(Angle(angle / (Angle(4) * pi<Angle>())));
    const T s = static_cast<T>(half.sin), c = static_cast<T>(half.cos);
    const T unit = T(1) / ((sqr(s) + sqr(c)) * sqrt(sqr(first_.cosine) + sqr(first_.sine)));
    const T cosine = (c - s) * (c + s) * unit, sine = T(2) * s * c * unit;
    return {T(first_.cosine * cosine - first_.sine * sine),
            T(first_.sine * cosine + first_.cosine * sine)};
  }

  Vec3<T> x_axis_, y_axis_, normal_;
  T side_, height_, x0_, x1_, y0_, y1_;  // the height with its sign, and without
  Turn first_;
  Angle solid_angle_{};
};

}  // namespace plumbline::renderer
