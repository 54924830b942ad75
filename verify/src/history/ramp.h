#pragma once

#include <cstddef>
#include <span>

namespace plumbline::verify::history {

/// A level, a straight way to another level, and that.
struct Ramp {
  std::size_t last_before = 0;  ///< last value at the old level
  std::size_t first_after = 0;  ///< first value at the new one
  double before = 0, after = 0;
  double squares = 0;  ///< what is left of the squared deviations
  double error = 0;    ///< standard error of after − before
};

/// The ramp that fits a series best, of those that take at least `shortest` steps.
///
/// @param series  at least `shortest` + 1 values, and four
Ramp best_ramp(std::span<const double> series, std::size_t shortest);

}  // namespace plumbline::verify::history
