#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "pairs/cubature.h"

namespace plumbline::verify {

struct EdgeEstimate {
  double value = 0;
  double across = 0;  ///< error along the lines
  double beside = 0;  ///< error from line to line
  std::uint64_t evaluations = 0;
};

/// Integral over a box through which the edge of f's support runs: along lines of dimension
/// `across`, on each of which the edge is found by bisection.
///
/// Towards an edge the nodes are squared together, so that a density that jumps there and one that
/// goes like 1/√distance (the silhouette of a sphere) are both smooth to the rule.
///
/// @source Kronrod 1965: 7 nodes around the 3 of Gauss, whose difference is the error
EdgeEstimate integrate_across_edge(const std::function<double(const Point2&)>& f, const Box& box,
                                   std::size_t across);

}  // namespace plumbline::verify
