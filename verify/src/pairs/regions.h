#pragma once

#include <cstddef>
#include <vector>

#include <plumbline/verify/detail/domain.h>
#include <plumbline/verify/detail/random.h>

#include "pairs/bin_tree.h"

namespace plumbline::verify {

/// A domain cut into a few regions that hold about equally many samples each, and points spread
/// over it whose density follows the samples roughly, is known exactly and is 0 nowhere: an
/// integral is estimated there without asking any pdf under test.
class Regions {
 public:
  /// Cells do not straddle the domain's breaks: a few points just above a horizon would stand for
  /// all that is below it. They are halved where samples lie on one side of them: far out in the
  /// tails of a narrow lobe a cell that holds a hundredth of the samples holds most of the domain,
  /// and nearly all of the hundredth in a corner.
  ///
  /// @param pilot  samples; where there are few, regions are halves of each other
  /// @param depth  2^depth regions, ≤ kFineDepth
  /// @throws std::invalid_argument for a discrete domain
  Regions(const Domain& domain, const std::vector<Vec3>& pilot, int depth);

  std::size_t count() const { return std::size_t{1} << depth_; }

  /// Region of a point.
  std::size_t locate(const Vec3& x) const;

  /// Middle of a region, in the chart's square.
  Vec3 center(std::size_t region) const;

  struct Point {
    Vec3 x{};
    double inverse_density = 0;  ///< of x, in the domain's measure
    std::size_t region = 0;
  };
  Point draw(Random& random) const;

  /// 1/density of `draw` at a point.
  double inverse_density(const Vec3& x) const;

 private:
  static constexpr int kFineDepth = 7;

  /// Part of a finest bin, halved or not; points are even within a leaf.
  struct Piece {
    Box box{};
    std::size_t bin = 0;
    std::size_t halves = 0;  ///< index of the lower half, 0: a leaf
    std::size_t cut = 0;     ///< dimension in which it is halved
    double samples = 0;      ///< of the pilot's
    double probability = 0;  ///< of a leaf: that of `draw` to choose it
    double up_to = 0;        ///< the same with all leaves before it
  };

  static std::vector<Point2> in_square(const Domain& domain, const std::vector<Vec3>& pilot);
  std::size_t root_of(const Point2& p) const;
  std::size_t leaf_of(const Point2& p) const;
  void halve(std::size_t at, const std::vector<Point2>& samples, int depth);
  void choose_probabilities();

  Domain domain_;
  std::vector<Point2> pilot_;  // as the tree has reordered it
  BinTree tree_;
  int depth_;
  std::vector<Piece> pieces_;             // those of the bins first, sorted by bin
  std::vector<std::size_t> first_piece_;  // of each bin
  std::vector<std::size_t> leaves_;
};

}  // namespace plumbline::verify
