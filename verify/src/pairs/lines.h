#pragma once

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
SharedValues shared_values(std::vector<double> values, double resolution);

}  // namespace plumbline::verify
