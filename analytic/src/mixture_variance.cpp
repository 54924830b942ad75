#include <plumbline/analytic/mixture_variance.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>
#include <limits>
#include <vector>

#include "piecewise.h"

namespace plumbline::analytic {
namespace {

/// ∫ f² g(p₁, p₂) over the integral's domain, between all places where f or a density jumps.
template <class G>
double integrate_square(const Integral1d& integral, const G& g) {
  std::vector<double> breaks = integral.breaks;
  for (const Density1d& density : integral.densities) {
    breaks.push_back(density.low);
    breaks.push_back(density.high);
  }
  const auto integrand = [&](double x) {
    const double f = integral.f(x);
    return f > 0 ? f * f * g(integral.densities[0].pdf_x(x), integral.densities[1].pdf_x(x)) : 0;
  };
  return integrate_pieces(integrand, make_cuts(integral.low, integral.high, breaks)).value;
}

double slope(const Integral1d& integral, double alpha) {
  return integrate_square(integral, [alpha](double p1, double p2) {
    const double p = alpha * p1 + (1 - alpha) * p2;
    return (p2 - p1) / (p * p);
  });
}

}  // namespace

MixtureVariance mixture_variance(const Integral1d& integral, double alpha) {
  MixtureVariance result;
  result.variance =
      integrate_square(
          integral, [alpha](double p1, double p2) { return 1 / (alpha * p1 + (1 - alpha) * p2); }) -
      integral.value * integral.value;
  result.slope = slope(integral, alpha);
  result.curvature = integrate_square(integral, [alpha](double p1, double p2) {
    const double p = alpha * p1 + (1 - alpha) * p2;
    return 2 * (p2 - p1) * (p2 - p1) / (p * p * p);
  });
  return result;
}

double best_share(const Integral1d& integral, double low, double high) {
  const auto f = [&](double alpha) { return slope(integral, alpha); };
  const double at_low = f(low), at_high = f(high);
  if (!(at_low < 0)) return low;
  if (!(at_high > 0)) return high;
  std::uintmax_t steps = 100;
  const auto bracket = boost::math::tools::toms748_solve(
      f, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(40), steps);
  return 0.5 * (bracket.first + bracket.second);
}

double second_moment(const Integral1d& integral, std::size_t i) {
  const Density1d& density = integral.densities[i];
  if (integral.infinite_variance[i] || density.low > integral.low || density.high < integral.high) {
    return std::numeric_limits<double>::infinity();
  }
  return integrate_square(integral, [i](double p1, double p2) { return 1 / (i == 0 ? p1 : p2); });
}

}  // namespace plumbline::analytic
