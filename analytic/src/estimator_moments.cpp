#include <plumbline/analytic/estimator_moments.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "piecewise.h"
#include "weight_breaks.h"

namespace plumbline::analytic {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// x is drawn from density `index` with this probability, and counts as `value(x)`.
struct Source {
  double probability = 1;
  std::size_t index = 0;
  std::function<double(double)> value;
};

/// ∫ p_i(x) g(x) dx over the support of p_i.
Quadrature expectation(const Integral1d& integral, std::size_t i, const std::vector<double>& breaks,
                       const std::function<double(double)>& g, double noise) {
  const Density1d& density = integral.densities[i];
  const auto integrand = [&](double x) {
    const double p = density.pdf_x(x);
    return p > 0 ? p * g(x) : 0;
  };
  return integrate_pieces(
      integrand,
      make_cuts(std::max(integral.low, density.low), std::min(integral.high, density.high), breaks),
      noise);
}

/// Moments of one draw from a mixture of sources, central ones about the mean: no cancellation, so
/// that a variance of 0 comes out as 0.
Moments draw_moments(const Integral1d& integral, const std::vector<Source>& sources,
                     std::vector<double> breaks) {
  breaks.insert(breaks.end(), integral.breaks.begin(), integral.breaks.end());
  for (const Density1d& density : integral.densities) {
    breaks.push_back(density.low);
    breaks.push_back(density.high);
  }
  const auto moment = [&](const std::function<double(double)>& of_value, double noise) {
    Quadrature sum;
    for (const Source& source : sources) {
      const Quadrature q = expectation(
          integral, source.index, breaks, [&](double x) { return of_value(source.value(x)); },
          noise);
      sum.value += source.probability * q.value;
      sum.error += source.probability * q.error;
    }
    return sum;
  };
  const double mean = moment([](double g) { return g; }, 1e-16 * integral.value).value;
  const auto central = [&](int k, double noise) {
    return moment([=](double g) { return std::pow(g - mean, k); }, noise);
  };
  // g − mean is a few ulp of the integral off: where g hardly varies, its powers are made of that.
  const Quadrature variance = central(2, 1e-17 * integral.value * integral.value);
  // The higher moments only say how many samples a check needs.
  const double sd = std::sqrt(variance.value);
  const auto higher = [&](int k) { return central(k, 1e-8 * std::pow(sd, k)).value; };
  return {mean, variance.value, higher(3), higher(4), higher(6), variance.error};
}

Moments infinite(double mean) { return {mean, kInfinity, kInfinity, kInfinity, kInfinity, 0}; }

/// Moments of the sum of independent terms, each `copies` times: the mean and all cumulants add.
/// With central moments m: κ₂ = m₂, κ₃ = m₃, κ₄ = m₄ − 3 m₂², κ₆ = m₆ − 15 m₄m₂ − 10 m₃² + 30 m₂³.
struct Term {
  Moments of_one;
  double copies = 1;
};

Moments sum_moments(const std::vector<Term>& terms) {
  Moments sum;
  double k4 = 0;
  double k6 = 0;
  for (const auto& [one, copies] : terms) {
    const double m2 = one.variance;
    sum.mean += copies * one.mean;
    sum.variance += copies * m2;
    sum.third += copies * one.third;
    sum.variance_error += copies * one.variance_error;
    k4 += copies * (one.fourth - 3 * m2 * m2);
    k6 += copies *
          (one.sixth - 15 * one.fourth * m2 - 10 * one.third * one.third + 30 * m2 * m2 * m2);
  }
  if (std::isinf(sum.variance)) return infinite(sum.mean);
  const double m2 = sum.variance;
  sum.fourth = k4 + 3 * m2 * m2;
  sum.sixth = k6 + 15 * k4 * m2 + 10 * sum.third * sum.third + 15 * m2 * m2 * m2;
  return sum;
}

Moments scaled(Moments moments, double factor) {
  moments.mean *= factor;
  moments.variance *= factor * factor;
  moments.third *= std::pow(factor, 3);
  moments.fourth *= std::pow(factor, 4);
  moments.sixth *= std::pow(factor, 6);
  moments.variance_error *= factor * factor;
  return moments;
}

std::vector<double> with_factors(const Integral1d& integral, const std::vector<double>& factors,
                                 double x) {
  std::vector<double> q(integral.densities.size());
  for (std::size_t k = 0; k < q.size(); ++k) q[k] = factors[k] * integral.densities[k].pdf_x(x);
  return q;
}

double total(const std::vector<double>& q) {
  double sum = 0;
  for (const double value : q) sum += value;
  return sum;
}

std::vector<double> as_factors(const std::vector<int>& counts) {
  return std::vector<double>(counts.begin(), counts.end());
}

/// Relative difference that rounding may leave between equal densities, with room to spare.
constexpr double kTie = 1e-12;

}  // namespace

double weight(const WeightRule& rule, const std::vector<double>& q, std::size_t i) {
  const double largest = *std::max_element(q.begin(), q.end());
  if (!(q[i] > 0)) return 0;
  const auto share = [&](const auto& of) {
    double sum = 0;
    for (const double value : q) sum += value > 0 ? of(value) : 0.0;
    return of(q[i]) / sum;
  };
  switch (rule.kind) {
    case WeightRule::Kind::balance:
      return share([](double v) { return v; });
    case WeightRule::Kind::power:
      return share([&](double v) { return std::pow(v / largest, rule.parameter); });
    case WeightRule::Kind::cutoff:
      return share([&](double v) { return v < rule.parameter * largest ? 0.0 : v; });
    case WeightRule::Kind::maximum:
      // Densities that are equal on paper may differ by their rounding (1/width of equal pieces).
      return share([&](double v) { return v >= largest * (1 - kTie) ? 1.0 : 0.0; });
  }
  return 0;
}

Moments single_moments(const Integral1d& integral, std::size_t i) {
  const Density1d& density = integral.densities[i];
  const auto ratio = [&](double x) { return integral.f(x) / density.pdf_x(x); };
  if (integral.infinite_variance[i]) {
    const Quadrature mean = integrate_pieces(
        integral.f, make_cuts(std::max(integral.low, density.low),
                              std::min(integral.high, density.high), integral.breaks));
    return infinite(mean.value);
  }
  return draw_moments(integral, {{1, i, ratio}}, {});
}

Moments plain_sum_moments(const Integral1d& integral) {
  std::vector<Term> terms;
  for (std::size_t i = 0; i < integral.densities.size(); ++i) {
    terms.push_back({single_moments(integral, i), 1});
  }
  return sum_moments(terms);
}

Moments naive_average_moments(const Integral1d& integral) {
  return scaled(plain_sum_moments(integral), 1.0 / static_cast<double>(integral.densities.size()));
}

Moments weighted_moments(const Integral1d& integral, const std::vector<int>& counts,
                         const std::function<double(std::size_t, double)>& weight_of,
                         const std::vector<double>& breaks) {
  std::vector<Term> terms;
  for (std::size_t i = 0; i < integral.densities.size(); ++i) {
    const double n = counts[i];
    const auto value = [&, i, n](double x) {
      return weight_of(i, x) * integral.f(x) / (n * integral.densities[i].pdf_x(x));
    };
    terms.push_back({draw_moments(integral, {{1, i, value}}, breaks), n});
  }
  return sum_moments(terms);
}

Moments multi_sample_moments(const Integral1d& integral, const WeightRule& rule,
                             const std::vector<int>& counts) {
  const std::vector<double> factors = as_factors(counts);
  return weighted_moments(
      integral, counts,
      [&](std::size_t i, double x) { return weight(rule, with_factors(integral, factors, x), i); },
      weight_breaks(integral, rule, factors));
}

Moments one_sample_moments(const Integral1d& integral, const WeightRule& rule,
                           const std::vector<double>& selection) {
  std::vector<Source> sources;
  for (std::size_t i = 0; i < integral.densities.size(); ++i) {
    sources.push_back({selection[i], i, [&, i](double x) {
                         const std::vector<double> q = with_factors(integral, selection, x);
                         return weight(rule, q, i) * integral.f(x) / q[i];
                       }});
  }
  return draw_moments(integral, sources, weight_breaks(integral, rule, selection));
}

Moments mixture_moments(const Integral1d& integral, const std::vector<double>& fractions) {
  std::vector<Source> sources;
  for (std::size_t i = 0; i < integral.densities.size(); ++i) {
    sources.push_back({fractions[i], i, [&](double x) {
                         return integral.f(x) / total(with_factors(integral, fractions, x));
                       }});
  }
  return draw_moments(integral, sources, {});
}

Moments control_variate_moments(const Integral1d& integral, const std::vector<int>& counts,
                                const std::vector<double>& alpha) {
  const std::vector<double> factors = as_factors(counts);
  const auto residual = [&](double x) {
    return (integral.f(x) - total(with_factors(integral, alpha, x))) /
           total(with_factors(integral, factors, x));
  };
  std::vector<Term> terms;
  for (std::size_t i = 0; i < integral.densities.size(); ++i) {
    terms.push_back({draw_moments(integral, {{1, i, residual}}, {}), factors[i]});
  }
  Moments moments = sum_moments(terms);
  moments.mean += total(alpha);
  return moments;
}

}  // namespace plumbline::analytic
