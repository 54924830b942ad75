#include "pairs/bin_tree.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "tree_cut.h"

namespace plumbline::verify {

namespace {

// A bin that stated lines cut into more pieces than that is left whole: its nodes see the jumps.
constexpr std::size_t kMostPieces = 256;

/// Ends of the pieces of [low, high].
std::vector<double> pieces(double low, double high, const std::vector<double>& breaks) {
  std::vector<double> ends{low};
  const auto first = std::upper_bound(breaks.begin(), breaks.end(), low);
  const auto last = std::lower_bound(first, breaks.end(), high);
  ends.insert(ends.end(), first, last);
  ends.push_back(high);
  return ends;
}

}  // namespace

BinTree::BinTree(std::span<Point2> points, int depth, int dimension, double resolution)
    : depth_(depth),
      dimension_(dimension),
      resolution_(resolution),
      splits_(std::size_t{1} << depth),
      boxes_(std::size_t{1} << depth) {
  build(points, 1, 0, Box{});
}

void BinTree::build(std::span<Point2> points, std::size_t node, int level, const Box& box) {
  if (level == depth_) {
    boxes_[node - bins()] = box;
    return;
  }
  const std::size_t d = cut_dimension(level);
  const TreeCut cut = cut_at_median(points, d, box.low[d], box.high[d], resolution_, node);
  splits_[node] = cut.split;
  Box low = box, high = box;
  low.high[d] = high.low[d] = cut.split;
  build(points.first(cut.middle), 2 * node, level + 1, low);
  build(points.subspan(cut.middle), 2 * node + 1, level + 1, high);
}

void BinTree::locate(std::span<const Point2> points, std::span<std::size_t> bins) const {
  // Level by level, without a branch: which half a point lies in is a coin that no predictor knows,
  // and the points of one group do not wait for each other's splits.
  constexpr std::size_t kTogether = 16;
  std::array<std::size_t, kTogether> nodes{};
  for (std::size_t first = 0; first < points.size(); first += kTogether) {
    const std::size_t count = std::min(kTogether, points.size() - first);
    nodes.fill(1);
    for (int level = 0; level < depth_; ++level) {
      const std::size_t d = cut_dimension(level);
      for (std::size_t i = 0; i < count; ++i) {
        const bool low = points[first + i][d] < splits_[nodes[i]];
        nodes[i] = 2 * nodes[i] + 1 - static_cast<std::size_t>(low);
      }
    }
    for (std::size_t i = 0; i < count; ++i) bins[first + i] = nodes[i] - this->bins();
  }
}

std::vector<Cell> BinTree::cells(const std::array<std::vector<double>, 2>& breaks) const {
  std::vector<Cell> cells;
  for (std::size_t bin = 0; bin < bins(); ++bin) {
    const Box& box = boxes_[bin];
    const std::vector<double> x = pieces(box.low[0], box.high[0], breaks[0]);
    const std::vector<double> y = pieces(box.low[1], box.high[1], breaks[1]);
    if ((x.size() - 1) * (y.size() - 1) > kMostPieces) {
      cells.push_back({box, bin});
      continue;
    }
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      for (std::size_t j = 0; j + 1 < y.size(); ++j) {
        cells.push_back({{{x[i], y[j]}, {x[i + 1], y[j + 1]}}, bin});
      }
    }
  }
  return cells;
}

}  // namespace plumbline::verify
