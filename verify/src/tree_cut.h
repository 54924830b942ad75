#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace plumbline::verify {

/// Where a node of a tree of bins is cut.
struct TreeCut {
  double split = 0;        ///< points below it go to the low side, others to the high one
  std::size_t middle = 0;  ///< of the node's points the first on the high side
};

/// How far points of one value are from the next one where it is not rounding that put them there,
/// in rounding units.
inline constexpr double kTieRoundings = 64;

/// Cuts a node at the median of its points along dimension d; in the middle where it has none.
///
/// Many points of one value are a clamp, an atom or the corner of a cell. Cut at that value, they
/// lie at the low edge of the high side, whose mass is right where the samples above were moved
/// down to it (min(x, c)); cut above it, the low side's is right where those below were moved up.
/// So odd nodes are cut above the value, half-way to the next one, and all nodes that begin with
/// it, where the other cut would leave nothing below. Values that rounding makes alike lie close to
/// the next one, and are cut at.
///
/// @param points      of the node, along dimension d from `low` to `high`; reordered
/// @param resolution  rounding unit of the points, relative to an extent of 1
template <class Point>
TreeCut cut_at_median(std::span<Point> points, std::size_t d, double low, double high,
                      double resolution, std::size_t node) {
  constexpr std::size_t kFewestTies = 16;
  if (points.empty()) return {(low + high) / 2, 0};
  const std::size_t middle = points.size() / 2;
  std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(middle),
                   points.end(), [d](const Point& a, const Point& b) { return a[d] < b[d]; });
  const double median = points[middle][d];
  const auto ties = static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [&](const Point& p) { return p[d] == median; }));
  if (ties < kFewestTies || 4 * ties < points.size() || (median > low && node % 2 == 0)) {
    return {median, middle};
  }
  double next = high;
  for (const Point& p : points.subspan(middle)) {
    if (p[d] > median) next = std::min(next, p[d]);
  }
  const double above = (median + next) / 2;
  if (above - median <= kTieRoundings * resolution) return {median, middle};
  const auto high_side =
      std::partition(points.begin(), points.end(), [&](const Point& p) { return p[d] < above; });
  return {above, static_cast<std::size_t>(high_side - points.begin())};
}

}  // namespace plumbline::verify
