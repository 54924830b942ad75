#include <plumbline/renderer/core/light/environment_map.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace plumbline::renderer {

EnvironmentTable::EnvironmentTable(int w, int h, std::vector<Rgbf> image, bool compensation)
    : width(w), height(h), pixels(std::move(image)) {
  const auto row_length = static_cast<std::size_t>(width);
  const auto row_count = static_cast<std::size_t>(height);
  assert(pixels.size() == row_length * row_count);
  const auto luminances = [&](std::size_t row) {
    std::vector<double> values(row_length);
    for (std::size_t i = 0; i < row_length; ++i) {
      values[i] = luminance(rgb_cast<double>(pixels[row * row_length + i]));
    }
    return values;
  };
  // Share of the sphere that a row covers: (cosθ_top − cosθ_bottom)/2.
  const auto share = [&](std::size_t row) {
    const double half_step = pi<double>() / (2 * height);
    return std::sin((2 * static_cast<double>(row) + 1) * half_step) * std::sin(half_step);
  };

  mean_luminance = 0;
  double largest = 0;
  for (std::size_t row = 0; row < row_count; ++row) {
    const std::vector<double> values = luminances(row);
    mean_luminance += share(row) * std::accumulate(values.begin(), values.end(), 0.0) / width;
    for (const double value : values) largest = std::max(largest, value);
  }
  // A map that is the same everywhere has nothing above its mean but rounding.
  const double floor = compensation && largest > mean_luminance * (1 + 1e-6) ? mean_luminance : 0.0;

  std::vector<double> row_weights(row_count);
  columns.reserve(row_count);
  for (std::size_t row = 0; row < row_count; ++row) {
    std::vector<double> weights = luminances(row);
    for (double& weight : weights) weight = std::max(weight - floor, 0.0);
    row_weights[row] = share(row) * std::accumulate(weights.begin(), weights.end(), 0.0);
    columns.emplace_back(weights);
  }
  rows = DiscreteDistribution(row_weights);
}

}  // namespace plumbline::renderer
