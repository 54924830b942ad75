#include "placed_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace plumbline::tests {
namespace {

using renderer::Vec3d;

constexpr double kPi = renderer::pi<double>();

/// A point in a shape's own space: distances along the ray are the same there.
struct Local {
  std::size_t part;
  double t;
  Vec3d normal;
};

std::vector<Local> on_sphere(const Vec3d& o, const Vec3d& d, double edge) {
  const Vec3d m = o - PlacedShape::kCenter;
  const double r = PlacedShape::kRadius * (1 + edge);
  const double a = dot(d, d), b = dot(m, d), root = b * b - a * (dot(m, m) - r * r);
  std::vector<Local> points;
  if (root <= 0) return points;
  for (const double sign : {-1.0, 1.0}) {
    const double t = (-b + sign * std::sqrt(root)) / a;
    points.push_back({0, t, m + d * t});
  }
  return points;
}

std::vector<Local> on_plane(const Vec3d& o, const Vec3d& d, bool round, double edge) {
  const double t = -o.z / d.z;
  const Vec3d p = o + d * t;
  const double out = round ? std::hypot(p.x, p.y) : std::max(std::abs(p.x), std::abs(p.y));
  if (!(out <= 1 + edge)) return {};
  return {{0, t, {0, 0, 1}}};
}

/// By Cramer's rule, in coordinates along two edges.
std::vector<Local> on_mesh(const Vec3d& o, const Vec3d& d, double edge) {
  std::vector<Local> points;
  for (std::size_t part = 0; part < PlacedShape::kTriangles.size(); ++part) {
    const auto& [i, j, k] = PlacedShape::kTriangles[part];
    const Vec3d v0 = PlacedShape::kCorners[i];
    const Vec3d e1 = PlacedShape::kCorners[j] - v0, e2 = PlacedShape::kCorners[k] - v0;
    const Vec3d n = cross(e1, e2);
    const double t = dot(v0 - o, n) / dot(d, n);
    const Vec3d p = o + d * t - v0;
    const double b1 = dot(cross(p, e2), n) / dot(n, n), b2 = dot(cross(e1, p), n) / dot(n, n);
    if (std::min({b1, b2, 1 - b1 - b2}) >= -edge) points.push_back({part, t, n});
  }
  return points;
}

/// Between three directions, which need not be unit.
/// @source Van Oosterom, Strackee 1983, Eq. 8
double solid_angle_of(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double la = length(a), lb = length(b), lc = length(c);
  const double over = std::abs(dot(a, cross(b, c)));
  const double under = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2 * std::atan2(over, under);
}

}  // namespace

std::string Placement::xml() const {
  return fmt::format(
      "<transform name=\"to_world\"><matrix value=\"{:.17g} {:.17g} {:.17g} {:.17g}  {:.17g} "
      "{:.17g} {:.17g} {:.17g}  {:.17g} {:.17g} {:.17g} {:.17g}  0 0 0 1\"/></transform>",
      x.x, y.x, z.x, origin.x, x.y, y.y, z.y, origin.y, x.z, y.z, z.z, origin.z);
}

std::string PlacedShape::obj() {
  std::string text;
  for (const Vec3d& v : kCorners) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
  for (const auto& [i, j, k] : kTriangles) {
    text += fmt::format("f {} {} {}\n", i + 1, j + 1, k + 1);
  }
  return text;
}

std::vector<Meeting> PlacedShape::meetings(const Vec3d& ref, const Vec3d& wi, double edge) const {
  const Vec3d o = placement_.inverse_vector(ref - placement_.origin);
  const Vec3d d = placement_.inverse_vector(wi);
  std::vector<Local> points;
  if (model_ == Model::sphere) {
    points = on_sphere(o, d, edge);
  } else if (model_ == Model::mesh) {
    points = on_mesh(o, d, edge);
  } else {
    points = on_plane(o, d, model_ == Model::disk, edge);
  }
  // A mesh is what its corners make of it: mirrored, they run the other way round.
  const bool inside_out = model_ == Model::mesh && placement_.determinant() < 0;
  const double facing = flip_normals_ != inside_out ? -1 : 1;
  std::vector<Meeting> result;
  for (const Local& p : points) {
    if (p.t > 0) result.push_back({p.part, p.t, placement_.normal(p.normal) * facing});
  }
  std::sort(result.begin(), result.end(),
            [](const Meeting& a, const Meeting& b) { return a.distance < b.distance; });
  return result;
}

std::vector<Vec3d> PlacedShape::outline(std::size_t part) const {
  std::vector<Vec3d> corners;
  if (model_ == Model::mesh) {
    for (const std::size_t i : kTriangles[part]) corners.push_back(placement_.point(kCorners[i]));
  } else {
    for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      corners.push_back(placement_.point({static_cast<double>(s), static_cast<double>(t), 0}));
    }
  }
  return corners;
}

double PlacedShape::area(std::size_t part) const {
  if (model_ == Model::sphere) return 4 * kPi * radius() * radius();
  if (model_ == Model::disk) return kPi * length(cross(placement_.x, placement_.y));
  const std::vector<Vec3d> c = outline(part);
  const double triangle = length(cross(c[1] - c[0], c[2] - c[0])) / 2;
  return model_ == Model::mesh ? triangle : 2 * triangle;
}

double PlacedShape::area() const {
  double sum = 0;
  for (std::size_t part = 0; part < parts(); ++part) sum += area(part);
  return sum;
}

double PlacedShape::solid_angle(std::size_t part, const Vec3d& ref) const {
  if (model_ == Model::sphere) {
    const double sine = radius() / length(center() - ref);
    return 2 * kPi * (1 - std::sqrt(1 - sine * sine));
  }
  const std::vector<Vec3d> c = outline(part);
  double sum = 0;
  for (std::size_t i = 2; i < c.size(); ++i) {
    sum += solid_angle_of(c[0] - ref, c[i - 1] - ref, c[i] - ref);
  }
  return sum;
}

double PlacedShape::size(std::size_t part) const {
  if (model_ == Model::sphere) return radius();
  if (model_ == Model::disk) return length(placement_.x);
  const std::vector<Vec3d> c = outline(part);
  const double longest = std::max({length(c[1] - c[0]), length(c[2] - c[1]), length(c[2] - c[0])});
  return 2 * area(part) / longest;
}

}  // namespace plumbline::tests
