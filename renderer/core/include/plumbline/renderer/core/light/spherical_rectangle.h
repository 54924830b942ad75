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
  Vec3<Angle> sample(const Vec2<Angle>& u) const {
    // Rounding may leave the rectangle by its last digits, at the very edge.
    const auto x = static_cast<Angle>(clamp(x_by_angle(u.x * solid_angle_), x0_, x1_));
    const auto y0 = static_cast<Angle>(y0_), y1 = static_cast<Angle>(y1_);
    return at(x, clamp(y_on_line(x, u.y), y0, y1));
  }

  /// The same, uniform by area.
  Vec3<Angle> sample_area(const Vec2<Angle>& u) const {
    const T x = x0_ + static_cast<T>(u.x) * (x1_ - x0_),
            y = y0_ + static_cast<T>(u.y) * (y1_ - y0_);
    return at(static_cast<Angle>(x), static_cast<Angle>(y));
  }

 private:
  /// cosα and sinα, of any common length.
  struct Turn {
    T cosine, sine;
  };

  template <class X>
  static X clamp(const X& x, const X& low, const X& high) {
    return x < low ? low : (x > high ? high : x);
  }

  Vec3<Angle> at(const Angle& x, const Angle& y) const {
    return vec_cast<Angle>(x_axis_) * x + vec_cast<Angle>(y_axis_) * y -
           vec_cast<Angle>(normal_) * static_cast<Angle>(side_);
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

  /// By the sum of two angles.
  static Turn turned_on(const Turn& a, const Turn& b) {
    return {T(a.cosine * b.cosine - a.sine * b.sine), T(a.sine * b.cosine + a.cosine * b.sine)};
  }

  // Square roots and divisions in double are what a sample's time goes to. x is found by one of
  // each, everything multiplied with what it would be divided by: with h the height, P² = h² + y0²
  // and Q² = h² + y1², b0 = −y0/P, b1 = y1/Q, and the length of the first turn is (h² + x0²) P Q.
  // What follows on x needs no more digits than the direction that it ends in.

  /// Where the rectangle up to the line x subtends `angle` [sr]: x = h c/√(1 − c²) with c² =
  /// f²/(f² + (1 − b0²) sin²β) turned round, f = b0 cosβ + b1.
  T x_by_angle(const Angle& angle) const {
    using std::sqrt;
    // From half of it: 1 − 2 sin² keeps the digits of a small angle that the cosine of a float has
    // lost.
    const SinCos<Angle> half = sin_cos_turns(Angle(angle * (Angle(1) / (Angle(4) * pi<Angle>()))));
    const T s = static_cast<T>(half.sin), c = static_cast<T>(half.cos);
    const Turn beta = turned_on(first_, {T((c - s) * (c + s)), T(T(2) * s * c)});
    const T p2 = sqr(height_) + sqr(y0_);
    const T length_over_pq = (sqr(s) + sqr(c)) * (sqr(height_) + sqr(x0_));
    const T f = y1_ * p2 * length_over_pq - y0_ * beta.cosine;  // P times, and the length's
    const T h_sine = height_ * beta.sine, rest = sqr(f) - sqr(h_sine);
    const T x = h_sine * sqrt(T(p2 / (rest > T(0) ? rest : T(0))));  // rounding may leave no rest
    return f >= T(0) ? x : -x;
  }

  /// 1 + k and 1 − k of the point y of a line, k = y/√(d² + y²), and neither by a difference.
  struct Shares {
    Angle above, below;

    Shares(const Angle& y, const Angle& d2) {
      using std::sqrt;
      const Angle abs_y = y < Angle(0) ? -y : y, root = sqrt(d2 + sqr(y)), sum = root + abs_y;
      const Angle scale = Angle(1) / (root * sum), larger = sqr(sum) * scale, smaller = d2 * scale;
      above = y < Angle(0) ? smaller : larger;
      below = y < Angle(0) ? larger : smaller;
    }
  };

  /// The point on a line x up to which a share v of the line is seen: k goes evenly from that of y0
  /// to that of y1, and y = k d/√(1 − k²), d² = x² + h².
  Angle y_on_line(const Angle& x, const Angle& v) const {
    using std::sqrt;
    const Angle d2 = sqr(x) + sqr(static_cast<Angle>(height_));
    const Shares first(static_cast<Angle>(y0_), d2), last(static_cast<Angle>(y1_), d2);
    const Angle above = (Angle(1) - v) * first.above + v * last.above;
    const Angle below = (Angle(1) - v) * first.below + v * last.below;
    return (above - below) / Angle(2) * sqrt(Angle(d2 / (above * below)));
  }

  Vec3<T> x_axis_, y_axis_, normal_;
  T side_, height_, x0_, x1_, y0_, y1_;  // the height with its sign, and without
  Turn first_;
  Angle solid_angle_{};
};

}  // namespace plumbline::renderer
