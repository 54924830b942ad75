#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <plumbline/verify/detail/domain.h>

namespace plumbline::verify {

struct Box {
  Point2 low{0, 0}, high{1, 1};
};

/// A box to integrate over, and which result it adds to.
struct Cell {
  Box box;
  std::size_t bin = 0;

  /// Pilot points inside: [first, last) of the integrator's list. A cell whose rule shows much less
  /// than its points promise is split however well the rule agrees with itself: all nodes can miss
  /// a thin support.
  std::size_t first = 0, last = 0;

  /// What may hide here although all nodes agree: a thin support, of which the pilot points show
  /// the neighbourhood. Counts as error where the rule gives 0 or an edge of the support is near.
  double doubt = 0;

  /// The same of an edge that was seen beside this cell, and may run through it past all nodes.
  double edge_doubt = 0;
};

struct CubatureResult {
  std::vector<double> value;  ///< per bin
  std::vector<double> error;  ///< per bin, sum of the cells' estimates: far above the true error
  double total = 0;

  /// Of `total`: 2 √Σe² + Σe/20 over the cells. Where the integrand is smooth the true error is
  /// far below a twentieth of the rule's estimate e; at edges of the support it is about e with
  /// random sign.
  double total_error = 0;
  std::uint64_t evaluations = 0;
  bool finite = true;  ///< every value of the integrand was
};

/// Whether f is 0 at a node of the rule on this box: the edge of the support may run through.
bool shows_zero(const std::function<double(const Point2&)>& f, const Box& box);

/// Integrates f over cells, refining where the error is largest until `total_error` ≤ target or the
/// evaluations are spent.
///
/// @source Genz, Malik 1980 (J. Comput. Appl. Math. 6:4): degree 7 with embedded degree 5, 17
/// points in
///         two dimensions, split along the larger fourth difference
/// @param points  pilot points, distributed about like f; reordered
CubatureResult integrate(const std::function<double(const Point2&)>& f,
                         const std::vector<Cell>& cells, std::vector<Point2>& points,
                         std::size_t bins, double target, std::uint64_t max_evaluations);

}  // namespace plumbline::verify
