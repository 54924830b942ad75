#include <cmath>

#include <plumbline/analytic/integral1d.h>

namespace plumbline::analytic {
namespace {

struct Integrand {
  std::string name;
  std::function<double(double)> f;
  std::vector<double> breaks;
  double value;
};

std::vector<Integrand> integrands() {
  return {
      {"x^2", [](double x) { return x * x; }, {}, 1.0 / 3},
      {"1 - x + x^3", [](double x) { return 1 - x + x * x * x; }, {}, 0.75},
      {"30 x^2 (1 - x)^2", [](double x) { return 30 * x * x * (1 - x) * (1 - x); }, {}, 1},
      {"e^x", [](double x) { return std::exp(x); }, {}, std::expm1(1)},
      {"e^(-5 x)", [](double x) { return std::exp(-5 * x); }, {}, -std::expm1(-5) / 5},
      {"1 on [0, 0.3), 4 on [0.3, 1]", [](double x) { return x < 0.3 ? 1.0 : 4.0; }, {0.3}, 3.1},
      {"x on [0, 0.5), 2 - x on [0.5, 1]",
       [](double x) { return x < 0.5 ? x : 2 - x; },
       {0.5},
       0.75},
  };
}

struct DensitySet {
  std::string name;
  std::vector<Density1d> densities;
};

/// Each set covers [0, 1]; several of its members alone do not.
std::vector<DensitySet> density_sets() {
  const std::vector<Density1d> overlap = {uniform_density(0, 0.6), uniform_density(0.4, 1)};
  std::vector<Density1d> eight;
  eight.reserve(8);
  for (int i = 0; i < 8; ++i) eight.push_back(uniform_density(0.1 * i, 0.1 * i + 0.3));
  return {
      {"uniform + rising", {uniform_density(0, 1), rising_density(1)}},
      {"rising + falling", {rising_density(1), falling_density(2)}},
      {"two overlapping halves", overlap},
      {"uniform + exponential + last third",
       {uniform_density(0, 1), exponential_density(-4, 0, 1), uniform_density(2.0 / 3, 1)}},
      {"rising + falling + Gaussian + uniform",
       {rising_density(2), falling_density(1), truncated_gaussian_density(0.4, 0.15, 0, 1),
        uniform_density(0, 1)}},
      {"eight overlapping pieces", eight},
  };
}

}  // namespace

const std::vector<Integral1d>& combination_integrals() {
  static const std::vector<Integral1d> integrals = [] {
    std::vector<Integral1d> all;
    for (const Integrand& integrand : integrands()) {
      for (const DensitySet& set : density_sets()) {
        Integral1d integral;
        integral.name = integrand.name + " by " + set.name;
        integral.formula = integrand.name;
        const auto f = integrand.f;
        integral.f = [f](double x) { return x >= 0 && x <= 1 ? f(x) : 0; };
        integral.breaks = integrand.breaks;
        integral.value = integrand.value;
        integral.densities = set.densities;
        integral.infinite_variance.assign(set.densities.size(), false);
        all.push_back(integral);
      }
    }
    return all;
  }();
  return integrals;
}

}  // namespace plumbline::analytic
