#include "piecewise.h"

#include <algorithm>
#include <cmath>

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace plumbline::analytic {

namespace {

using Smooth = std::function<double(double)>;

constexpr double kTolerance = 1e-13;  // relative to the whole piece
constexpr int kMaxRefinements = 16;

/// One application of the rule. On [−1, 1], because Boost 1.74 states the error per unit of length.
Quadrature apply_rule(const Smooth& f, double a, double b) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  const double middle = 0.5 * (a + b);
  const double half = 0.5 * (b - a);
  Quadrature result;
  result.value = half * Rule::integrate([&](double t) { return f(middle + half * t); }, -1.0, 1.0,
                                        0, 0.0, &result.error);
  result.error *= half;
  return result;
}

Quadrature refine(const Smooth& f, double a, double b, const Quadrature& coarse, double tolerance,
                  int refinements) {
  if (coarse.error <= tolerance || refinements == 0) return coarse;
  const double middle = 0.5 * (a + b);
  const Quadrature left =
      refine(f, a, middle, apply_rule(f, a, middle), 0.5 * tolerance, refinements - 1);
  const Quadrature right =
      refine(f, middle, b, apply_rule(f, middle, b), 0.5 * tolerance, refinements - 1);
  return {left.value + right.value, left.error + right.error};
}

}  // namespace

Quadrature integrate_smooth(const Smooth& f, double a, double b, double noise) {
  const Quadrature coarse = apply_rule(f, a, b);
  return refine(f, a, b, coarse, std::max(kTolerance * std::abs(coarse.value), noise),
                kMaxRefinements);
}

Quadrature integrate_pieces(const Smooth& f, const std::vector<double>& cuts, double noise) {
  Quadrature sum;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const Quadrature piece = integrate_smooth(f, cuts[i - 1], cuts[i], noise);
    sum.value += piece.value;
    sum.error += piece.error;
  }
  return sum;
}

std::vector<double> make_cuts(double low, double high, const std::vector<double>& inner) {
  std::vector<double> cuts = {low, high};
  for (const double x : inner) {
    if (x > low && x < high) cuts.push_back(x);
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

}  // namespace plumbline::analytic
