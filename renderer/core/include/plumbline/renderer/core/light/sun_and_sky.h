#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include <plumbline/renderer/core/light/light_sample.h>

namespace plumbline::renderer {

/// The same radiance from everywhere around (the sky), and more from a cone of directions (the sun,
/// whose radiance adds to the sky's). Half of the samples go to the cone, half beside it, uniform
/// in solid angle each; all to the cone where the sky is black.
struct SunAndSky {
  Vec3f direction;            ///< unit, towards the centre of the sun
  float one_minus_cos_angle;  ///< 1 − cos of the sun's half angle, in (0, 1]
  Rgbf sun, sky;              ///< [W/(m² sr)]

  /// @param half_angle  of the sun [rad], in (0, π/2]
  static SunAndSky make(const Vec3f& direction, double half_angle, const Rgbf& sun,
                        const Rgbf& sky) {
    const double s = std::sin(half_angle / 2);
    return {direction, static_cast<float>(2 * s * s), sun, sky};
  }

  /// @return W/(m² sr) along the direction wi, away from the reference point
  template <class T>
  Rgb<T> radiance_along(const Vec3<T>& wi) const {
    return rgb_cast<T>(in_sun(wi) ? sun + sky : sky);
  }

  /// @param u  in [0, 1)²; the reference point does not matter
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>&, const Vec2<T>& u) const {
    const T p = sun_probability<T>();
    const bool to_sun = u.x < p;
    const T share = to_sun ? T(u.x / p) : T((u.x - p) / (T(1) - p));
    const T h_sun = T(one_minus_cos_angle);
    const T h = to_sun ? T(share * h_sun) : T(h_sun + share * (T(2) - h_sun));
    const T sin_theta = safe_sqrt(T(h * (T(2) - h)));
    const SinCos<T> phi = sin_cos_turns(u.y);
    const Vec3<T> wi =
        axis_frame<T>().to_world({T(sin_theta * phi.cos), T(sin_theta * phi.sin), T(T(1) - h)});
    return LightSample<T>{.wi = wi,
                          .distance = T(std::numeric_limits<float>::infinity()),
                          .cos_light = T(1),
                          .radiance = rgb_cast<T>(to_sun ? sun + sky : sky),
                          .pdf_w = density(to_sun, p)};
  }

  /// @return pdf_w [1/sr] of `sample(ref, u)`
  template <class T>
  T pdf(const Vec3<T>&, const Vec3<T>& wi) const {
    return density(in_sun(wi), sun_probability<T>());
  }

 private:
  template <class T>
  T sun_probability() const {
    return is_black(sky) ? T(1) : T(0.5);
  }

  /// The cone's solid angle is 2π (1 − cosθ), that of the rest 2π (1 + cosθ).
  template <class T>
  T density(bool sun_side, const T& p) const {
    const T h = T(one_minus_cos_angle);
    return sun_side ? T(p / (T(2) * pi<T>() * h)) : T((T(1) - p) / (T(2) * pi<T>() * (T(2) - h)));
  }

  template <class T>
  Frame<T> axis_frame() const {
    return Frame<T>(unit<T>(direction));
  }

  template <class T>
  bool in_sun(const Vec3<T>& wi) const {
    const Vec3<T> axis = unit<T>(direction);
    // By the chord, whose square is 2 (1 − cosθ): the cosine has no digits left in a small cone.
    return length_squared(wi - axis) <= T(2) * T(one_minus_cos_angle);
  }
};

}  // namespace plumbline::renderer
