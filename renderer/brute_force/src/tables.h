#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/scene/embree.h>

/// What the kernels read, primitive after primitive, laid out once for a scene. Primitives are
/// numbered as the scene's geometry numbers those of their kind.
namespace plumbline::renderer::brute_force {

/// A number of every primitive, side by side, up to a whole packet with what no ray meets: NaN.
class Column {
 public:
  void add(double x) {
    if (count_ == values_.size()) values_.resize(count_ + embree::kPacket, NAN);
    values_[count_++] = static_cast<float>(x);
  }
  float operator[](std::size_t i) const { return values_[i]; }
  const float* from(std::size_t i) const { return values_.data() + i; }
  std::size_t size() const { return count_; }

 private:
  std::vector<float> values_;
  std::size_t count_ = 0;
};

struct Column3 {
  Column x, y, z;

  void add(const Vec3d& v) {
    x.add(v.x);
    y.add(v.y);
    z.add(v.z);
  }
};

/// Triangles or parallelograms: the points corner + u·e1 + v·e2.
/// @tparam N  number of corners
template <std::size_t N>
struct Flats {
  Column3 normal;            ///< unit
  Column3 corner;            ///< the first
  Column3 along_u, along_v;  ///< in the plane: products with a point's offset from it are u and v
  /// What u and v, times the cosine that they come with, may be wrong by: slack + slack_by_origin ·
  /// the largest coordinate of a ray's origin.
  Column slack, slack_by_origin;
  std::vector<std::array<Vec3d, N>> outlines;  ///< for rays that pass an edge within its error
};

struct Disks {
  Column3 center, normal;
  Column radius_squared;
};

struct Spheres {
  Column3 center;
  Column radius_squared;
};

struct Tables {
  Flats<3> triangles;
  Flats<4> rectangles;
  Disks disks;
  Spheres spheres;
};

/// Whether a ray passes all edges of a surface on the same side, and where it meets it then: u and
/// v. Side of the line from a to b, in Plücker's coordinates: d·(a × b) + (b − a)·(o × d), which is
/// d·((a − o) × (b − o)). From b to a every term is negated, so that two surfaces with a common
/// edge agree to the last bit on which of them a ray meets, and none passes between them.
template <std::size_t N>
std::optional<Vec2f> place_inside(const std::array<Vec3d, N>& corners, const Vec3f& ray_origin,
                                  const Vec3f& ray_direction) {
  const Vec3d origin = vec_cast<double>(ray_origin), direction = vec_cast<double>(ray_direction);
  const Vec3d moment = cross(origin, direction);
  std::array<double, N> sides{};
  bool left = true, right = true;
  for (std::size_t i = 0; i < N; ++i) {
    const Vec3d &a = corners[i], &b = corners[(i + 1) % N];
    sides[i] = dot(direction, cross(a, b)) + dot(b - a, moment);
    left = left && sides[i] >= 0;
    right = right && sides[i] <= 0;
  }
  if (!left && !right) return std::nullopt;
  const double u = sides[N - 1], v = sides[0];
  const double u_sum = N == 3 ? u + v + sides[1] : u + sides[1];
  const double v_sum = N == 3 ? u_sum : v + sides[2];
  return Vec2f{static_cast<float>(u / u_sum), static_cast<float>(v / v_sum)};
}

}  // namespace plumbline::renderer::brute_force
