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
    for (auto p = begin + 1; p + 2 != end; ++p) {
      const double share = ((*(p + 1))[d] - (*p)[d]) / range;
      if (share > largest.share) largest = {share, ((*(p + 1))[d] + (*p)[d]) / 2, d};
    }
  }
  return largest;
}

std::size_t distance(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

/// Pieces of [low, high]: the range of the points with a quarter of it on each side, then outwards
/// in steps that grow fourfold. A support that ends within a piece shows at the nodes of the rule,
/// unless it ends within the first fortieth of it.
Cuts cut_around(double low, double high, double first_point, double last_point) {
  Cuts cuts;
  cuts.at = {low, high};
  if (!(last_point >= first_point)) return cuts;
  const double range = last_point > first_point ? last_point - first_point : (high - low) / 64;
  if (!(range > 0)) return cuts;
  std::vector<double> below, above;
  const double step = range / 4;
  double start = first_point - step, end = last_point + step;
  for (double s = step; start > low; s *= 4) {
    below.push_back(start);
    start -= 4 * s;
  }
  for (double s = step; end < high; s *= 4) {
    above.push_back(end);
    end += 4 * s;
  }
  cuts.at = {low};
  cuts.at.insert(cuts.at.end(), below.rbegin(), below.rend());
  cuts.core = cuts.at.size() - 1;
  cuts.at.insert(cuts.at.end(), above.begin(), above.end());
  cuts.at.push_back(high);
  return cuts;
}

}  // namespace

BinTree::BinTree(std::vector<Point2>& points, int depth)
    : depth_(depth), splits_(std::size_t{1} << depth), boxes_(std::size_t{1} << depth) {
  build(points, 0, points.size(), 1, 0, Box{});
}

void BinTree::build(std::vector<Point2>& points, std::size_t first, std::size_t last,
                    std::size_t node, int level, const Box& box) {
  if (level == depth_) {
    boxes_[node - bins()] = box;
    add_clusters(points, first, last, node - bins(), box);
    return;
  }
  const std::size_t d = static_cast<std::size_t>(level & 1);
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

void BinTree::add_clusters(std::vector<Point2>& points, std::size_t first, std::size_t last,
                           std::size_t bin, const Box& box) {
  const auto begin = points.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = points.begin() + static_cast<std::ptrdiff_t>(last);
  const Gap gap = largest_gap(begin, end);
  if (gap.share < kClusterGap) {
    add_cells(points, first, last, bin, box);
    return;
  }
  const auto cut =
      std::partition(begin, end, [&](const Point2& p) { return p[gap.dimension] < gap.middle; });
  const std::size_t middle = static_cast<std::size_t>(cut - points.begin());
  Box low = box, high = box;
  low.high[gap.dimension] = high.low[gap.dimension] = gap.middle;
  add_clusters(points, first, middle, bin, low);
  add_clusters(points, middle, last, bin, high);
}

void BinTree::add_cells(const std::vector<Point2>& points, std::size_t first, std::size_t last,
                        std::size_t bin, const Box& box) {
  std::array<Cuts, 2> cuts;
  for (std::size_t d = 0; d < 2; ++d) {
    double low = box.high[d], high = box.low[d];
    for (std::size_t i = first; i < last; ++i) {
      low = std::min(low, points[i][d]);
      high = std::max(high, points[i][d]);
    }
    cuts[d] = cut_around(box.low[d], box.high[d], low, high);
  }
  const double mass = static_cast<double>(last - first) / static_cast<double>(points.size());
  for (std::size_t i = 0; i + 1 < cuts[0].at.size(); ++i) {
    for (std::size_t j = 0; j + 1 < cuts[1].at.size(); ++j) {
      Cell cell{{{cuts[0].at[i], cuts[1].at[j]}, {cuts[0].at[i + 1], cuts[1].at[j + 1]}}, bin};
      if (!(cell.box.low[0] < cell.box.high[0] && cell.box.low[1] < cell.box.high[1])) continue;
      if (i == cuts[0].core && j == cuts[1].core) {
        cell.first = first;
        cell.last = last;
      }
      // Of 16 points in a bin, a sixteenth of its mass may lie beyond the outermost.
      const std::size_t steps = distance(i, cuts[0].core) + distance(j, cuts[1].core);
      cell.doubt = mass * std::exp2(-2.0 * static_cast<double>(steps));
      cells_.push_back(cell);
    }
  }
}

}  // namespace plumbline::verify
