#include "history/robust.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plumbline::verify::history {

double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

TrimmedMean trimmed_mean(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size(), cut = n / 5, kept = n - 2 * cut;
  TrimmedMean result;
  for (std::size_t i = cut; i < cut + kept; ++i) {
    result.mean += values[i] / static_cast<double>(kept);
  }
  // Winsorised: what was cut off counts as the outermost value that was kept.
  double sum = 0, squares = 0;
  for (const double value : values) {
    const double x = std::clamp(value, values[cut], values[n - 1 - cut]) - result.mean;
    sum += x;
    squares += x * x;
  }
  const double count = static_cast<double>(n);
  const double variance = (squares - sum * sum / count) / (count - 1);
  result.error = std::sqrt(std::max(0.0, variance)) * std::sqrt(count) / static_cast<double>(kept);
  result.degrees = static_cast<double>(kept - 1);
  return result;
}

}  // namespace plumbline::verify::history
