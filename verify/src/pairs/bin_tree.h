#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pairs/cubature.h"

namespace plumbline::verify {

/// Bins of the unit square that follow a density: halved again and again at the median of pilot
/// points, alternating between the two dimensions. All nodes of one depth are bins of about equal
/// mass.
class BinTree {
 public:
  /// @param points  pilot samples; reordered so that each cell's are in a row
  /// @param depth   2^depth finest bins
  /// @param dimension  1: only the first coordinate is cut
  BinTree(std::vector<Point2>& points, int depth, int dimension);

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

  const Box& box(std::size_t bin) const { return boxes_[bin]; }

  /// A bin as one cell with its pilot points, or as two where the break line runs through.
  std::vector<Cell> cells(std::size_t bin, std::optional<double> break_line,
                          std::vector<Point2>& points) const;

 private:
  std::size_t cut_dimension(int level) const {
    return dimension_ == 1 ? 0 : static_cast<std::size_t>(level & 1);
  }
  void build(std::vector<Point2>& points, std::size_t first, std::size_t last, std::size_t node,
             int level, const Box& box);
  int depth_, dimension_;
  std::vector<double> splits_;  // heap order, root at 1
  std::vector<Box> boxes_;
  std::vector<std::size_t> first_;  // of a bin's points; one more than bins
};

/// A cell halved until no piece has its points in one half of it, or in two clusters: what they
/// crowd around may be narrower than any rule on the whole cell sees. Appended to `cells`.
void add_cells_of_even_points(const Cell& cell, std::vector<Point2>& points,
                              std::vector<Cell>& cells);

/// A cell cut around clusters of its pilot points and then in growing steps to its edges, so that a
/// support that ends somewhere inside is not missed. Appended to `cells`.
void add_cells_around_points(const Cell& cell, std::vector<Point2>& points,
                             std::vector<Cell>& cells);

}  // namespace plumbline::verify
