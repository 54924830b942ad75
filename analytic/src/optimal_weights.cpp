#include <algorithm>
#include <cmath>

#include <plumbline/analytic/estimator_moments.h>

#include "piecewise.h"

namespace plumbline::analytic {
namespace {

std::vector<double> cuts_of(const Integral1d& integral) {
  std::vector<double> edges = integral.breaks;
  for (const Density1d& density : integral.densities) {
    edges.push_back(density.low);
    edges.push_back(density.high);
  }
  return make_cuts(integral.low, integral.high, edges);
}

double mixture(const Integral1d& integral, const std::vector<double>& factors, double x) {
  double sum = 0;
  for (std::size_t k = 0; k < factors.size(); ++k)
    sum += factors[k] * integral.densities[k].pdf_x(x);
  return sum;
}

}  // namespace

OptimalSystem optimal_system(const Integral1d& integral, const std::vector<int>& counts) {
  const std::size_t count = integral.densities.size();
  const std::vector<double> cuts = cuts_of(integral);
  const std::vector<double> factors(counts.begin(), counts.end());
  const auto against = [&](std::size_t i, const std::function<double(double)>& g) {
    return integrate_pieces(
               [&](double x) {
                 const double sum = mixture(integral, factors, x);
                 return sum > 0 ? integral.densities[i].pdf_x(x) * (g(x) / sum) : 0;
               },
               cuts)
        .value;
  };
  OptimalSystem system;
  system.matrix.assign(count, std::vector<double>(count, 0));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i; k < count; ++k) {
      system.matrix[i][k] = system.matrix[k][i] = against(i, integral.densities[k].pdf_x);
    }
    system.vector.push_back(against(i, integral.f));
  }
  return system;
}

std::vector<double> best_fractions(const Integral1d& integral) {
  constexpr int kMaxSteps = 2000;
  constexpr double kConverged = 1e-9;
  const std::size_t count = integral.densities.size();
  const std::vector<double> cuts = cuts_of(integral);
  std::vector<double> alpha(count, 1.0 / static_cast<double>(count));
  for (int step = 0; step < kMaxSteps; ++step) {
    std::vector<double> next(count);
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Quadrature slope = integrate_pieces(
          [&](double x) {
            const double p = mixture(integral, alpha, x);
            const double ratio = p > 0 ? integral.f(x) / p : 0;
            return integral.densities[i].pdf_x(x) * ratio * ratio;
          },
          cuts);
      next[i] = alpha[i] * std::sqrt(slope.value);
      sum += next[i];
    }
    double change = 0;
    for (std::size_t i = 0; i < count; ++i) {
      next[i] /= sum;
      change = std::max(change, std::abs(next[i] - alpha[i]));
    }
    alpha = next;
    if (change < kConverged) break;
  }
  return alpha;
}

}  // namespace plumbline::analytic
