#include "judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace plumbline::tests {
namespace {

using boost::multiprecision::cpp_bin_float_quad;
using Quad =
    boost::multiprecision::number<cpp_bin_float_quad::backend_type, boost::multiprecision::et_off>;
using namespace renderer;

template <class T>
T reach(const Vec3<T>& a) {
  using std::abs;
  return std::max(std::max(T(abs(a.x)), T(abs(a.y))), T(abs(a.z)));
}

template <class T>
T abs_dot(const Vec3<T>& a, const Vec3<T>& b) {
  using std::abs;
  return abs(a.x * b.x) + abs(a.y * b.y) + abs(a.z * b.z);
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUlp = 0x1p-24;

/// Where a ray meets the surface that a primitive is part of, and how far inside the primitive [m].
/// The two units are of 2⁻²⁴: of the distance, and of how far inside, as single precision has them.
struct Meeting {
  double t = kInfinity, inside = -kInfinity;
  double t_unit = 0, inside_unit = 0;
};

/// One ray, in the arithmetic of T.
template <class T>
struct Judged {
  using V = Vec3<T>;
  const SceneGeometry& geometry;
  V o, d;

  Judged(const SceneGeometry& of, const Ray& ray)
      : geometry(of), o(vec_cast<T>(ray.origin)), d(vec_cast<T>(ray.direction)) {}

  // A ray's distance from a plane along the normal is computed from a corner and divided by the
  // cosine: both have errors of 2⁻²⁴ of what enters their sums. On which side of an edge it passes
  // is told in double where single precision does not tell.
  Meeting meet_flat(const std::vector<V>& corners) const {
    using std::abs;
    const V n = normalize(cross(corners[1] - corners[0], corners.back() - corners[0]));
    const V w = corners[0] - o, moment = cross(o, d);
    const T cosine = dot(n, d), t = dot(n, w) / cosine;
    T left = T(1e30), right = T(1e30), size = T(0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const V &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const T side = (dot(d, cross(a, b)) + dot(b - a, moment)) / length(b - a);
      left = std::min(left, side);
      right = std::min(right, T(-side));
      size = std::max(size, reach(a));
    }
    return {static_cast<double>(t), static_cast<double>(std::max(left, right)),
            kUlp * static_cast<double>((abs_dot(n, w) + abs(t)) / abs(cosine)),
            0x1p-53 * static_cast<double>(size + reach(o))};
  }

  Meeting meet_disk(const V& center, const T& radius, const V& n) const {
    using std::abs;
    const V w = center - o;
    const T cosine = dot(n, d), t = dot(n, w) / cosine;
    const double t_unit = kUlp * static_cast<double>((abs_dot(n, w) + abs(t)) / abs(cosine));
    return {static_cast<double>(t), static_cast<double>(radius - length(d * t - w)), t_unit,
            t_unit + kUlp * static_cast<double>(length(w) + radius)};
  }

  // The half chord is the root of r² − l²: as l comes near r, the errors of both by 2⁻²⁴ of what
  // enters them grow by l over the half chord.
  std::array<Meeting, 2> meet_sphere(const V& center, const T& radius) const {
    using std::sqrt;
    const V w = center - o;
    const T middle = dot(w, d) / dot(d, d), l = length(w - d * middle);
    const T left = radius * radius - l * l, half = left > 0 ? T(sqrt(left / dot(d, d))) : T(0);
    const auto r = static_cast<double>(radius);
    const double unit = kUlp * (static_cast<double>(length(w)) + r);
    const double grown = std::min(unit * r / static_cast<double>(half), std::sqrt(2 * unit * r));
    const auto inside = static_cast<double>(radius - l);
    return {Meeting{static_cast<double>(middle - half), inside, unit + grown, unit},
            Meeting{static_cast<double>(middle + half), inside, unit + grown, unit}};
  }

  std::vector<V> corners_of(unsigned kind, std::size_t i) const {
    std::vector<V> corners;
    const auto add = [&](const auto& indices) {
      for (const std::uint32_t v : indices) corners.push_back(vec_cast<T>(geometry.vertices[v]));
    };
    if (kind == kTriangles) {
      add(geometry.triangles[i]);
    } else {
      add(geometry.rectangles[i]);
    }
    return corners;
  }

  /// Two for a sphere; the second of others is nowhere.
  std::array<Meeting, 2> meetings(unsigned kind, std::size_t i) const {
    if (is_flat(kind)) return {meet_flat(corners_of(kind, i))};
    if (kind == kSpheres) {
      const Sphere& sphere = geometry.spheres[i];
      return meet_sphere(vec_cast<T>(sphere.center), T(sphere.radius));
    }
    const Disk& disk = geometry.disks[i];
    return {
        meet_disk(vec_cast<T>(disk.center), T(disk.radius), vec_cast<T>(geometry.disk_normals[i]))};
  }
};

/// Whether double precision tells that a ray passes by: most surfaces, which need no quad then.
bool passes_by(const std::array<Meeting, 2>& meetings, double most_ulps) {
  return meetings[0].inside < -(2 * most_ulps * meetings[0].inside_unit + 1e-6);
}

}  // namespace

std::string fault_of(const SceneGeometry& geometry, const Ray& ray, const Answer& answer,
                     double most_ulps) {
  const bool hit = answer.kind != RTC_INVALID_GEOMETRY_ID;
  const Judged<Quad> quad(geometry, ray);
  const Judged<double> roughly(geometry, ray);
  bool found = false;
  double first = kInfinity;  // where a ray has certainly met something, at the latest
  double earliest = kInfinity;
  for (unsigned kind = 0; kind < kExact; ++kind) {
    for (std::size_t i = 0; i < geometry.primitives[kind].size(); ++i) {
      if (passes_by(roughly.meetings(kind, i), most_ulps)) continue;
      for (const Meeting& m : quad.meetings(kind, i)) {
        const double t_error = most_ulps * m.t_unit, inside_error = most_ulps * m.inside_unit;
        if (m.inside > inside_error && m.t > t_error) first = std::min(first, m.t + t_error);
        if (!hit || answer.kind != kind || answer.index != i) continue;
        if (m.inside < -inside_error || m.t < -t_error) continue;
        if (!(std::abs(static_cast<double>(answer.t) - m.t) <= t_error)) continue;
        found = true;
        earliest = std::min(earliest, m.t - t_error);
      }
    }
  }
  if (!hit) return first < kInfinity ? fmt::format("misses what is met at {}", first) : "";
  if (!found) return fmt::format("does not meet {}/{} at {}", answer.kind, answer.index, answer.t);
  if (earliest > first) return fmt::format("{} is behind what is met at {}", answer.t, first);
  return "";
}

double distance_error(const SceneGeometry& geometry, const Ray& ray, const Answer& answer) {
  double least = kInfinity;
  for (const Meeting& m : Judged<Quad>(geometry, ray).meetings(answer.kind, answer.index)) {
    least = std::min(least, std::abs(static_cast<double>(answer.t) - m.t) / m.t_unit);
  }
  return least;
}

}  // namespace plumbline::tests
