#pragma once

#include <vector>

namespace plumbline::bench {

/// A number with an interval around it.
struct Estimate {
  double value, low, high;
};

/// Median with a distribution-free interval of at least 95 % from order statistics (binomial, n ≥
/// 6); the range for fewer.
Estimate median_with_interval(std::vector<double> values);

/// Mean with a 95 % interval from Student's t; the mean alone for fewer than two.
Estimate mean_with_interval(const std::vector<double>& values);

}  // namespace plumbline::bench
