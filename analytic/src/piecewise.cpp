#include "piecewise.h"

#include <algorithm>

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace plumbline::analytic {

Quadrature integrate_smooth(const std::function<double(double)>& f, double a, double b) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  constexpr unsigned kMaxRefinements = 12;
  constexpr double kTolerance = 1e-12;
  const double middle = 0.5 * (a + b);
  const double half = 0.5 * (b - a);
  // On [−1, 1], because Boost 1.74 compares an error per unit of length with a tolerance on the
  // integral: on a short interval it would refine to the end, and report an error far too large.
  Quadrature result;
  result.value = half * Rule::integrate([&](double t) { return f(middle + half * t); }, -1.0, 1.0,
                                        kMaxRefinements, kTolerance, &result.error);
  result.error *= half;
  return result;
}

Quadrature integrate_pieces(const std::function<double(double)>& f,
                            const std::vector<double>& cuts) {
  Quadrature sum;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const Quadrature piece = integrate_smooth(f, cuts[i - 1], cuts[i]);
    sum.value += piece.value;
    sum.error += piece.error;
  }
  return sum;
}

std::vector<double> make_cuts(double low, double high, std::vector<double> inner) {
  std::vector<double> cuts = {low, high};
  for (const double x : inner) {
    if (x > low && x < high) cuts.push_back(x);
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

}  // namespace plumbline::analytic
