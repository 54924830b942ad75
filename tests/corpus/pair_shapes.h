#pragma once

#include <array>

#include "pair_support.h"

/// Points on disks, triangles, apertures, pixels: densities per area.
namespace plumbline::tests::corpus {

/// Polar map of the square onto a disk: r = R√u makes area uniform.
template <class T>
struct DiskPolar {
  int fault;
  T radius;

  Xy<T> sample(T u, T v) const {
    const T r = radius * (fault == 1 ? u : std::sqrt(u)), phi = 2 * pi_v<T> * v;
    return {r * std::cos(phi), r * std::sin(phi)};
  }
  T pdf(const Xy<T>& p) const {
    if (!(p.x * p.x + p.y * p.y <= radius * radius)) return 0;
    const T area = pi_v<T> * (fault == 2 ? T(1) : radius * radius);
    return fault == 3 ? area : 1 / area;
  }
};

/// @source Shirley, Chiu 1997 (JGT 2:3), "A Low Distortion Map Between Disk and Square"
template <class T>
struct DiskConcentric {
  int fault;
  T radius;

  Xy<T> sample(T u, T v) const {
    const T a = 2 * u - 1, b = 2 * v - 1;
    if (a == 0 && b == 0) return {0, 0};
    const bool wide = std::abs(a) > std::abs(b);
    T r = radius * (wide ? a : b);
    if (fault == 1) r = std::copysign(radius * std::sqrt(std::abs(wide ? a : b)), r);
    const T phi = wide ? pi_v<T> / 4 * (b / a) : pi_v<T> / 2 - pi_v<T> / 4 * (a / b);
    return {r * std::cos(phi), r * std::sin(phi)};
  }
  T pdf(const Xy<T>& p) const {
    const T r = std::sqrt(p.x * p.x + p.y * p.y);
    if (!(r <= radius)) return 0;
    return fault == 2 ? 1 / (2 * pi_v<T> * radius * r) : 1 / (pi_v<T> * radius * radius);
  }
};

/// Barycentric coordinates, three ways of getting them uniform over the area of 1/2.
///
/// @source Turk 1990 (Graphics Gems I), `root` and `fold`; Heitz 2019, "A Low-Distortion Map
/// Between Triangle and Square", `half`
enum class TriangleMap { root, fold, half };

template <class T>
struct Triangle {
  int fault;
  TriangleMap map;

  Xy<T> sample(T u, T v) const {
    switch (map) {
      case TriangleMap::root: {
        const T s = fault == 1 ? u : std::sqrt(u);
        return {1 - s, v * s};
      }
      case TriangleMap::fold: {
        if (u + v > 1 && fault != 3) return {1 - u, 1 - v};
        return {u, v};
      }
      case TriangleMap::half: {
        if (u < v) return {u / 2, fault == 4 ? v : v - u / 2};
        return {fault == 4 ? u : u - v / 2, v / 2};
      }
    }
    return {0, 0};
  }
  T pdf(const Xy<T>& b) const {
    if (!(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1)) return 0;
    return fault == 2 ? T(1) : T(2);
  }
};

/// An elliptic lamp with half axes a and b.
template <class T>
struct Ellipse {
  int fault;
  T a, b;

  Xyz<T> sample(T u, T v) const {
    const T r = std::sqrt(u), phi = 2 * pi_v<T> * v;
    return {a * r * std::cos(phi), b * r * std::sin(phi), 0};
  }
  T pdf(const Xyz<T>& p) const {
    const T x = p.x / a, y = p.y / b;
    if (!(x * x + y * y <= 1)) return 0;
    if (fault == 1) return 1 / (pi_v<T> * a * a);
    if (fault == 2) return pi_v<T> * a * b;
    return 1 / (pi_v<T> * a * b);
  }
};

/// Its surface by polar coordinates of the unit disk: area a·b·r dr dφ.
inline Domain ellipse_domain(double a, double b) {
  constexpr double pi = std::numbers::pi;
  return Domain::surface(
      [a, b](const verify::Point2& p) {
        return verify::Vec3{a * p[0] * std::cos(2 * pi * p[1]), b * p[0] * std::sin(2 * pi * p[1]),
                            0};
      },
      [a, b](const verify::Vec3& x) {
        const double turn = std::atan2(x[1] / b, x[0] / a) / (2 * pi);
        return verify::Point2{std::hypot(x[0] / a, x[1] / b), turn < 0 ? turn + 1 : turn};
      },
      [a, b](const verify::Point2& p) { return 2 * pi * a * b * p[0]; });
}

/// A tube lamp without caps.
template <class T>
struct Cylinder {
  int fault;
  T radius, height;

  Xyz<T> sample(T u, T v) const {
    const T phi = 2 * pi_v<T> * u;
    const T z = height * (fault == 2 ? std::sqrt(v) : v);
    return {radius * std::cos(phi), radius * std::sin(phi), z};
  }
  T pdf(const Xyz<T>& p) const {
    if (!(p.z >= 0 && p.z <= height)) return 0;
    return fault == 1 ? 1 / (pi_v<T> * radius * radius * height)
                      : 1 / (2 * pi_v<T> * radius * height);
  }
};

inline Domain cylinder_domain(double radius, double height) {
  constexpr double pi = std::numbers::pi;
  return Domain::surface(
      [=](const verify::Point2& p) {
        return verify::Vec3{radius * std::cos(2 * pi * p[0]), radius * std::sin(2 * pi * p[0]),
                            height * p[1]};
      },
      [=](const verify::Vec3& x) {
        const double turn = std::atan2(x[1], x[0]) / (2 * pi);
        return verify::Point2{turn < 0 ? turn + 1 : turn, x[2] / height};
      },
      [=](const verify::Point2&) { return 2 * pi * radius * height; });
}

/// Lens opening with straight blades: one of the triangles around the centre by the first number,
/// which is then stretched and used again.
template <class T>
struct Aperture {
  int fault;
  int blades;

  T sector_angle() const { return 2 * pi_v<T> / static_cast<T>(blades); }
  Xy<T> sample(T u, T v) const {
    const T scaled = u * static_cast<T>(blades);
    const int k = std::min(static_cast<int>(scaled), blades - 1);
    const T left = fault == 1 ? u : scaled - static_cast<T>(k);
    const T s = fault == 2 ? left : std::sqrt(left);
    const T t0 = sector_angle() * static_cast<T>(k), t1 = t0 + sector_angle();
    const T w0 = s * (1 - v), w1 = s * v;
    return {w0 * std::cos(t0) + w1 * std::cos(t1), w0 * std::sin(t0) + w1 * std::sin(t1)};
  }
  T pdf(const Xy<T>& p) const {
    // In the polygon where the distance along the sector's middle is within the blade's.
    T phi = std::atan2(p.y, p.x);
    if (phi < 0) phi += 2 * pi_v<T>;
    const T half = sector_angle() / 2;
    const T from_middle = phi - (std::floor(phi / sector_angle()) + T(0.5)) * sector_angle();
    const T along = std::sqrt(p.x * p.x + p.y * p.y) * std::cos(from_middle);
    if (!(along <= std::cos(half))) return 0;
    const T area = static_cast<T>(blades) * std::sin(half) * std::cos(half);
    return fault == 3 ? 1 / pi_v<T> : 1 / area;
  }
};

enum class Filter { tent, gaussian, mitchell };

/// A separable pixel filter of radius 2 over [0, 1]²: tabulated, positive parts, both axes by the
/// table's cumulative distribution.
template <class T>
struct PixelFilter {
  static constexpr int kCells = 32;
  int fault;
  std::vector<T> f, cdf;
  T sum = 0;

  PixelFilter(Filter filter, int which) : fault(which) {
    cdf.push_back(0);
    for (int i = 0; i < kCells; ++i) {
      const T x = (static_cast<T>(i) + T(0.5)) / kCells * 4 - 2;
      f.push_back(profile(filter, x));
      cdf.push_back(cdf.back() + std::max(f.back(), T(0)));
    }
    sum = cdf.back();
  }
  static T profile(Filter filter, T x) {
    const T a = std::abs(x);
    switch (filter) {
      case Filter::tent:
        return std::max(T(0), 1 - a / 2);
      case Filter::gaussian:
        return std::exp(-2 * x * x) - std::exp(T(-8));
      case Filter::mitchell:  // Mitchell, Netravali 1988, Eq. 8 with B = C = 1/3
        return a < 1 ? (7 * a * a * a - 12 * a * a + T(16) / 3) / 6
                     : (-T(7) / 3 * a * a * a + 12 * a * a - 20 * a + T(32) / 3) / 6;
    }
    return 0;
  }
  T along(T u) const {
    const T x = u * sum;
    const auto above = std::upper_bound(cdf.begin() + 1, cdf.end() - 1, x);
    const int i = static_cast<int>(above - cdf.begin()) - 1;
    const T mass = at(cdf, i + 1) - at(cdf, i);
    const T within = mass > 0 ? (x - at(cdf, i)) / mass : T(0);
    return (static_cast<T>(i) + (fault == 4 ? T(0.5) : within)) / kCells;
  }
  T density(T x) const {
    const int i = fault == 1 ? cell_of(x + T(0.5) / kCells, kCells) : cell_of(x, kCells);
    const T value = fault == 2 ? at(f, i) : std::max(at(f, i), T(0));
    return value / sum * (fault == 3 ? T(1) : T(kCells));
  }
  Xy<T> sample(T u, T v) const { return {along(u), along(v)}; }
  T pdf(const Xy<T>& p) const { return density(p.x) * density(p.y); }
};

/// Bilinear patch over [0, 1]² with a value at each corner: y by the marginal, x by the
/// conditional, both linear densities.
///
/// @source Heitz 2020, "Can't Invert the CDF?"; Pharr et al. 2023, §A.5.1
template <class T>
struct BilinearPatch {
  int fault;
  std::array<T, 4> w;  ///< at (0, 0), (1, 0), (0, 1), (1, 1)

  static T linear(T u, T a, T b) {
    return u * (a + b) / (a + std::sqrt(std::max(T(0), a * a + u * (b * b - a * a))));
  }
  Xy<T> sample(T u, T v) const {
    const T y = linear(v, w[0] + w[1], w[2] + w[3]);
    return {linear(u, w[0] + y * (w[2] - w[0]), w[1] + y * (w[3] - w[1])), y};
  }
  T pdf(const Xy<T>& p) const {
    if (!(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1)) return 0;
    const T x = fault == 2 ? p.y : fault == 3 ? 1 - p.x : p.x, y = fault == 2 ? p.x : p.y;
    const T value = (1 - y) * ((1 - x) * w[0] + x * w[1]) + y * ((1 - x) * w[2] + x * w[3]);
    return value / (w[0] + w[1] + w[2] + w[3]) * (fault == 1 ? 1 : 4);
  }
};

/// Gaussian positions within a pixel, retried until inside: the density is divided by the share.
template <class T>
struct GaussianRetried {
  int fault;

  /// A Gaussian of deviation 0.3 around (0.5, 0.6), drawn by Box and Muller, retried until it falls
  /// into the pixel.
  Xy<T> sample(Random& random) const {
    for (;;) {
      const T r = T(0.3) * std::sqrt(-2 * std::log(1 - verify::uniform<T>(random)));
      const T phi = 2 * pi_v<T> * verify::uniform<T>(random);
      const Xy<T> p{T(0.5) + r * std::cos(phi), T(0.6) + r * std::sin(phi)};
      if (p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) return p;
      if (fault == 2) return {std::clamp(p.x, T(0), T(1)), std::clamp(p.y, T(0), T(1))};
    }
  }
  static T inside(T mean) {
    const T scale = T(0.3) * std::numbers::sqrt2_v<T>;
    return (std::erf((1 - mean) / scale) + std::erf(mean / scale)) / 2;
  }
  T pdf(const Xy<T>& p) const {
    if (!(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1)) return 0;
    const T x = (p.x - T(0.5)) / T(0.3), y = (p.y - T(0.6)) / T(0.3);
    const T density = std::exp(-(x * x + y * y) / 2) / (2 * pi_v<T> * T(0.09));
    return fault == 1 ? density : density / (inside(T(0.5)) * inside(T(0.6)));
  }
};

}  // namespace plumbline::tests::corpus
