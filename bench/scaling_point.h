#pragma once

#include <cstdint>
#include <string>

namespace plumbline::bench {

/// What a process of its own said about one point.
struct PointCost {
  double build_seconds = 0;   ///< wall clock, description to scene ready for rays
  double render_seconds = 0;  ///< CPU time on one thread, median of renders
  double peak_bytes = 0;      ///< largest resident set
};

/// Starts this program again for the point.
///
/// @throws std::runtime_error where it fails
PointCost run_scaling_point(const std::string& axis, std::uint64_t value);

/// Wall clock from the start of `plumbline render` to its end, seen from outside: the Cornell box,
/// 64 × 64 pixels with one sample each, to an EXR file that is removed again.
///
/// @throws std::runtime_error where it fails
double first_picture_seconds();

}  // namespace plumbline::bench
