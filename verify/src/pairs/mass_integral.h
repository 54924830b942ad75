#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <plumbline/verify/detail/many.h>

#include "pairs/cell_fit.h"

namespace plumbline::verify {

/// Samples of the pair itself, on the square: fewer than were asked for where some are rejected, or
/// atoms.
using OwnSamples = std::vector<Point2>;

/// A box to integrate over, and which result it adds to.
struct Cell {
  Box box;
  std::size_t bin = 0;
};

/// What is to be integrated, and what may be spent on it.
struct MassQuestion {
  /// Per unit of the square. Finite; what is not, counts as 0 and is reported.
  Many<double(Point2)> integrand;

  /// Density of the pair's own samples per unit of the square; empty: it is the integrand.
  Many<double(Point2)> density;

  /// Draws that many samples more. Empty: there are none, only uniform nodes.
  std::function<OwnSamples(std::size_t count)> draw_own;

  /// Which bins points of the square lie in; empty: there is one bin.
  std::function<void(std::span<const Point2>, std::span<std::size_t>)> bins_at;
  std::size_t bins = 1;

  int dimension = 2;       ///< 1: the integrand depends on the first coordinate alone
  double target = 2.5e-5;  ///< error of the total at 99.9 % after which nothing more is spent
  /// The same, where the target is out of reach: above it all that may be spent is.
  double good_enough = 0;
  std::uint64_t max_evaluations = 4'000'000;
  std::size_t own = 1 << 16;     ///< samples of the pair's own in each round
  std::size_t spread = 1 << 14;  ///< random nodes, evenly over the square, in each round
  std::uint64_t seed = 1;
};

/// Integrals over bins, unbiased, with their sampling error.
struct MassIntegral {
  std::vector<double> value;     ///< per bin
  std::vector<double> variance;  ///< of `value`, per bin
  double total = 0;
  double variance_of_total = 0;
  double largest_term = 0;  ///< largest contribution of one random node to the total
  bool finite = true;       ///< every value of the integrand was
  std::uint64_t evaluations = 0;
  std::size_t cells = 0;

  /// Share of the square that a spike may take and still be missed by all nodes once in 1,000
  /// times.
  double unseen = 0;

  /// |total − truth| ≤ this with probability 1 − level.
  ///
  /// @source Maurer, Pontil 2009 (COLT), Theorem 4, with the second moment in the place of the
  ///         variance, which it exceeds, and the largest term seen in the place of its bound
  double error(double level) const;
};

/// Integrates by a fit on adaptive cells, and corrects the fit by random nodes.
///
/// No finite number of evaluations certifies an integral of a function of which nothing is known.
/// The cells are therefore not trusted: their fit g is a control variate, and f − g is estimated at
/// random nodes that no cell was made from, which makes the sum unbiased whatever f does between
/// the nodes of a cell. Where f is smooth f − g is next to nothing; where it jumps the variance
/// says so.
///
/// The nodes are a multiple importance sample by the balance heuristic: uniform ones in each cell,
/// uniform ones over the square, and samples of the pair itself, whose density is that of the pair
/// if the pair is right. A spike that own samples cover adds at most 1/own each, however narrow;
/// one that none of them covers shows in the uniform nodes. Cells in which the nodes contradict the
/// fit are refined, and new nodes drawn.
///
/// @source Owen, Zhou 2000 (JASA 95:449): control variates with a mixture of densities ·
///         Veach, Guibas 1995: the balance heuristic
MassIntegral integrate_mass(const MassQuestion& question, const std::vector<Cell>& cells);

}  // namespace plumbline::verify
