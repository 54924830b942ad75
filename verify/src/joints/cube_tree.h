#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "joints/cube.h"

namespace plumbline::verify {

/// Bins of the cube that follow a density: halved again and again at the median of pilot points, in
/// one dimension after the other. All nodes of one depth are bins of about equal mass.
class CubeTree {
 public:
  /// @param points  pilot samples; reordered
  /// @param depth   2^depth finest bins
  /// @param resolution  rounding unit of the points
  CubeTree(std::span<CubePoint> points, int depth, std::size_t dimension, double resolution);

  std::size_t bins() const { return boxes_.size(); }

  /// Finest bin of a point. The bin at a coarser depth d is its index >> (depth − d).
  std::size_t locate(const CubePoint& p) const;

  const CubeBox& box(std::size_t bin) const { return boxes_[bin]; }

 private:
  void build(std::span<CubePoint> points, std::size_t node, int level, const CubeBox& box);

  int depth_;
  std::size_t dimension_;
  double resolution_;
  std::vector<double> splits_;  // heap order, root at 1
  std::vector<CubeBox> boxes_;
};

}  // namespace plumbline::verify
