#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "pairs/cell_fit.h"

/// Cells of an integral that are halved where they are off.
namespace plumbline::verify {

/// A point whose value shows where to halve cells.
struct PilotPoint {
  Point2 p{};
  double density = 0, value = 0;
};

// What a cell's uniform nodes are at least, and as if while cells are made.
inline constexpr double kNodesPerCell = 1;

/// Pilot points, those of a bin next to each other and in their order.
class PilotsOfBins {
 public:
  /// @param bins  that the points lie in
  PilotsOfBins(const std::vector<PilotPoint>& points, const std::vector<std::size_t>& bins,
               std::size_t count_of_bins);

  std::span<const PilotPoint> of(std::size_t bin) const {
    return std::span(points_).subspan(first_[bin], first_[bin + 1] - first_[bin]);
  }

 private:
  std::vector<PilotPoint> points_;
  std::vector<std::size_t> first_;  // of each bin, and the end
};

/// Random nodes over the square in one round: evenly, and of the pair's own.
struct NodesInRound {
  double spread = 0, own = 0;

  /// Of a node by the balance heuristic.
  ///
  /// @param of_cell      uniform nodes of its cell, per unit of the square
  /// @param own_density  of own samples there
  double weight(double of_cell, double own_density) const {
    return 1 / (of_cell + spread + own * own_density);
  }
};

/// A cell to be made.
struct CellPlan {
  Box box;
  std::size_t bin = 0;
  std::size_t first = 0, last = 0;  // of the pilot points inside
};

/// A cell, halved or not.
struct TreeCell {
  Box box;
  std::size_t bin;
  CellFit fit;
  std::size_t first = 0, last = 0;  // of the pilot points inside
  double key = 0;                   // standard deviation that it is expected to add
  double measured = 0;              // the same, squared, as nodes have shown it
  std::size_t halves = 0;           // index of the lower half, 0: a leaf
  std::size_t cut = 0;              // dimension, and where
  double at = 0;

  /// What the cell is expected to add to the error, from the nodes of its fit and from the pilot
  /// points in it, and how to halve it.
  void choose_cut(std::span<const PilotPoint> inside, int dimension, const NodesInRound& nodes);

  bool can_be_halved() const { return at > box.low[cut] && at < box.high[cut]; }
};

}  // namespace plumbline::verify
