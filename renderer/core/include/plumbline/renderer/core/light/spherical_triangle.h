#pragma once

#include <plumbline/renderer/core/math.h>

namespace plumbline::renderer {

/// A triangle as the solid angle that it subtends, sampled uniformly in it.
///
/// In float everything is computed in double: the map takes differences of angles.
///
/// @source Arvo 1995 (SIGGRAPH), Figure 2; solid angle: van Oosterom, Strackee 1983, Eq. 8
template <class T>
class SphericalTriangle {
 public:
  /// @param v0              corner, seen from the reference point
  /// @param edge_1, edge_2  to the other two
  SphericalTriangle(const Vec3<T>& v0, const Vec3<T>& edge_1, const Vec3<T>& edge_2)
      : a_(normalize(v0)), b_(normalize(v0 + edge_1)), c_(normalize(v0 + edge_2)) {
    using std::abs, std::atan2, std::sqrt;
    // Volume of the three unit vectors from the edges: their own product would cancel.
    const T volume = abs(dot(v0, cross(edge_1, edge_2))) /
                     (length(v0) * length(v0 + edge_1) * length(v0 + edge_2));
    const T ab = dot(a_, b_), bc = dot(b_, c_), ca = dot(c_, a_);
    solid_angle_ = T(2) * atan2(volume, T(T(1) + ab + bc + ca));
    // Angle at a between the planes through b and c, by their normals.
    const T along = dot(cross(a_, b_), cross(a_, c_));
    sin_alpha_ = volume / sqrt(sqr(volume) + sqr(along));
    alpha_ = atan2(volume, along);
    one_minus_ab_ = length_squared(a_ - b_) / T(2);
  }

  /// [sr]
  const T& solid_angle() const { return solid_angle_; }

  /// @param u  in [0, 1)²
  /// @return   unit direction
  Vec3<T> sample(const Vec2<T>& u) const {
    using std::sin;
    // u.x cuts off a part of the area by an arc through b; q is 1 − cos of where it meets ac,
    // in a form without Arvo's cancellation near a.
    const T cut = u.x * solid_angle_;
    const T x = T(2) * sqr(T(sin(cut / T(2))));
    const T q = (T(2) - one_minus_ab_) * x / (x + one_minus_ab_ * sin_alpha_ * sin(alpha_ - cut));
    const Vec3<T> on_ac = turned(a_, c_, q);
    return turned(b_, on_ac, T(u.y * length_squared(on_ac - b_) / T(2)));
  }

 private:
  /// `from` turned towards `to` by an angle of which 1 − cos is given.
  static Vec3<T> turned(const Vec3<T>& from, const Vec3<T>& to, const T& one_minus_cos) {
    return from * (T(1) - one_minus_cos) + normalize(to - from * dot(to, from)) *
                                               safe_sqrt(T(one_minus_cos * (T(2) - one_minus_cos)));
  }

  Vec3<T> a_, b_, c_;
  T solid_angle_{}, alpha_{}, sin_alpha_{}, one_minus_ab_{};
};

}  // namespace plumbline::renderer
