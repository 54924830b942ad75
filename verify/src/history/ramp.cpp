#include "history/ramp.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::verify::history {

namespace {

/// Least squares of the two levels for given ends.
Ramp fit(std::span<const double> series, std::size_t last_before, std::size_t first_after) {
  const double n = static_cast<double>(series.size());
  const double length = static_cast<double>(first_after - last_before);
  const auto way = [&](std::size_t i) {
    const double along = static_cast<double>(i) - static_cast<double>(last_before);
    return std::clamp(along / length, 0.0, 1.0);
  };
  double mean_way = 0, mean = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    mean_way += way(i) / n;
    mean += series[i] / n;
  }
  double ways = 0, both = 0, squares = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double w = way(i) - mean_way, x = series[i] - mean;
    ways += w * w;
    both += w * x;
    squares += x * x;
  }
  const double slope = both / ways;
  Ramp ramp;
  ramp.last_before = last_before;
  ramp.first_after = first_after;
  ramp.before = mean - slope * mean_way;
  ramp.after = ramp.before + slope;
  ramp.squares = std::max(0.0, squares - slope * both);
  ramp.error = std::sqrt(ramp.squares / (n - 2) / ways);
  return ramp;
}

}  // namespace

Ramp best_ramp(std::span<const double> series, std::size_t shortest) {
  Ramp best;
  best.squares = std::numeric_limits<double>::infinity();
  for (std::size_t begin = 0; begin + shortest < series.size(); ++begin) {
    for (std::size_t end = begin + shortest; end < series.size(); ++end) {
      const Ramp ramp = fit(series, begin, end);
      if (ramp.squares < best.squares) best = ramp;
    }
  }
  return best;
}

}  // namespace plumbline::verify::history
