#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace plumbline::verify {

/// Values of a coordinate that many samples share, as a density does not give them: a clamp, an
/// atom that is not said to be one, places of which the cell is drawn and the place within it is
/// not. Bins may hide them: of min(u, c) the one that holds c and all above has the right mass.
struct SharedValues {
  double share = 0;    ///< of the samples
  double example = 0;  ///< the value that most share
  std::size_t count = 0;
};

/// @param values      of one coordinate, each in [0, 1]
/// @param resolution  rounding unit of the samples
SharedValues shared_values(const std::vector<double>& values, double resolution);

/// Share of points that have a coordinate in common with many others: the largest of all
/// coordinates.
template <class Point>
double share_on_lines(const std::vector<Point>& points, std::size_t dimension, double resolution) {
  double share = 0;
  for (std::size_t d = 0; d < dimension; ++d) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const Point& p : points) values.push_back(p[d]);
    share = std::max(share, shared_values(values, resolution).share);
  }
  return share;
}

}  // namespace plumbline::verify
