#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <plumbline/verify/pair.h>

/// Distances, which end nowhere.
namespace plumbline::verify {
namespace {

ContractOptions options_of(const std::string& name) {
  ContractOptions options = tests::contract_options(name);
  options.points = 2'000;
  return options;
}

void expect_passes(const SamplingPair& pair) {
  const Report report = check_pair(pair, options_of(pair.name));
  EXPECT_TRUE(report.ok()) << report.summary();
}

/// Free flight through a homogeneous medium.
template <class T>
SamplingPair free_flight(const std::string& name, T sigma, T sigma_of_pdf, double scale) {
  return sampling_pair<T>(
      name, Domain::half_line(scale), [=](T u) { return -std::log1p(-u) / sigma; },
      [=](T t) { return t < 0 ? T(0) : sigma_of_pdf * std::exp(-sigma_of_pdf * t); });
}

TEST(HalfLine, PassesFreeFlightWhateverTheScale) {
  for (const double scale : {1e-3, 0.5, 1.0, 1e3}) {
    const std::string at = " at scale " + std::to_string(scale);
    expect_passes(free_flight<double>("flight, double" + at, 2, 2, scale));
    expect_passes(free_flight<float>("flight, float" + at, 2, 2, scale));
  }
}

TEST(HalfLine, PassesAHeavyTail) {
  // Without a mean: 1/(1 + x)².
  expect_passes(sampling_pair<double>(
      "heavy tail", Domain::half_line(), [](double u) { return u / (1 - u); },
      [](double x) { return x < 0 ? 0 : 1 / ((1 + x) * (1 + x)); }));
}

TEST(HalfLine, PassesNullCollisions) {
  // Extinction 1 + sin²x under a majorant of 2. ∫₀ˣ 1 + sin² = 3x/2 − sin(2x)/4.
  const auto sigma = [](double x) { return 1 + std::pow(std::sin(x), 2); };
  const auto track = [=](Random& random) {
    double x = 0;
    do {
      x -= std::log1p(-random.uniform()) / 2;
    } while (2 * random.uniform() >= sigma(x));
    return x;
  };
  const auto pdf = [=](double x) {
    return x < 0 ? 0 : sigma(x) * std::exp(-1.5 * x + std::sin(2 * x) / 4);
  };
  expect_passes(sampling_pair<double>("null collisions", Domain::half_line(), track, pdf));
}

TEST(HalfLine, FailsAnotherRate) {
  const SamplingPair pair = free_flight<double>("another rate", 2, 2.1, 1);
  EXPECT_EQ(check_chi_square(pair, options_of(pair.name)).verdict, Verdict::fail);
  EXPECT_EQ(check_jacobian(pair, options_of(pair.name)).verdict, Verdict::fail);
}

TEST(HalfLine, FailsADensityThatHoldsTooMuchFarOut) {
  const SamplingPair pair = sampling_pair<double>(
      "too much", Domain::half_line(), [](double u) { return -std::log1p(-u); },
      [](double x) { return std::exp(-x) + 0.01 / ((1 + x) * (1 + x)); });
  EXPECT_EQ(check_integral(pair, options_of(pair.name)).verdict, Verdict::fail);
}

TEST(HalfLine, FailsDistancesThatAreNegativeOrInfinite) {
  for (const double bad : {-0.5, std::numeric_limits<double>::infinity()}) {
    const SamplingPair pair = sampling_pair<double>(
        "bad distance " + std::to_string(bad), Domain::half_line(),
        [=](double u) { return u < 0.01 ? bad : -std::log1p(-u); },
        [](double x) { return x < 0 ? 0 : std::exp(-x); });
    EXPECT_EQ(check_pair(pair, options_of(pair.name)).verdict(), Verdict::fail) << bad;
  }
}

TEST(Line, PassesALogisticAndFailsAWiderOne) {
  const auto pair = [](const std::string& name, double width) {
    return sampling_pair<double>(
        name, Domain::line(3, 1),
        [](double u) { return 3 + 0.2 * std::log(std::max(u, 0x1p-60) / (1 - u)); },
        [=](double x) {
          const double e = std::exp(-std::abs(x - 3) / width);
          return e / (width * (1 + e) * (1 + e));
        });
  };
  expect_passes(pair("logistic", 0.2));
  const SamplingPair wider = pair("wider logistic", 0.21);
  EXPECT_EQ(check_chi_square(wider, options_of(wider.name)).verdict, Verdict::fail);
}

TEST(Line, PassesANormalOfTwoNumbers) {
  const auto box_muller = [](double u, double v) {
    return std::sqrt(-2 * std::log1p(-u)) * std::cos(2 * std::numbers::pi * v);
  };
  const auto pdf = [](double x) { return std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi); };
  SamplingPair pair = sampling_pair<double>("normal", Domain::line(), box_muller, pdf);
  const Report report = check_pair(pair, options_of(pair.name));
  EXPECT_TRUE(report.ok()) << report.summary();
}

TEST(LineDomains, RefuseScalesThatAreNone) {
  for (const double scale : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(Domain::half_line(scale), std::invalid_argument);
    EXPECT_THROW(Domain::line(0, scale), std::invalid_argument);
  }
}

TEST(LineDomains, MapThereAndBack) {
  for (const Domain& domain : {Domain::half_line(3), Domain::line(1, 2)}) {
    for (const double t : {1e-6, 0.1, 0.5, 0.9, 1 - 1e-9}) {
      const Point2 p{t, 0.5};
      EXPECT_NEAR(domain.chart().to_square(domain.chart().from_square(p))[0], t, 1e-12);
    }
    EXPECT_TRUE(std::isfinite(domain.chart().from_square({1, 0.5})[0]));
    EXPECT_TRUE(std::isfinite(domain.chart().element({1, 0.5})));
  }
}

}  // namespace
}  // namespace plumbline::verify
