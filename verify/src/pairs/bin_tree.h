#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "pairs/mass_integral.h"

namespace plumbline::verify {

/// Bins of the unit square that follow a density: halved again and again at the median of pilot
/// points, alternating between the two dimensions. All nodes of one depth are bins of about equal
/// mass. Points in one place, or on a line, leave bins without area between them, or are cut off
/// from what lies beside them (`cut_at_median`).
class BinTree {
 public:
  /// @param points  pilot samples; reordered
  /// @param depth   2^depth finest bins
  /// @param dimension  1: only the first coordinate is cut
  /// @param resolution  rounding unit of the points
  BinTree(std::span<Point2> points, int depth, int dimension, double resolution);

  int depth() const { return depth_; }
  std::size_t bins() const { return std::size_t{1} << depth_; }

  /// Finest bin of a point. The bin at a coarser depth d is its index >> (depth − d).
  std::size_t locate(const Point2& p) const {
    std::size_t node = 1;
    for (int d = 0; d < depth_; ++d) {
      node = 2 * node + (p[cut_dimension(d)] < splits_[node] ? 0 : 1);
    }
    return node - bins();
  }

  /// Finest bins of many points.
  void locate(std::span<const Point2> points, std::span<std::size_t> bins) const;

  const Box& box(std::size_t bin) const { return boxes_[bin]; }

  /// The bins as cells, cut where lines run through along which the density may break.
  ///
  /// @param breaks  per dimension, ascending; left out in a bin that they cut into too many pieces
  std::vector<Cell> cells(const std::array<std::vector<double>, 2>& breaks) const;

 private:
  std::size_t cut_dimension(int level) const {
    return dimension_ == 1 ? 0 : static_cast<std::size_t>(level & 1);
  }
  void build(std::span<Point2> points, std::size_t node, int level, const Box& box);
  int depth_, dimension_;
  double resolution_;
  std::vector<double> splits_;  // heap order, root at 1
  std::vector<Box> boxes_;
};

}  // namespace plumbline::verify
