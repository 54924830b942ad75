#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include "surfaces.h"

namespace plumbline::renderer {
namespace {

struct Numbered {
  ExactShape surface;
  double tolerance;
  ExactShape::Box box;  // around it and its tolerance
  std::size_t shape, number;
};

bool are_apart(const ExactShape::Box& a, const ExactShape::Box& b) {
  return a.low.x > b.high.x || b.low.x > a.high.x || a.low.y > b.high.y || b.low.y > a.high.y ||
         a.low.z > b.high.z || b.low.z > a.high.z;
}

/// How far corners of the smaller lie from the plane of the larger, at most [m].
double largest_gap(const ExactShape& smaller, const ExactShape& larger) {
  double gap = 0;
  for (const Vec3d& p : corners_of(smaller)) {
    gap = std::max(gap, std::abs(dot(larger.normal(), p - larger.origin())));
  }
  return gap;
}

/// Whether convex polygons in one plane share more than an edge: no line parallel to a side of
/// either parts them.
bool overlap(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b, const Vec3d& normal) {
  const auto range = [](const std::vector<Vec3d>& polygon, const Vec3d& from, const Vec3d& axis) {
    std::pair<double, double> seen{INFINITY, -INFINITY};
    for (const Vec3d& p : polygon) {
      const double x = dot(p - from, axis);
      seen = {std::min(seen.first, x), std::max(seen.second, x)};
    }
    return seen;
  };
  for (const auto* sides : {&a, &b}) {
    for (std::size_t i = 0; i < sides->size(); ++i) {
      const Vec3d from = (*sides)[i];
      const Vec3d axis = cross(normal, (*sides)[(i + 1) % sides->size()] - from);
      const auto [a_low, a_high] = range(a, from, axis);
      const auto [b_low, b_high] = range(b, from, axis);
      constexpr double kShared = 1e-6;  // of the narrower: what rounding makes of a common edge
      const double common = std::min(a_high, b_high) - std::max(a_low, b_low);
      if (!(common > kShared * std::min(a_high - a_low, b_high - b_low))) return false;
    }
  }
  return true;
}

class Finder {
 public:
  Finder(const PlacedParts& scene, Placement& placement) : scene_(scene), placement_(placement) {}

  void find() {
    collect();
    std::sort(single_.begin(), single_.end(), [](const Numbered& a, const Numbered& b) {
      return std::pair(a.box.low.x, a.number) < std::pair(b.box.low.x, b.number);
    });
    for (std::size_t i = 0; i < single_.size(); ++i) {
      for (std::size_t j = i + 1; j < single_.size(); ++j) {
        if (single_[j].box.low.x > single_[i].box.high.x) break;
        if (!are_apart(single_[i].box, single_[j].box)) compare(single_[i], single_[j]);
      }
    }
    compare_triangles();
  }

 private:
  using Hash = std::pair<std::uint64_t, std::pair<std::size_t, std::size_t>>;

  /// What single precision leaves of where it is: of the distance from the camera at least, and of
  /// the coordinates that count along its normal (plane_magnitude).
  double tolerance(const ExactShape& s) const {
    const Vec3d o = s.origin() - placement_.center, n = s.normal();
    return 0x1p-22 * (at_least_from(s, scene_.camera.origin) + std::abs(n.x * o.x) +
                      std::abs(n.y * o.y) + std::abs(n.z * o.z));
  }

  Numbered numbered(const ExactShape& s, std::size_t shape, std::size_t number) const {
    const double most = tolerance(s);
    const Vec3d margin{most, most, most};
    const auto [low, high] = s.box();
    return {s, most, {low - margin, high + margin}, shape, number};
  }

  void collect() {
    std::size_t number = 0;
    for (std::size_t shape = 0; shape < scene_.shapes.size(); ++shape) {
      const bool mesh = std::holds_alternative<MeshShape>(scene_.shapes[shape].geometry);
      if (mesh) meshes_.emplace_back(shape, number);
      for_each_surface(scene_.shapes[shape], [&](const ExactShape& s) {
        if (!mesh) single_.push_back(numbered(s, shape, number));
        ++number;
      });
    }
  }

  void compare(const Numbered& a, const Numbered& b) {
    if (a.surface.is_flat() != b.surface.is_flat()) return;
    const bool a_smaller = reach_of(a.surface) < reach_of(b.surface);
    const ExactShape& smaller = a_smaller ? a.surface : b.surface;
    const ExactShape& larger = a_smaller ? b.surface : a.surface;
    if (!a.surface.is_flat()) {
      const double gap =
          length(smaller.origin() - larger.origin()) + std::abs(smaller.radius() - larger.radius());
      if (gap <= 0x1p-22 * smaller.radius()) found(a, b);
      return;
    }
    const double most = (a_smaller ? a : b).tolerance;
    if (std::abs(dot(larger.normal(), smaller.origin() - larger.origin())) > most) return;
    const double gap = largest_gap(smaller, larger);
    if (gap > most || !overlap(corners_of(smaller), corners_of(larger), larger.normal())) return;
    found(a, b);
  }

  /// Triangles of meshes with what is no mesh, and with their twins.
  void compare_triangles() {
    std::vector<Hash> hashes;
    for (const auto& [shape, first] : meshes_) {
      std::size_t number = first;
      for_each_surface(scene_.shapes[shape], [&, shape = shape](const ExactShape& triangle) {
        const Numbered t = numbered(triangle, shape, number);
        for (const Numbered& other : single_) {
          if (other.box.low.x > t.box.high.x) break;
          if (are_apart(t.box, other.box) || !other.surface.is_flat()) continue;
          const Vec3d between = triangle.origin() - other.surface.origin();
          if (std::abs(dot(other.surface.normal(), between)) <= t.tolerance) compare(t, other);
        }
        hashes.push_back({hash_of(triangle), {number, shape}});
        ++number;
      });
    }
    std::sort(hashes.begin(), hashes.end());
    for (std::size_t i = 1; i < hashes.size(); ++i) {
      if (hashes[i].first != hashes[i - 1].first) continue;
      pair(hashes[i - 1].second, hashes[i].second);
    }
  }

  /// The same for the same corners in any order.
  static std::uint64_t hash_of(const ExactShape& triangle) {
    std::uint64_t sum = 0;
    for (const Vec3d& p : corners_of(triangle)) {
      std::uint64_t corner = 0;
      for (const double x : {p.x, p.y, p.z}) {
        corner = mix_bits(corner + std::bit_cast<std::uint64_t>(x));
      }
      sum += corner;
    }
    return sum;
  }

  void found(const Numbered& a, const Numbered& b) {
    pair(std::min(std::pair(a.number, a.shape), std::pair(b.number, b.shape)),
         std::max(std::pair(a.number, a.shape), std::pair(b.number, b.shape)));
  }

  /// @param first, second  number and shape, in the order of the file
  void pair(const std::pair<std::size_t, std::size_t>& first,
            const std::pair<std::size_t, std::size_t>& second) {
    if (scene_.shapes[second.second].radiance) {
      throw InputError(fmt::format(
          "{} emits from the same place as {}, which hides it: of two surfaces in one place the "
          "first in the file counts. Put it first, or move it",
          place_in_file(scene_, second.second), name_of(scene_, first.second)));
    }
    const std::size_t place = placement_.exact.try_emplace(first.first, first.first).first->second;
    std::size_t& of_second = placement_.exact.try_emplace(second.first, second.first).first->second;
    of_second = std::min(of_second, place);
  }

  const PlacedParts& scene_;
  Placement& placement_;
  std::vector<Numbered> single_;
  std::vector<std::pair<std::size_t, std::size_t>> meshes_;  // shape and its first surface
};

}  // namespace

void find_coincident(const PlacedParts& scene, Placement& placement) {
  Finder(scene, placement).find();
}

}  // namespace plumbline::renderer
