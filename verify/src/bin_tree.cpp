#include "bin_tree.h"

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

Gap largest_gap(std::vector<Point2>::iterator begin, std::vector<Point2>::iterator end) {
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

void add_cells(const std::vector<Point2>& points, const Cell& whole, std::vector<Cell>& cells) {
  std::array<Cuts, 2> cuts;
  for (std::size_t d = 0; d < 2; ++d) {
    double low = whole.box.high[d], high = whole.box.low[d];
    for (std::size_t i = whole.first; i < whole.last; ++i) {
      low = std::min(low, points[i][d]);
      high = std::max(high, points[i][d]);
    }
    cuts[d] = cut_around(whole.box.low[d], whole.box.high[d], low, high);
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

void add_clusters(std::vector<Point2>& points, const Cell& whole, std::vector<Cell>& cells) {
  const auto begin = points.begin() + static_cast<std::ptrdiff_t>(whole.first);
  const auto end = points.begin() + static_cast<std::ptrdiff_t>(whole.last);
  const Gap gap = largest_gap(begin, end);
  if (gap.share < kClusterGap) {
    add_cells(points, whole, cells);
    return;
  }
  const auto cut =
      std::partition(begin, end, [&](const Point2& p) { return p[gap.dimension] < gap.middle; });
  if (cut == begin || cut == end) {  // neighbouring numbers: no room for a cut
    add_cells(points, whole, cells);
    return;
  }
  Cell low = whole, high = whole;
  low.last = high.first = static_cast<std::size_t>(cut - points.begin());
  low.box.high[gap.dimension] = high.box.low[gap.dimension] = gap.middle;
  add_clusters(points, low, cells);
  add_clusters(points, high, cells);
}

}  // namespace

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

Cell BinTree::cell(std::size_t bin) const {
  return {boxes_[bin], bin, first_[bin], first_[bin + 1], 0};
}

void BinTree::add_cells_around_points(std::size_t bin, std::vector<Point2>& points,
                                      std::vector<Cell>& cells) const {
  add_clusters(points, cell(bin), cells);
}

}  // namespace plumbline::verify
