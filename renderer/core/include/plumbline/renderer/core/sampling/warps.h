#pragma once

#include <plumbline/renderer/core/math.h>

/// Maps of the unit square and their densities, paired by name. `u` in [0, 1)².
namespace plumbline::renderer {

/// Cosine-weighted direction about +z: uniform disk by polar coordinates, lifted (Malley).
///
/// Polar rather than concentric, because it is smooth everywhere but at one seam and one pole, so
/// the Jacobian check holds on the whole square.
/// @return unit vector, z ≥ 0
template <class T>
Vec3<T> square_to_cosine_hemisphere(const Vec2<T>& u) {
  using std::sqrt;
  const T radius = sqrt(u.x);
  const SinCos<T> phi = sin_cos_turns(u.y);
  return {T(radius * phi.cos), T(radius * phi.sin), safe_sqrt(T(T(1) - u.x))};
}

/// @return pdf_w [1/sr] = cosθ/π; 0 below the horizon
template <class T>
T square_to_cosine_hemisphere_pdf_w(const Vec3<T>& w) {
  return w.z > T(0) ? T(w.z * (T(1) / pi<T>())) : T(0);
}

/// Uniform direction on the hemisphere about +z.
template <class T>
Vec3<T> square_to_uniform_hemisphere(const Vec2<T>& u) {
  using std::cos, std::sin;
  const T z = u.x;
  // 1 − z² as (1 − z)(1 + z): no cancellation near the pole.
  const T radius = safe_sqrt(T((T(1) - z) * (T(1) + z)));
  const T phi = T(2) * pi<T>() * u.y;
  return {T(radius * cos(phi)), T(radius * sin(phi)), z};
}

/// @return pdf_w [1/sr] = 1/(2π) on the hemisphere, 0 below
template <class T>
T square_to_uniform_hemisphere_pdf_w(const Vec3<T>& w) {
  return w.z >= T(0) ? T(T(1) / (T(2) * pi<T>())) : T(0);
}

/// Uniform direction on the sphere.
template <class T>
Vec3<T> square_to_uniform_sphere(const Vec2<T>& u) {
  using std::cos, std::sin, std::sqrt;
  const T z = T(1) - T(2) * u.x;
  // 1 − z² = 4 u (1 − u), exact at both poles.
  const T radius = T(2) * safe_sqrt(T(u.x * (T(1) - u.x)));
  const T phi = T(2) * pi<T>() * u.y;
  return {T(radius * cos(phi)), T(radius * sin(phi)), z};
}

/// @return pdf_w [1/sr] = 1/(4π)
template <class T>
T square_to_uniform_sphere_pdf_w(const Vec3<T>&) {
  return T(1) / (T(4) * pi<T>());
}

/// Uniform point on the unit disk, polar.
template <class T>
Vec2<T> square_to_uniform_disk(const Vec2<T>& u) {
  using std::cos, std::sin, std::sqrt;
  const T radius = sqrt(u.x);
  const T phi = T(2) * pi<T>() * u.y;
  return {T(radius * cos(phi)), T(radius * sin(phi))};
}

/// @return pdf_a [1/unit²] = 1/π inside the unit disk, 0 outside
template <class T>
T square_to_uniform_disk_pdf_a(const Vec2<T>& p) {
  return sqr(p.x) + sqr(p.y) <= T(1) ? T(T(1) / pi<T>()) : T(0);
}

/// Uniform barycentric coordinates (b1, b2) on a triangle, b0 = 1 − b1 − b2.
///
/// @source Turk 1990 (Graphics Gems, p. 24): b0 = 1 − √u, b1 = (1 − v) √u, b2 = v √u
template <class T>
Vec2<T> square_to_uniform_triangle(const Vec2<T>& u) {
  using std::sqrt;
  const T root = sqrt(u.x);
  return {T((T(1) - u.y) * root), T(u.y * root)};
}

/// @return pdf_a [1/unit²] = 2 on the unit right triangle b1, b2 ≥ 0, b1 + b2 ≤ 1; 0 outside
template <class T>
T square_to_uniform_triangle_pdf_a(const Vec2<T>& b) {
  return b.x >= T(0) && b.y >= T(0) && b.x + b.y <= T(1) ? T(2) : T(0);
}

}  // namespace plumbline::renderer
