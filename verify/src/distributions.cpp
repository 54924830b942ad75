#include "distributions.h"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace plumbline::verify {

namespace bm = boost::math;

double normal_tail(double z) {
  if (std::isnan(z)) return z;
  if (std::isinf(z)) return z > 0 ? 0.0 : 1.0;
  return bm::cdf(bm::complement(bm::normal(), z));
}

double normal_quantile(double level) { return bm::quantile(bm::complement(bm::normal(), level)); }

double student_quantile(double level, double degrees) {
  return bm::quantile(bm::complement(bm::students_t(degrees), level));
}

double student_two_sided(double t, double degrees) {
  if (std::isnan(t)) return t;
  if (std::isinf(t)) return 0.0;
  return 2 * bm::cdf(bm::complement(bm::students_t(degrees), std::abs(t)));
}

double chi_square_tail(double x, double degrees) {
  if (std::isnan(x)) return x;
  if (std::isinf(x)) return 0.0;
  return bm::cdf(bm::complement(bm::chi_squared(degrees), x));
}

double chi_square_quantile(double level, double degrees) {
  return bm::quantile(bm::complement(bm::chi_squared(degrees), level));
}

double beta_quantile(double probability, double a, double b) {
  return bm::quantile(bm::beta_distribution<>(a, b), probability);
}

double binomial_at_least(double hits, double trials, double probability) {
  // P(X ≥ k) = I_p(k, n − k + 1).
  return bm::ibeta(hits, trials - hits + 1, probability);
}

double binomial_two_sided(double hits, double trials, double probability) {
  if (!(probability > 0)) return hits > 0 ? 0.0 : 1.0;
  if (!(probability < 1)) return hits < trials ? 0.0 : 1.0;
  const double above = hits > 0 ? binomial_at_least(hits, trials, probability) : 1.0;
  const double below =
      hits < trials ? binomial_at_least(trials - hits, trials, 1 - probability) : 1.0;
  return std::min(1.0, 2 * std::min(above, below));
}

double pearson_tail(double x, double degrees, double sum_of_inverse_expected) {
  const double scale = 1 + sum_of_inverse_expected / (2 * degrees);
  return chi_square_tail(x / scale, degrees / scale);
}

double noncentrality_limit(double x, double degrees, double level) {
  if (!(x < std::numeric_limits<double>::max())) return std::numeric_limits<double>::infinity();
  // So far out λ is x to all digits that matter, and Boost's series would not end.
  if (x > 1e7 * std::max(1.0, degrees)) return x;
  if (bm::cdf(bm::chi_squared(degrees), x) <= level) return 0.0;
  // P(X ≤ x | λ) falls with λ: bisection, since Boost 1.74's own search stops early for large x.
  double low = 0, high = 4 * x + 100;
  for (int i = 0; i < 100 && high - low > 1e-6 * high; ++i) {
    const double middle = (low + high) / 2;
    const bool above = bm::cdf(bm::non_central_chi_squared(degrees, middle), x) > level;
    (above ? low : high) = middle;
  }
  return high;
}

}  // namespace plumbline::verify
