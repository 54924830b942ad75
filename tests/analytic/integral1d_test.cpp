#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>

#include <plumbline/analytic/integral1d.h>

namespace plumbline::analytic {
namespace {

std::vector<Integral1d> all_integrals() {
  std::vector<Integral1d> all = known_integrals();
  all.insert(all.end(), combination_integrals().begin(), combination_integrals().end());
  return all;
}

/// ∫ g over the integral's domain, cut wherever f or a density may not be smooth.
double integrate(const Integral1d& integral, const std::function<double(double)>& g) {
  std::vector<double> cuts = integral.breaks;
  for (const Density1d& density : integral.densities) {
    cuts.push_back(std::max(density.low, integral.low));
    cuts.push_back(std::min(density.high, integral.high));
  }
  cuts.push_back(integral.low);
  cuts.push_back(integral.high);
  std::sort(cuts.begin(), cuts.end());
  boost::math::quadrature::tanh_sinh<double> quadrature;
  double sum = 0;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (cuts[i] > cuts[i - 1]) sum += quadrature.integrate(g, cuts[i - 1], cuts[i], 1e-12);
  }
  return sum;
}

TEST(Integral1d, ValuesAgreeWithQuadrature) {
  ASSERT_EQ(known_integrals().size(), 7u);
  ASSERT_GE(combination_integrals().size(), 34u);  // 200 combinations with six rules
  for (const Integral1d& integral : all_integrals()) {
    EXPECT_NEAR(integrate(integral, integral.f), integral.value, 1e-11 * integral.value)
        << integral.name;
  }
}

TEST(Integral1d, DensitiesIntegrateToOne) {
  for (const Integral1d& integral : all_integrals()) {
    for (const Density1d& density : integral.densities) {
      EXPECT_NEAR(integrate(integral, density.pdf_x), 1, 1e-11) << density.name;
    }
  }
}

TEST(Integral1d, QuantilesDrawFromTheirDensities) {
  // ∫ h(quantile(u)) du = ∫ h(x) p(x) dx for h that pin the distribution down: its mean, its spread
  // and a wave.
  using boost::math::quadrature::gauss_kronrod;
  const std::vector<std::function<double(double)>> probes = {
      [](double x) { return x; }, [](double x) { return x * x; },
      [](double x) { return std::sin(7 * x + 1); }};
  for (const Integral1d& integral : known_integrals()) {
    for (const Density1d& density : integral.densities) {
      for (const auto& probe : probes) {
        const double by_density =
            integrate(integral, [&](double x) { return probe(x) * density.pdf_x(x); });
        const double by_quantile = gauss_kronrod<double, 61>::integrate(
            [&](double u) { return probe(density.quantile(u)); }, 0.0, 1.0, 15, 1e-10);
        EXPECT_NEAR(by_quantile, by_density, 1e-6) << density.name;
      }
    }
  }
}

TEST(Integral1d, MonotonicQuantilesInvertTheDistribution) {
  boost::math::quadrature::tanh_sinh<double> quadrature;
  const std::vector<Density1d> densities = {uniform_density(-1, 3),
                                            rising_density(2),
                                            falling_density(1.5),
                                            exponential_density(-4, 0, 1),
                                            exponential_density(3, 0.5, 2),
                                            truncated_gaussian_density(0.8, 0.2, 0, 1),
                                            truncated_gaussian_density(0.5, 0.06, 0, 1)};
  for (const Density1d& density : densities) {
    for (const double u : {1e-6, 0.01, 0.3, 0.5, 0.77, 0.999}) {
      const double x = density.quantile(u);
      EXPECT_NEAR(quadrature.integrate(density.pdf_x, density.low, x), u, 1e-11)
          << density.name << ' ' << u;
    }
  }
}

TEST(Integral1d, TogetherTheDensitiesCoverTheIntegrand) {
  for (const Integral1d& integral : all_integrals()) {
    for (int i = 1; i < 1000; ++i) {
      const double x = integral.low + (integral.high - integral.low) * i / 1000;
      double sum = 0;
      for (const Density1d& density : integral.densities) sum += density.pdf_x(x);
      EXPECT_TRUE(sum > 0 || integral.f(x) < 1e-100) << integral.name << ' ' << x;
    }
  }
}

TEST(BadGaussian, SecondMomentAgreesWithQuadrature) {
  boost::math::quadrature::tanh_sinh<double> quadrature;
  for (const double sd : {0.75, 0.8, 1.0, 2.0, 5.0}) {
    const auto ratio = [sd](double x) {
      const Density1d p = gaussian_density(0, sd);
      const double f = gaussian_density(0, 1).pdf_x(x);
      return f * f / p.pdf_x(x);
    };
    const double exact = gaussian_ratio_second_moment(1, sd);
    EXPECT_NEAR(2 * quadrature.integrate(ratio, 0.0, 25.0), exact, 1e-10 * exact) << sd;
  }
}

TEST(BadGaussian, VarianceIsInfiniteExactlyUpToHalfTheVarianceOfTheIntegrand) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double limit = std::sqrt(0.5);
  EXPECT_EQ(gaussian_ratio_second_moment(2, 0.5), infinity);
  EXPECT_EQ(gaussian_ratio_second_moment(1, 0.999 * limit), infinity);
  EXPECT_LT(gaussian_ratio_second_moment(1, 1.001 * limit), infinity);
  // The limit itself diverges, and just above it the second moment is as large as one likes.
  EXPECT_EQ(gaussian_ratio_second_moment(1, limit * (1 - 1e-15)), infinity);
  EXPECT_GT(gaussian_ratio_second_moment(1, limit * (1 + 1e-12)), 1e5);
}

TEST(SunAndSidewalk, OneInNinetyTwoThousandRaysHitsTheSun) {
  const double q = cone_fraction(sun_half_angle());
  EXPECT_NEAR(1 / q, 92444.6, 0.1);
  EXPECT_NEAR(samples_for_relative_error(q, 0.1), 9.24437e6, 1e2);
  // The seed's round numbers: 1 in 10,000 rays, a million samples for 10 %.
  EXPECT_NEAR(samples_for_relative_error(1e-4, 0.1), 999900, 1e-6);
}

}  // namespace
}  // namespace plumbline::analytic
