#include "pairs/branches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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
  const std::vector<Record> samples = ask(map_, u);
  for (std::size_t i = 0; i < u.size(); ++i) grid_.push_back({u[i], point_of(samples[i])});
}

std::optional<Vec3> BranchSearch::at(const Uniforms& u) const { return point_of(map_(u)); }

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

/// Gauss–Newton's step with differences.
std::optional<Uniforms> BranchSearch::step(const Vec3& here, const Vec3& x,
                                           const Uniforms& u) const {
  const double h = epsilon_ > 0x1p-40 ? 0x1p-12 : 0x1p-26;
  std::array<Vec3, 2> slope{};
  for (int d = 0; d < dimension_; ++d) {
    const auto i = static_cast<std::size_t>(d);
    Uniforms beside = u;
    const double to = u[i] + h < 1 ? u[i] + h : u[i] - h;
    beside[i] = to;
    const auto there = at(beside);
    if (!there) return std::nullopt;
    slope[i] = scaled(sum(*there, scaled(here, -1)), 1 / (to - u[i]));
  }
  const Vec3 off = sum(x, scaled(here, -1));
  if (dimension_ == 1) return Uniforms{dot(slope[0], off) / dot(slope[0], slope[0]), 0, 0};
  const double a = dot(slope[0], slope[0]), b = dot(slope[0], slope[1]),
               c = dot(slope[1], slope[1]);
  const double p = dot(slope[0], off), q = dot(slope[1], off);
  const double det = a * c - b * b;
  return Uniforms{(c * p - b * q) / det, (a * q - b * p) / det, 0};
}

std::optional<Uniforms> BranchSearch::solve(const Vec3& x, Uniforms u) const {
  auto here = at(u);
  if (!here) return std::nullopt;
  double off = squared_distance(*here, x);
  const double enough = std::pow(64 * epsilon_, 2) * std::max(1.0, dot(x, x));
  for (int i = 0; i < kMaxSteps && off > enough; ++i) {
    const auto change = step(*here, x, u);
    if (!change || !std::isfinite((*change)[0]) || !std::isfinite((*change)[1]))
      return std::nullopt;
    double length = 1;
    bool nearer = false;
    for (int k = 0; k < kMaxHalvings && !nearer; ++k, length /= 2) {
      Uniforms next = u;
      for (std::size_t d = 0; d < static_cast<std::size_t>(dimension_); ++d) {
        // Not past the end: the root may lie just before it.
        const double to = u[d] + length * (*change)[d];
        next[d] = to <= 0 ? u[d] / 2 : to >= 1 ? (u[d] + 1 - epsilon_) / 2 : to;
      }
      const auto there = at(next);
      if (!there || !(squared_distance(*there, x) < off)) continue;
      nearer = true;
      u = next;
      here = there;
      off = squared_distance(*here, x);
    }
    if (!nearer) break;
  }
  // Rounding of the point itself may stop the search a little earlier.
  return off <= 256 * enough ? std::optional(u) : std::nullopt;
}

std::vector<Uniforms> BranchSearch::preimages(const Vec3& x, std::optional<Uniforms> known) const {
  std::vector<Uniforms> found;
  if (known) found.push_back(*known);
  const double same = epsilon_ > 0x1p-40 ? kSameInFloat : kSame;
  for (const Uniforms& start : starts(x)) {
    const auto u = solve(x, start);
    if (!u) continue;
    const bool seen = std::any_of(found.begin(), found.end(), [&](const Uniforms& other) {
      return std::abs(other[0] - (*u)[0]) < same && std::abs(other[1] - (*u)[1]) < same;
    });
    if (!seen) found.push_back(*u);
  }
  return found;
}

}  // namespace plumbline::verify
