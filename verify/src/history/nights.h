#pragma once

#include <cstddef>
#include <vector>

#include <plumbline/verify/history/regressions.h>

namespace plumbline::verify::history {

/// The nights that a history is judged by.
struct KeptNights {
  std::vector<std::size_t> index;  ///< in the series
  std::vector<double> level;       ///< logarithm of the night's best value
  std::vector<std::size_t> odd;    ///< nights that were left out, in the series
};

/// Measured nights without those far from their neighbours on both sides.
///
/// @throws std::invalid_argument for a value that is not positive and finite
KeptNights keep_nights(const Series& series);

/// The nights on which a counter is another than the last time, as changes.
///
/// @throws std::invalid_argument for a value that is not finite or not the same all night
std::vector<Change> counter_changes(const Series& series);

/// A change without sizes and evidence: where it is, and the commits around it.
Change change_between(const Series& series, std::size_t last_before, std::size_t first_night,
                      std::size_t last_night);

/// Fills in the sizes.
void set_sizes(const Series& series, double before, double after, Change& change);

}  // namespace plumbline::verify::history
