#include "allocation_bias.h"

#include <algorithm>
#include <cmath>

namespace plumbline::bench {
namespace {

// A BSDF sample that hits the limb of a light, a rounding error outside the cone that light samples
// fill, has the density of one technique only. One in 2e7 does, and in the second moment of its
// pixel it is hundreds of standard deviations, where all others are within ten. Events beyond this
// are left out of the exact moment, and, as many times larger as there are more samples behind
// that, of the drawn one, so that the expectation of their difference stays 0.
constexpr double kFirefly = 12;

constexpr double kNormal95 = 1.9600, kNormal999 = 3.2905;  // half-widths, in standard errors

/// Subtracts the multiple of the control that explains most of the values.
void subtract_control(std::vector<double>& values, const std::vector<double>& control) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    product += values[i] * control[i];
    square += control[i] * control[i];
  }
  if (!(square > 0)) return;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= product / square * control[i];
}

/// Mean of independent values.
Estimate mean_by_spread(const std::vector<double>& values, double half_width) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  const double half = half_width * std::sqrt(squares / (n - 1) / n);
  return {mean, mean - half, mean + half};
}

}  // namespace

std::vector<PixelUnit> pixel_units(const std::vector<PixelIntegrals>& pilot, int width,
                                   double samples) {
  const auto emission = [](const PixelIntegrals& pixel) { return pixel.emission; };
  std::vector<PixelUnit> units(pilot.size());
  for (std::size_t i = 0; i < pilot.size(); ++i) {
    const PixelIntegrals& pixel = pilot[i];
    const double own = equal_variance(pixel);
    const double largest = largest_around(pilot, width, i, equal_variance);
    // The integrals are kept in float, which leaves 6e-8 μ² of rounding in their variance.
    if (largest_around(pilot, width, i, emission) > 0 || !(own > 0.1 * largest) ||
        !(own > 1e-5 * pixel.mean * pixel.mean)) {
      continue;
    }
    units[i] = {std::sqrt(own / samples), pixel.mean / static_cast<double>(pixel.moment[kEqual])};
  }
  return units;
}

void RenderErrors::add(const renderer::RenderResult& result, const std::vector<PixelUnit>& units,
                       const std::vector<PixelIntegrals>& exact,
                       const std::vector<double>& exact_variance, double exact_samples) {
  const std::size_t iterations = result.bsdf_counts.size() / units.size();
  const auto judged = static_cast<std::size_t>(std::count_if(
      units.begin(), units.end(), [](const PixelUnit& unit) { return unit.deviation > 0; }));
  for (std::vector<double>* sums : {&moments_, &squares_, &predicted_}) sums->resize(judged);
  std::vector<double>& errors = errors_.emplace_back();
  for (std::size_t i = 0; i < units.size(); ++i) {
    const double unit = units[i].deviation;
    if (!(unit > 0)) continue;
    const renderer::PixelMoments& pixel = result.film.pixels()[i];
    const double x = luminance(pixel.mean), n = pixel.count;
    double moment = 0, variance = 0;
    for (std::size_t j = 0; j < iterations; ++j) {
      const std::size_t k = result.bsdf_counts[i * iterations + j];
      moment += static_cast<double>(exact[i].moment[k]) / static_cast<double>(iterations);
      fixed_counts_ = fixed_counts_ && k == kEqual;
      variance += exact[i].count_variance(k) / (n * static_cast<double>(iterations));
    }
    const std::size_t at = errors.size();
    errors.push_back((x - exact[i].mean) / unit);
    // All surfaces are grey: the squared luminance is the luminance of the squares.
    const double drawn_moment = luminance(pixel.sum_squares) / n + x * x;
    const double off = (drawn_moment - moment) * units[i].per_square / unit;
    if (off > -kFirefly && off < kFirefly * exact_samples / n) moments_[at] += off;
    squares_[at] += errors.back() * errors.back();
    predicted_[at] += (variance + exact_variance[i]) / (unit * unit);
  }
}

std::vector<double> RenderErrors::mean_error(int renders) const {
  std::vector<double> mean(moments_.size());
  for (std::size_t r = 0; r < static_cast<std::size_t>(renders); ++r) {
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += errors_[r][i] / renders;
  }
  return mean;
}

RenderCheck RenderErrors::result(const std::string& method, const RenderErrors& anchor) const {
  std::vector<double> error = mean_error(renders());
  std::vector<double> control = anchor.mean_error(renders());
  const std::vector<double> all = anchor.mean_error(anchor.renders());
  for (std::size_t i = 0; i < control.size(); ++i) control[i] -= all[i];
  subtract_control(error, fixed_counts_ ? moments_ : control);

  double squares = 0, predicted = 0;
  for (const double s : squares_) squares += s;
  for (const double p : predicted_) predicted += p;
  const double ratio = squares / predicted;
  std::vector<double> residuals;  // of a ratio of sums, to first order
  for (std::size_t i = 0; i < squares_.size(); ++i) {
    residuals.push_back((squares_[i] - ratio * predicted_[i]) /
                        (predicted / static_cast<double>(squares_.size())));
  }
  const Estimate spread = mean_by_spread(residuals, kNormal95);
  return {method,
          renders(),
          mean_by_spread(error, kNormal999),
          {ratio, ratio + spread.low, ratio + spread.high}};
}

}  // namespace plumbline::bench
