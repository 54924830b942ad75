#include "pairs/branches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "pairs/batches.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kNearest = 16;
constexpr int kMaxSteps = 40, kMaxHalvings = 12;
// Two solutions this close are one. Many numbers in float lead to one rounded point.
constexpr double kSame = 1e-6, kSameInFloat = 4e-3;

double squared_distance(const Vec3& a, const Vec3& b) {
  const Vec3 d = sum(a, scaled(b, -1));
  return dot(d, d);
}

std::optional<Vec3> point_of(const Record& sample) {
  if (!sample || sample->mass > 0) return std::nullopt;
  return sample->x;
}

/// Gauss–Newton's step.
///
/// @param slope  of the map along each number
Uniforms gauss_newton(const std::array<Vec3, 2>& slope, const Vec3& off, int dimension) {
  if (dimension == 1) return {dot(slope[0], off) / dot(slope[0], slope[0]), 0, 0};
  const double a = dot(slope[0], slope[0]), b = dot(slope[0], slope[1]),
               c = dot(slope[1], slope[1]);
  const double p = dot(slope[0], off), q = dot(slope[1], off);
  const double det = a * c - b * b;
  return {(c * p - b * q) / det, (a * q - b * p) / det, 0};
}

}  // namespace

BranchSearch::BranchSearch(const Map& map, int dimension, double epsilon)
    : map_(map), dimension_(dimension), epsilon_(epsilon), per_side_(dimension == 1 ? 4096 : 96) {
  // Denser towards the ends, where maps are steep.
  const auto place = [&](std::size_t i) {
    const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(per_side_);
    return (1 - std::cos(std::numbers::pi * t)) / 2;
  };
  const std::size_t rows = dimension == 1 ? 1 : per_side_;
  std::vector<Uniforms> u;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < per_side_; ++i) {
      u.push_back({place(i), dimension == 1 ? 0 : place(j), 0});
    }
  }
  const auto x = at(u);
  for (std::size_t i = 0; i < u.size(); ++i) grid_.push_back({u[i], x[i]});
}

std::vector<std::optional<Vec3>> BranchSearch::at(const std::vector<Uniforms>& u) const {
  std::vector<std::optional<Vec3>> points;
  for (const Record& sample : ask(map_, u)) points.push_back(point_of(sample));
  return points;
}

/// The nearest nodes, and those that are nearer than all around them.
std::vector<Uniforms> BranchSearch::starts(const Vec3& x) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> distance(grid_.size(), kFar);
  std::vector<std::size_t> order(grid_.size());
  for (std::size_t k = 0; k < grid_.size(); ++k) {
    order[k] = k;
    if (grid_[k].x) distance[k] = squared_distance(*grid_[k].x, x);
  }
  const auto nearest = order.begin() + static_cast<std::ptrdiff_t>(kNearest);
  std::partial_sort(order.begin(), nearest, order.end(),
                    [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
  std::vector<Uniforms> starts;
  for (auto k = order.begin(); k != nearest; ++k) starts.push_back(grid_[*k].u);

  const auto side = static_cast<std::ptrdiff_t>(per_side_);
  const auto rows = static_cast<std::ptrdiff_t>(grid_.size()) / side;
  const auto of = [&](std::ptrdiff_t i, std::ptrdiff_t j) -> double {
    const bool inside = i >= 0 && i < side && j >= 0 && j < rows;
    if (!inside) return kFar;
    return distance[static_cast<std::size_t>(j * side + i)];
  };
  for (std::ptrdiff_t j = 0; j < rows; ++j) {
    for (std::ptrdiff_t i = 0; i < side; ++i) {
      const double here = of(i, j);
      if (here == kFar) continue;
      const bool in_row = here <= of(i - 1, j) && here <= of(i + 1, j);
      const bool in_column = here <= of(i, j - 1) && here <= of(i, j + 1);
      if (in_row && in_column) starts.push_back(grid_[static_cast<std::size_t>(j * side + i)].u);
    }
  }
  return starts;
}

/// Where differences between paths and points beside them lead; a path without is lost.
void BranchSearch::find_changes(const Paths& paths) const {
  const double h = epsilon_ > 0x1p-40 ? 0x1p-12 : 0x1p-26;
  const auto dimension = static_cast<std::size_t>(dimension_);
  std::vector<Uniforms> beside;
  for (const Path* path : paths) {
    for (std::size_t d = 0; d < dimension; ++d) {
      Uniforms& u = beside.emplace_back(path->u);
      u[d] = u[d] + h < 1 ? u[d] + h : u[d] - h;
    }
  }
  const auto there = at(beside);
  for (std::size_t k = 0; k < paths.size(); ++k) {
    Path& path = *paths[k];
    std::array<Vec3, 2> slope{};
    for (std::size_t d = 0; d < dimension && !path.lost; ++d) {
      const std::size_t i = k * dimension + d;
      path.lost = !there[i];
      if (path.lost) break;
      const double length = beside[i][d] - path.u[d];
      slope[d] = scaled(sum(*there[i], scaled(path.here, -1)), 1 / length);
    }
    if (path.lost) continue;
    path.change = gauss_newton(slope, sum(path.x, scaled(path.here, -1)), dimension_);
    path.lost = !std::isfinite(path.change[0]) || !std::isfinite(path.change[1]);
  }
}

Uniforms BranchSearch::moved(const Path& path, double length) const {
  Uniforms next = path.u;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension_); ++d) {
    // Not past the end: the root may lie just before it.
    const double to = path.u[d] + length * path.change[d];
    next[d] = to <= 0 ? path.u[d] / 2 : to >= 1 ? (path.u[d] + 1 - epsilon_) / 2 : to;
  }
  return next;
}

/// The paths that got nearer, by the longest of their steps that does.
BranchSearch::Paths BranchSearch::approach(const Paths& paths) const {
  Paths nearer, waiting = paths;
  // Whole steps, and all the shorter ones of those that overshoot.
  for (const auto& [first, count] : {std::pair{0, 1}, std::pair{1, kMaxHalvings - 1}}) {
    std::vector<Uniforms> tried;
    for (const Path* path : waiting) {
      for (int k = 0; k < count; ++k) tried.push_back(moved(*path, std::exp2(-(first + k))));
    }
    const auto there = at(tried);
    Paths left;
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      Path& path = *waiting[i];
      const std::size_t begin = i * static_cast<std::size_t>(count);
      const std::size_t end = begin + static_cast<std::size_t>(count);
      std::size_t k = begin;
      while (k < end && !(there[k] && squared_distance(*there[k], path.x) < path.off)) ++k;
      if (k == end) {
        left.push_back(&path);
        continue;
      }
      path.u = tried[k];
      path.here = *there[k];
      path.off = squared_distance(path.here, path.x);
      nearer.push_back(&path);
    }
    waiting = std::move(left);
  }
  return nearer;
}

double BranchSearch::enough(const Vec3& x) const {
  return std::pow(64 * epsilon_, 2) * std::max(1.0, dot(x, x));
}

void BranchSearch::begin(std::vector<Path>& paths) const {
  std::vector<Uniforms> from;
  for (const Path& path : paths) from.push_back(path.u);
  const auto there = at(from);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    paths[i].lost = !there[i];
    if (!there[i]) continue;
    paths[i].here = *there[i];
    paths[i].off = squared_distance(*there[i], paths[i].x);
  }
}

std::vector<std::vector<Uniforms>> BranchSearch::preimages(std::span<const Target> targets) const {
  std::vector<Path> paths;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    for (const Uniforms& u : starts(targets[i].x)) paths.push_back({i, targets[i].x, u});
  }
  begin(paths);
  Paths active;
  for (Path& path : paths) active.push_back(&path);
  for (int i = 0; i < kMaxSteps && !active.empty(); ++i) {
    std::erase_if(active, [&](const Path* p) { return p->lost || p->off <= enough(p->x); });
    find_changes(active);
    std::erase_if(active, [](const Path* p) { return p->lost; });
    active = approach(active);
  }

  const double same = epsilon_ > 0x1p-40 ? kSameInFloat : kSame;
  std::vector<std::vector<Uniforms>> found(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i].known) found[i].push_back(*targets[i].known);
  }
  for (const Path& path : paths) {
    // Rounding of the point itself may stop the search a little earlier.
    if (path.lost || !(path.off <= 256 * enough(path.x))) continue;
    std::vector<Uniforms>& of_target = found[path.target];
    const bool seen = std::any_of(of_target.begin(), of_target.end(), [&](const Uniforms& other) {
      return std::abs(other[0] - path.u[0]) < same && std::abs(other[1] - path.u[1]) < same;
    });
    if (!seen) of_target.push_back(path.u);
  }
  return found;
}

}  // namespace plumbline::verify
