#include "statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstddef>

namespace plumbline::bench {

Estimate median_with_interval(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const double median = n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
  // P(x_(k) > median) = P(fewer than k of n below it): the largest k with both tails under 2.5 %.
  const boost::math::binomial_distribution<double> below(static_cast<double>(n), 0.5);
  std::size_t k = 0;
  while (k + 1 < n / 2 && boost::math::cdf(below, static_cast<double>(k)) <= 0.025) ++k;
  if (k > 0) --k;
  return {median, values[k], values[n - 1 - k]};
}

Estimate mean_with_interval(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0;
  for (const double v : values) mean += v / n;
  if (values.size() < 2) return {mean, mean, mean};
  double sum_squares = 0;
  for (const double v : values) sum_squares += (v - mean) * (v - mean);
  const double t = boost::math::quantile(boost::math::students_t(n - 1), 0.975);
  const double half = t * std::sqrt(sum_squares / (n - 1) / n);
  return {mean, mean - half, mean + half};
}

}  // namespace plumbline::bench
