#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

/// What every renderer has a header of its own for. Written for the corpus, apart from the one
/// under test elsewhere in this repository and from the library. The pairs have such a header too:
/// names that both have are kept apart by their inline namespaces.
namespace plumbline::tests::corpus {
inline namespace bsdf_math {

using std::numbers::pi_v;

template <class T>
struct V3 {
  T x, y, z;
  friend V3 operator+(const V3& a, const V3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend V3 operator-(const V3& a, const V3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend V3 operator*(T s, const V3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend V3 operator-(const V3& a) { return {-a.x, -a.y, -a.z}; }
};

template <class T>
struct P2 {
  T x, y;
};

template <class T>
struct P3 {
  T x, y, z;
};

template <class T>
struct Rgb {
  T r, g, b;
  friend Rgb operator+(const Rgb& a, const Rgb& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
  friend Rgb operator*(T s, const Rgb& a) { return {s * a.r, s * a.g, s * a.b}; }
};

template <class T>
T sqr(T x) {
  return x * x;
}

template <class T>
T safe_sqrt(T x) {
  return std::sqrt(std::max(T(0), x));
}

template <class T>
T dot(const V3<T>& a, const V3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
V3<T> cross(const V3<T>& a, const V3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
V3<T> unit(const V3<T>& a) {
  return (1 / std::sqrt(dot(a, a))) * a;
}

/// wo and the mirror direction both point away from the surface.
template <class T>
V3<T> mirrored_at(const V3<T>& wo, const V3<T>& h) {
  return 2 * dot(wo, h) * h - wo;
}

template <class T>
V3<T> spherical(T cos_theta, T phi) {
  const T sin_theta = safe_sqrt(1 - cos_theta * cos_theta);
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}

/// A frame around n: its columns are s, t and n.
template <class T>
struct Frame {
  V3<T> s, t, n;
  explicit Frame(const V3<T>& normal) : n(normal) {
    s = std::abs(n.x) > T(0.5) ? unit(cross(n, V3<T>{0, 1, 0})) : unit(cross(n, V3<T>{1, 0, 0}));
    t = cross(n, s);
  }
  V3<T> to_world(const V3<T>& w) const { return w.x * s + w.y * t + w.z * n; }
  V3<T> to_local(const V3<T>& w) const { return {dot(w, s), dot(w, t), dot(w, n)}; }
};

/// Malley's method on polar coordinates.
template <class T>
V3<T> cosine_hemisphere(T u, T v) {
  const T r = std::sqrt(u), phi = 2 * pi_v<T> * v;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
}

/// @source Shirley, Chiu 1997, A low distortion map between disk and square
template <class T>
P2<T> concentric_disk(T u, T v) {
  const T a = 2 * u - 1, b = 2 * v - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const T r = wide ? a : b;
  const T phi = wide ? pi_v<T> / 4 * (b / a) : pi_v<T> / 2 - pi_v<T> / 4 * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// Fresnel reflectance without polarisation, for the cosine on the side that light comes from.
///
/// @param eta  index of the far side over that of the near one
template <class T>
T fresnel_dielectric(T cosine, T eta) {
  const T sin2_t = (1 - cosine * cosine) / (eta * eta);
  if (sin2_t >= 1) return 1;
  const T cos_t = std::sqrt(1 - sin2_t);
  const T s = (cosine - eta * cos_t) / (cosine + eta * cos_t);
  const T p = (eta * cosine - cos_t) / (eta * cosine + cos_t);
  return (s * s + p * p) / 2;
}

template <class T>
T schlick(T f0, T cosine) {
  const T m = std::clamp(1 - cosine, T(0), T(1));
  return f0 + (1 - f0) * m * m * m * m * m;
}

/// The largest number below 1.
template <class T>
T below_one(T u) {
  return std::min(u, std::nextafter(T(1), T(0)));
}

template <class T>
struct Sampled {
  V3<T> wi;
  T weight, pdf;
};

template <class T>
struct SampledRgb {
  V3<T> wi;
  Rgb<T> weight;
  T pdf;
};

}  // namespace bsdf_math
}  // namespace plumbline::tests::corpus
