#pragma once

#include <array>
#include <cstddef>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "pairs/mass_integral.h"
#include "pairs/tree_cell.h"

namespace plumbline::verify {

/// Cells that can be halved, by what that is worth: the largest key first.
class CellQueue : public std::priority_queue<std::pair<double, std::size_t>> {
 public:
  /// The numbers of the first ones, those that have been halved since left out.
  std::vector<std::size_t> first(std::size_t count, const std::vector<TreeCell>& cells) const;
};

/// Both parts of a cell, where it would be cut.
std::array<Box, 2> halves_of(const TreeCell& cell);

/// The values that fits on the halves of cells take. Where code answers in spans, a call costs more
/// than values do: with those of one cell others are asked for that are likely to follow.
class HalvesAhead {
 public:
  HalvesAhead(const Many<double(Point2)>& integrand, int dimension)
      : integrand_(integrand), dimension_(dimension) {}

  /// At the points of both halves of a cell.
  ///
  /// @param queue  of the cells that are likely to be halved next
  std::vector<double> take(std::size_t index, const std::vector<TreeCell>& cells,
                           const CellQueue& queue);

 private:
  struct Known {
    std::size_t cut = 0;
    double at = 0;
    std::vector<double> values;
  };

  bool knows(std::size_t index, const TreeCell& cell) const;
  void ask_for(const std::vector<std::size_t>& asked, const std::vector<TreeCell>& cells);

  const Many<double(Point2)>& integrand_;
  int dimension_;
  std::size_t ahead_ = 0;  // cells; twice as many with each call, so that few are in vain
  std::unordered_map<std::size_t, Known> known_;
};

}  // namespace plumbline::verify
