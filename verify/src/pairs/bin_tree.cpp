#include "pairs/bin_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::verify {

namespace {

/// Where one side of a bin is cut, and which piece holds the pilot points.
struct Cuts {
  std::vector<double> at;
  std::size_t core = 0;
};

// Sixteen uniform points rarely leave a gap of this share of their range.
constexpr double kClusterGap = 0.35;

/// The widest gap with two points or more on either side, as a share of the range in that
/// dimension.
struct Gap {
  double share = 0, middle = 0;
  std::size_t dimension = 0;
};

Gap largest_gap(const Cell& cell, std::vector<Point2>& points) {
  const auto begin = points.begin() + static_cast<std::ptrdiff_t>(cell.first);
  const auto end = points.begin() + static_cast<std::ptrdiff_t>(cell.last);
  Gap largest;
  if (end - begin < 4) return largest;
  for (std::size_t d = 0; d < 2; ++d) {
    std::sort(begin, end, [d](const Point2& a, const Point2& b) { return a[d] < b[d]; });
    const double range = (*(end - 1))[d] - (*begin)[d];
    if (!(range > 0)) continue;
    for (auto p = begin; p + 1 != end; ++p) {
      const double share = ((*(p + 1))[d] - (*p)[d]) / range;
      if (share > largest.share) largest = {share, ((*(p + 1))[d] + (*p)[d]) / 2, d};
    }
  }
  return largest;
}

std::size_t distance(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

/// Cuts a stretch without points in steps that grow fourfold from both ends to the middle: the
/// support may end close to either.
void cut_gap(double low, double high, double step, std::vector<double>& at) {
  const double middle = (low + high) / 2;
  std::vector<double> downwards;
  for (double s = step; low + s < middle; s *= 4) at.push_back(low + s);
  for (double s = step; high - s > middle; s *= 4) downwards.push_back(high - s);
  at.insert(at.end(), downwards.rbegin(), downwards.rend());
}

/// A length that the density may vary over: the range of the points, or for a single one its
/// distance from the nearer end.
double scale_of(double low, double high, double first_point, double last_point) {
  if (last_point > first_point) return last_point - first_point;
  const double nearer = std::min(first_point - low, high - last_point);
  return nearer > 0 ? nearer : (high - low) / 1024;
}

/// Pieces of [low, high]: the range of the points with a quarter of it on each side, and the
/// stretches to both ends. A support that ends within a piece shows at the nodes of the rule,
/// unless it ends in the outermost fortieth of it.
Cuts cut_around(double low, double high, double first_point, double last_point) {
  Cuts cuts;
  cuts.at = {low};
  if (last_point >= first_point) {
    const double range = scale_of(low, high, first_point, last_point);
    const double step = range / 4;
    if (first_point - step > low) {
      cut_gap(low, first_point - step, step, cuts.at);
      cuts.at.push_back(first_point - step);
    }
    cuts.core = cuts.at.size() - 1;
    if (last_point + step < high) {
      cuts.at.push_back(last_point + step);
      cut_gap(last_point + step, high, step, cuts.at);
    }
  }
  cuts.at.push_back(high);
  return cuts;
}

/// Range of the points of a cell, empty: low > high.
Box range_of(const Cell& cell, const std::vector<Point2>& points) {
  Box range{cell.box.high, cell.box.low};
  for (std::size_t i = cell.first; i < cell.last; ++i) {
    for (std::size_t d = 0; d < 2; ++d) {
      range.low[d] = std::min(range.low[d], points[i][d]);
      range.high[d] = std::max(range.high[d], points[i][d]);
    }
  }
  return range;
}

void add_cells(const std::vector<Point2>& points, const Cell& whole, std::vector<Cell>& cells) {
  std::array<Cuts, 2> cuts;
  const Box range = range_of(whole, points);
  for (std::size_t d = 0; d < 2; ++d) {
    cuts[d] = cut_around(whole.box.low[d], whole.box.high[d], range.low[d], range.high[d]);
  }
  const double mass =
      static_cast<double>(whole.last - whole.first) / static_cast<double>(points.size());
  for (std::size_t i = 0; i + 1 < cuts[0].at.size(); ++i) {
    for (std::size_t j = 0; j + 1 < cuts[1].at.size(); ++j) {
      Cell cell{{{cuts[0].at[i], cuts[1].at[j]}, {cuts[0].at[i + 1], cuts[1].at[j + 1]}},
                whole.bin};
      if (!(cell.box.low[0] < cell.box.high[0] && cell.box.low[1] < cell.box.high[1])) continue;
      const std::size_t steps = distance(i, cuts[0].core) + distance(j, cuts[1].core);
      if (steps == 0) {
        cell.first = whole.first;
        cell.last = whole.last;
      }
      cell.doubt = mass * std::exp2(-2.0 * static_cast<double>(steps));
      cells.push_back(cell);
    }
  }
}

/// Both sides of a cell, with their points.
std::array<Cell, 2> cut_at(const Cell& cell, std::size_t d, double place,
                           std::vector<Point2>& points) {
  std::array<Cell, 2> sides{cell, cell};
  const auto cut = std::partition(points.begin() + static_cast<std::ptrdiff_t>(cell.first),
                                  points.begin() + static_cast<std::ptrdiff_t>(cell.last),
                                  [&](const Point2& p) { return p[d] < place; });
  sides[0].last = sides[1].first = static_cast<std::size_t>(cut - points.begin());
  sides[0].box.high[d] = sides[1].box.low[d] = place;
  return sides;
}

}  // namespace

void add_cells_of_even_points(const Cell& cell, std::vector<Point2>& points,
                              std::vector<Cell>& cells) {
  constexpr std::size_t kFewest = 6;  // fewer leave half of a cell by chance
  std::optional<std::size_t> uneven;
  const Box range = range_of(cell, points);
  for (std::size_t d = 0; d < 2 && cell.last - cell.first >= kFewest; ++d) {
    const double width = range.high[d] - range.low[d];
    // Points that are all equal would never part.
    if (width > 0 && width < (cell.box.high[d] - cell.box.low[d]) / 2) uneven = d;
  }
  const Gap gap = largest_gap(cell, points);
  if (!uneven && gap.share >= kClusterGap) uneven = gap.dimension;
  if (!uneven) {
    cells.push_back(cell);
    return;
  }
  const double middle = (cell.box.low[*uneven] + cell.box.high[*uneven]) / 2;
  for (const Cell& half : cut_at(cell, *uneven, middle, points)) {
    add_cells_of_even_points(half, points, cells);
  }
}

void add_cells_around_points(const Cell& cell, std::vector<Point2>& points,
                             std::vector<Cell>& cells) {
  const Gap gap = largest_gap(cell, points);
  if (gap.share >= kClusterGap) {
    const auto [low, high] = cut_at(cell, gap.dimension, gap.middle, points);
    if (low.first < low.last && high.first < high.last) {  // else neighbouring numbers: no room
      add_cells_around_points(low, points, cells);
      add_cells_around_points(high, points, cells);
      return;
    }
  }
  add_cells(points, cell, cells);
}

BinTree::BinTree(std::vector<Point2>& points, int depth, int dimension)
    : depth_(depth),
      dimension_(dimension),
      splits_(std::size_t{1} << depth),
      boxes_(std::size_t{1} << depth),
      first_((std::size_t{1} << depth) + 1, points.size()) {
  build(points, 0, points.size(), 1, 0, Box{});
}

void BinTree::build(std::vector<Point2>& points, std::size_t first, std::size_t last,
                    std::size_t node, int level, const Box& box) {
  if (level == depth_) {
    boxes_[node - bins()] = box;
    first_[node - bins()] = first;
    return;
  }
  const std::size_t d = cut_dimension(level);
  const std::size_t middle = first + (last - first) / 2;
  double split = (box.low[d] + box.high[d]) / 2;
  if (first < last) {
    const auto at = [&](std::size_t i) { return points.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last),
                     [d](const Point2& a, const Point2& b) { return a[d] < b[d]; });
    split = points[middle][d];
  }
  splits_[node] = split;
  Box low = box, high = box;
  low.high[d] = high.low[d] = split;
  build(points, first, middle, 2 * node, level + 1, low);
  build(points, middle, last, 2 * node + 1, level + 1, high);
}

std::vector<Cell> BinTree::cells(std::size_t bin, std::optional<double> break_line,
                                 std::vector<Point2>& points) const {
  const Cell whole{boxes_[bin], bin, first_[bin], first_[bin + 1], 0};
  if (!break_line || !(whole.box.low[0] < *break_line && *break_line < whole.box.high[0])) {
    return {whole};
  }
  auto [low, high] = cut_at(whole, 0, *break_line, points);
  // Nodes on the line itself would be on neither side; so thin a gap holds nothing.
  constexpr double kGap = 0x1p-51;
  low.box.high[0] -= kGap;
  high.box.low[0] += kGap;
  // A piece that no point of the bin is in may still hold a part of its mass.
  const double mass =
      static_cast<double>(whole.last - whole.first) / static_cast<double>(points.size());
  for (Cell* piece : {&low, &high}) {
    if (piece->first == piece->last) piece->doubt = mass / 4;
  }
  return {low, high};
}

}  // namespace plumbline::verify
