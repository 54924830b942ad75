#pragma once

#include <cstdint>
#include <string>

namespace plumbline::bench {

/// What a process of its own said about one point.
struct PointCost {
  double build_seconds = 0;    ///< wall clock, description to scene ready for rays
  double render_seconds = 0;   ///< CPU time on one thread, median of renders
  double peak_bytes = 0;       ///< largest resident set
  double process_seconds = 0;  ///< wall clock from start to end, seen from outside
};

/// Starts this program again for the point.
///
/// @throws std::runtime_error where it fails
PointCost run_scaling_point(const std::string& axis, std::uint64_t value);

}  // namespace plumbline::bench
