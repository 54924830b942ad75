#include "weight_breaks.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include <boost/math/tools/roots.hpp>

#include "piecewise.h"

namespace plumbline::analytic {
namespace {

/// Zeros of a function that is continuous on [low, high], each bracketed on a grid first.
void add_roots(const std::function<double(double)>& f, double low, double high,
               std::vector<double>& roots) {
  // The densities here cross each other a few times per piece at most: a grid of 200 separates
  // them.
  constexpr int kGrid = 200;
  // Densities jump at the ends of a piece: stay inside it.
  const double margin = 1e-12 * (high - low);
  double a = low + margin;
  double fa = f(a);
  for (int i = 1; i <= kGrid; ++i) {
    const double b = i == kGrid ? high - margin : low + (high - low) * i / kGrid;
    const double fb = f(b);
    // Zero on a whole stretch, for equal densities, is no crossing.
    if (fb == 0 && fa != 0) roots.push_back(b);
    if (fa * fb < 0) {
      std::uintmax_t iterations = 200;
      const auto bracket = boost::math::tools::toms748_solve(
          f, a, b, fa, fb, boost::math::tools::eps_tolerance<double>(52), iterations);
      roots.push_back(0.5 * (bracket.first + bracket.second));
    }
    a = b;
    fa = fb;
  }
}

}  // namespace

std::vector<double> weight_breaks(const Integral1d& integral, const WeightRule& rule,
                                  const std::vector<double>& factors) {
  std::vector<double> roots;
  std::vector<double> thresholds;
  if (rule.kind == WeightRule::Kind::maximum) thresholds = {1};
  if (rule.kind == WeightRule::Kind::cutoff) thresholds = {1, rule.parameter, 1 / rule.parameter};
  if (thresholds.empty()) return roots;

  std::vector<double> edges = integral.breaks;
  for (const Density1d& density : integral.densities) {
    edges.push_back(density.low);
    edges.push_back(density.high);
  }
  const std::vector<double> cuts = make_cuts(integral.low, integral.high, edges);
  const std::size_t count = integral.densities.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i + 1; k < count; ++k) {
      for (const double threshold : thresholds) {
        const auto difference = [&](double x) {
          return factors[i] * integral.densities[i].pdf_x(x) -
                 threshold * factors[k] * integral.densities[k].pdf_x(x);
        };
        for (std::size_t c = 1; c < cuts.size(); ++c) {
          add_roots(difference, cuts[c - 1], cuts[c], roots);
        }
      }
    }
  }
  return roots;
}

}  // namespace plumbline::analytic
