#include <plumbline/reports/power_fit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace plumbline::reports {
namespace {

struct LogPoint {
  double x, y, weight;
};

/// Points that have a logarithm, with a common weight of 1 unless every error is known.
std::vector<LogPoint> usable_points(std::span<const PowerFitPoint> points, bool& errors_known) {
  std::vector<LogPoint> usable;
  errors_known = true;
  for (const PowerFitPoint& point : points) {
    if (!(point.x > 0 && point.y > 0 && std::isfinite(point.x) && std::isfinite(point.y))) continue;
    const bool known = point.log_y_error > 0 && std::isfinite(point.log_y_error);
    errors_known = errors_known && known;
    const double weight = known ? 1 / (point.log_y_error * point.log_y_error) : 0;
    usable.push_back({std::log(point.x), std::log(point.y), weight});
  }
  if (!errors_known) {
    for (LogPoint& point : usable) point.weight = 1;
  }
  return usable;
}

}  // namespace

PowerFit fit_power(std::span<const PowerFitPoint> points) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  bool errors_known = false;
  const std::vector<LogPoint> usable = usable_points(points, errors_known);
  const double n = static_cast<double>(usable.size());

  double weights = 0, mean_x = 0, mean_y = 0;
  for (const LogPoint& p : usable) {
    weights += p.weight;
    mean_x += p.weight * p.x;
    mean_y += p.weight * p.y;
  }
  mean_x /= weights;
  mean_y /= weights;
  double sxx = 0, sxy = 0;
  for (const LogPoint& p : usable) {
    sxx += p.weight * (p.x - mean_x) * (p.x - mean_x);
    sxy += p.weight * (p.x - mean_x) * (p.y - mean_y);
  }
  // One abscissa alone may differ from its mean by rounding: compare the abscissas themselves.
  const bool distinct = std::any_of(usable.begin(), usable.end(),
                                    [&](const LogPoint& p) { return p.x != usable.front().x; });
  if (!distinct) return {kNaN, kNaN, kNaN, static_cast<int>(usable.size())};

  const double slope = sxy / sxx;
  const double intercept = mean_y - slope * mean_x;
  double scatter = 1;
  if (!errors_known) {
    double residuals = 0;
    for (const LogPoint& p : usable) {
      const double r = p.y - intercept - slope * p.x;
      residuals += r * r;
    }
    scatter = n > 2 ? residuals / (n - 2) : kNaN;
  }
  return {std::exp(intercept), slope, std::sqrt(scatter / sxx), static_cast<int>(usable.size())};
}

}  // namespace plumbline::reports
