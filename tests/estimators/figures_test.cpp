#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <boost/math/distributions/chi_squared.hpp>

#include <plumbline/renderer/estimators/estimators.h>
#include <plumbline/reports/results.h>
#include <plumbline/verify/detail/budget.h>
#include <plumbline_tests/figures.h>
#include <plumbline_tests/support.h>

#include "estimator_cases.h"
#include "integral_problem.h"

// The figures of the page: what is integrated, sampled and weighted, and how fast the errors fall.
namespace plumbline::tests {
namespace {

using analytic::Integral1d;
using reports::Figure;
using reports::FigureSeries;
using reports::SeriesStyle;

constexpr int kReplicates = 64;

/// In a log per integral.
void publish(const Figure& figure) {
  tests::publish(figure, figure.title.substr(0, figure.title.find(':')));
}

Figure figure_of(const Integral1d& integral, const std::string& what) {
  Figure figure;
  figure.group = "Integrals with known answers";
  figure.title = integral.name + ": " + what;
  return figure;
}

/// "p1" for the first of p.
std::string numbered(std::string symbol, std::size_t i) {
  return symbol.append(std::to_string(i + 1));
}

/// Places to draw curves at. Where a density covers a sliver at the low end, spaced by factors.
struct Grid {
  std::vector<double> x;
  bool log = false;
};

Grid grid_of(const Integral1d& integral) {
  Grid grid;
  grid.log = integral.name == "sun_and_sidewalk";
  // On the line nothing is to be seen beyond five standard deviations.
  const double low = std::max(integral.low, -5.0);
  const double high = std::min(integral.high, 5.0);
  constexpr int kSteps = 240;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = static_cast<double>(k) / kSteps;
    grid.x.push_back(grid.log ? std::pow(10, -7 * (1 - t)) : low + t * (high - low));
  }
  return grid;
}

template <class F>
FigureSeries curve(std::string name, SeriesStyle style, const std::vector<double>& x, F y) {
  FigureSeries series;
  series.name = std::move(name);
  series.style = style;
  series.x = x;
  for (const double at : x) series.y.push_back(y(at));
  return series;
}

void publish_densities(const Integral1d& integral) {
  const Grid grid = grid_of(integral);
  Figure figure = figure_of(integral, "integrand and densities");
  figure.caption = integral.formula +
                   ". The integrand is divided by its integral: a density that lies on it has no "
                   "variance, one that falls below it far from its own peak has much.";
  figure.x = {"x", grid.log};
  figure.y = {"density [1/unit of x]", integral.name != "two_steps"};
  figure.series.push_back(curve("f / its integral", SeriesStyle::line, grid.x,
                                [&](double x) { return integral.f(x) / integral.value; }));
  for (std::size_t i = 0; i < integral.densities.size(); ++i) {
    figure.series.push_back(curve(numbered("p", i) + ": " + integral.densities[i].name,
                                  SeriesStyle::dashed, grid.x, integral.densities[i].pdf_x));
  }
  publish(figure);
}

void publish_weights(const Integral1d& integral) {
  const Grid grid = grid_of(integral);
  const IntegralProblem<double> problem(integral);
  Figure figure = figure_of(integral, "MIS weights");
  figure.caption =
      "Weight of each technique, one sample of each: balance drawn through, power 2 dashed.";
  figure.x = {"x", grid.log};
  figure.y = {"weight", false};
  for (const auto heuristic : {renderer::Heuristic::balance, renderer::Heuristic::power}) {
    const bool balance = heuristic == renderer::Heuristic::balance;
    for (std::size_t i = 0; i < problem.size(); ++i) {
      const auto weight = [&](double x) {
        std::vector<renderer::TechniqueDensity<double>> densities;
        for (std::size_t k = 0; k < problem.size(); ++k) densities.push_back(problem.density(k, x));
        return renderer::mis_weight(
            heuristic, std::span<const renderer::TechniqueDensity<double>>(densities), i);
      };
      figure.series.push_back(curve(
          numbered("w", i), balance ? SeriesStyle::line : SeriesStyle::dashed, grid.x, weight));
    }
  }
  publish(figure);
}

/// Mean squared error after growing numbers of estimates, over independent runs.
struct ErrorCurve {
  std::vector<int> estimates;
  std::vector<double> squared;  ///< mean over kReplicates runs
};

ErrorCurve measure(const EstimatorCase& c) {
  ErrorCurve curve;
  for (int n = 4; n <= 4096; n *= 4) curve.estimates.push_back(n);
  curve.squared.assign(curve.estimates.size(), 0);
  for (int r = 0; r < kReplicates; ++r) {
    verify::Random random(check_seed(c.subject() + "/error"), static_cast<std::uint64_t>(r));
    double sum = 0;
    int drawn = 0;
    for (std::size_t k = 0; k < curve.estimates.size(); ++k) {
      for (; drawn < curve.estimates[k]; ++drawn) sum += c.draw(random);
      const double error = sum / drawn - c.value;
      curve.squared[k] += error * error / kReplicates;
    }
  }
  return curve;
}

double exact_squared_error(const EstimatorCase& c, int estimates) {
  const double bias = c.exact.mean - c.value;
  return c.exact.variance / estimates + bias * bias;
}

/// Whether the mean of so many estimates is near enough to normal that squared errors of runs
/// follow a chi-square: finite variance, no bias, and an excess kurtosis that the averaging has
/// removed.
bool errors_are_normal(const EstimatorCase& c, int estimates) {
  const double kurtosis = c.exact.fourth / (c.exact.variance * c.exact.variance);
  return std::abs(c.exact.mean / c.value - 1) < 1e-9 && kurtosis < 0.25 * estimates;
}

void expect_on_the_line(const EstimatorCase& c, const ErrorCurve& curve) {
  const int n = curve.estimates.back();
  if (!errors_are_normal(c, n)) return;
  const boost::math::chi_squared distribution(kReplicates);
  const double ratio = kReplicates * curve.squared.back() / exact_squared_error(c, n);
  // An excess kurtosis of 0.25 makes the squares vary by 6 % more, which takes 1e-12 to 1e-11.
  const double level = verify::ErrorBudget{}.fail_level() / 100;
  EXPECT_GT(boost::math::cdf(distribution, ratio), level) << c.subject();
  EXPECT_GT(boost::math::cdf(complement(distribution, ratio)), level) << c.subject();
}

void add_error_curve(const EstimatorCase& c, Figure& figure) {
  const ErrorCurve measured = measure(c);
  FigureSeries points, line;
  points.name = line.name = c.featured;
  line.style = SeriesStyle::dashed;
  const boost::math::chi_squared distribution(kReplicates);
  const double widest = std::sqrt(kReplicates / boost::math::quantile(distribution, 0.0005));
  const double narrowest = std::sqrt(kReplicates / boost::math::quantile(distribution, 0.9995));
  const bool normal = errors_are_normal(c, measured.estimates.front());
  for (std::size_t k = 0; k < measured.estimates.size(); ++k) {
    const double error = std::sqrt(measured.squared[k]) / c.value;
    points.x.push_back(c.samples * measured.estimates[k]);
    points.y.push_back(error);
    if (normal) {
      points.low.push_back(error * narrowest);
      points.high.push_back(error * widest);
    }
    line.x.push_back(points.x.back());
    line.y.push_back(std::sqrt(exact_squared_error(c, measured.estimates[k])) / c.value);
  }
  expect_on_the_line(c, measured);
  figure.series.push_back(points);
  if (std::isfinite(c.exact.variance)) figure.series.push_back(line);
}

class Figures : public testing::TestWithParam<std::size_t> {};

TEST_P(Figures, ErrorsFollowTheExactVariance) {
  const Integral1d& integral = analytic::known_integrals()[GetParam()];
  publish_densities(integral);
  publish_weights(integral);
  Figure figure = figure_of(integral, "error against samples");
  figure.caption =
      "Root mean square error of 64 runs, relative, against the samples drawn. Dashed: what the "
      "exact "
      "variance and bias say, slope -1/2 until a bias shows. A strategy without a dashed line has "
      "infinite variance. Bars: 99.9 %, where the error is near enough to normal.";
  figure.x = {"samples", true};
  figure.y = {"relative error", true};
  for (const EstimatorCase& c : estimator_cases(integral)) {
    // On a logarithmic axis there is no place for an error of 0.
    const bool has_error = exact_squared_error(c, 1) > 1e-20 * c.value * c.value;
    if (has_error && !c.featured.empty()) add_error_curve(c, figure);
  }
  publish(figure);
}

INSTANTIATE_TEST_SUITE_P(Integrals, Figures,
                         testing::Range<std::size_t>(0, analytic::known_integrals().size()),
                         [](const auto& param) {
                           return analytic::known_integrals()[param.param].name;
                         });

/// Estimates one by one, and their running mean at places spaced by factors.
struct Trace {
  FigureSeries estimates, running;
};

Trace trace(const EstimatorCase& c, const std::string& name, int length, int shown) {
  Trace result;
  result.estimates.name = result.running.name = name;
  result.running.style = SeriesStyle::line;
  verify::Random random(check_seed(c.subject() + "/run"));
  double sum = 0;
  double next = 10;
  for (int k = 1; k <= length; ++k) {
    const double estimate = c.draw(random);
    sum += estimate;
    if (k <= shown) {
      result.estimates.x.push_back(k);
      result.estimates.y.push_back(estimate / c.value);
    }
    if (k >= next) {
      result.running.x.push_back(k);
      result.running.y.push_back(sum / k / c.value);
      next = std::max(next * 1.01, k + 1.0);
    }
  }
  return result;
}

TEST(BadGaussianFigures, TheSlide) {
  const Integral1d integral = analytic::bad_gaussian_interval();
  const std::vector<EstimatorCase> cases = estimator_cases(integral);
  const EstimatorCase& narrow = cases[0];
  const EstimatorCase* mixed = nullptr;
  for (const EstimatorCase& c : cases) mixed = c.strategy == "coin flip" ? &c : mixed;
  ASSERT_EQ(narrow.strategy, "technique 1 alone");
  ASSERT_NE(mixed, nullptr);
  const Trace bad = trace(narrow, "narrow Gaussian alone", 100000, 1000);
  const Trace good = trace(*mixed, "half narrow, half constant", 1000, 1000);

  const Grid grid = grid_of(integral);
  const auto& p = integral.densities;
  Figure ratio = figure_of(integral, "f/p");
  ratio.caption =
      "What a sample at x contributes, over the integral. The mixture bounds it by 2 f/p2.";
  ratio.x = {"x", false};
  ratio.y = {"f / (p times the integral)", true};
  ratio.series = {curve("narrow Gaussian alone", SeriesStyle::line, grid.x,
                        [&](double x) { return integral.f(x) / p[0].pdf_x(x) / integral.value; }),
                  curve("half narrow, half constant", SeriesStyle::line, grid.x, [&](double x) {
                    const double mixture = 0.5 * (p[0].pdf_x(x) + p[1].pdf_x(x));
                    return integral.f(x) / mixture / integral.value;
                  })};
  publish(ratio);

  Figure weights = figure_of(integral, "contributions of 1,000 samples");
  weights.caption = "f/p over the integral, sample by sample.";
  weights.x = {"sample", false};
  weights.y = {"f / (p times the integral)", true};
  weights.series = {bad.estimates, good.estimates};
  publish(weights);

  Figure running = figure_of(integral, "running estimate");
  running.caption = "A hundred thousand samples without MIS, a thousand with. The answer is 1.";
  running.x = {"samples", true};
  running.y = {"estimate / integral", false};
  running.series = {bad.running, good.running};
  publish(running);

  // No sample of the mixture can exceed 2 f/p₂; among a thousand of the narrow density some do.
  const auto largest = [](const FigureSeries& series) {
    return *std::max_element(series.y.begin(), series.y.end());
  };
  EXPECT_LE(largest(good.estimates), 2 / integral.value);
  EXPECT_GT(largest(bad.estimates), 2 / integral.value);
}

}  // namespace
}  // namespace plumbline::tests
