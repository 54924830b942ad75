#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include <plumbline/analytic/mixture_variance.h>
#include <plumbline/verify/mean.h>
#include <plumbline_tests/support.h>

#include "allocation_run.h"

/// Where the allocation policies go on integrals whose V′ is known by quadrature.
namespace plumbline::tests {
namespace {

using analytic::Integral1d;
using renderer::Allocation;
using renderer::TechniqueCounts;
using renderer::total_count;

/// Integrals with two densities: the best share of the second lies at the lower end of the range.
std::vector<Integral1d> integrals() {
  return {analytic::bad_gaussian_interval(), analytic::broad_times_peaked(),
          analytic::peaked_times_peaked()};
}

TEST(MixtureVariance, SlopeAndCurvatureAreItsDerivatives) {
  for (const Integral1d& integral : integrals()) {
    constexpr double kStep = 1e-4;
    for (const double alpha : {0.2, 0.5, 0.8}) {
      const auto at = [&](double a) { return mixture_variance(integral, a); };
      const analytic::MixtureVariance here = at(alpha), up = at(alpha + kStep),
                                      down = at(alpha - kStep);
      // Central differences: (step²/6) V‴/V′ or so, below 1e-5 here.
      const double slope = (up.variance - down.variance) / (2 * kStep);
      EXPECT_NEAR(here.slope, slope, 1e-5 * here.curvature) << integral.name;
      EXPECT_NEAR(here.curvature, (up.slope - down.slope) / (2 * kStep), 1e-5 * here.curvature);
    }
  }
}

TEST(MixtureVariance, BestShareIsTheRootOfTheSlopeOrTheEndThatTheVarianceFallsTowards) {
  for (const Integral1d& integral : integrals()) {
    const double best = best_share(integral, 0.1, 0.9);
    const analytic::MixtureVariance there = mixture_variance(integral, best);
    if (integral.name == analytic::broad_times_peaked().name) {
      EXPECT_EQ(best, 0.1);
      EXPECT_GT(there.slope, 0);
    } else {
      EXPECT_LT(std::abs(there.slope), 1e-8 * there.curvature) << integral.name;
    }
  }
}

/// Where a policy must go with ever more samples.
double limit_of(const Integral1d& integral, Allocation policy) {
  const double square = integral.value * integral.value;
  const auto by_spreads = [&](double subtracted) {
    return 1 / (1 + (second_moment(integral, 0) - subtracted) /
                        (second_moment(integral, 1) - subtracted));
  };
  const auto at_half = mixture_variance(integral, 0.5);
  double limit = 0.5;
  if (policy == Allocation::lu) limit = 0.5 - at_half.slope / at_half.curvature;
  if (policy == Allocation::sbert_moment) limit = by_spreads(0);
  if (policy == Allocation::sbert_variance) limit = by_spreads(square);
  if (policy == Allocation::root_v1 || policy == Allocation::root_v2 ||
      policy == Allocation::root_nodes) {
    limit = best_share(integral, 0.1, 0.9);
  }
  return std::clamp(limit, 0.1, 0.9);
}

/// α of the last iteration of a run.
double last_share(const Integral1d& integral, Allocation policy, verify::Random& random) {
  constexpr std::uint32_t kIterations = 20, kSamples = 20 * 250;
  std::uint32_t first = 0, all = 0;
  renderer::allocate_samples({.policy = policy, .iterations = kIterations}, kSamples,
                             IntegralDraw(integral, random),
                             [&](std::uint32_t iteration, std::size_t technique, double) {
                               if (iteration + 1 < kIterations) return;
                               ++all;
                               if (technique == 0) ++first;
                             });
  return static_cast<double>(first) / all;
}

verify::CheckResult check_limit(const Integral1d& integral, Allocation policy, double limit,
                                verify::Verdict expected) {
  verify::MeanOptions options;
  options.subject = expected == verify::Verdict::fail ? "control/" : "";
  options.subject.append(integral.name).append("/alpha of ").append(name(policy));
  options.reference = limit;
  // A share 0.01 off costs V″ 0.01²/2: less than a thousandth of V at the curvatures here. Rounding
  // to whole counts, and the noise of a finite run through a curved V′, shift it by a part of that.
  options.tolerance = 0.01;
  options.relative = false;
  options.rounding_allowance = 0.01;
  options.expected = expected;
  options.seed = check_seed(options.subject);
  options.n0 = 1'000;  // the fewest that a check takes are enough for most
  options.max_samples = nightly() ? 1 << 16 : 1 << 13;
  return check_mean(options, runs(options.seed, [&](verify::Random& random) {
                      return last_share(integral, policy, random);
                    }));
}

class PolicyLimit : public testing::TestWithParam<std::tuple<std::size_t, Allocation>> {};

TEST_P(PolicyLimit, AlphaConvergesToIt) {
  const Integral1d integral = integrals()[std::get<0>(GetParam())];
  const Allocation policy = std::get<1>(GetParam());
  expect_verdict(check_limit(integral, policy, limit_of(integral, policy), verify::Verdict::pass));
}

INSTANTIATE_TEST_SUITE_P(Integrals, PolicyLimit,
                         testing::Combine(testing::Range<std::size_t>(0, 3),
                                          testing::Values(Allocation::lu, Allocation::sbert_moment,
                                                          Allocation::sbert_variance,
                                                          Allocation::root_v1, Allocation::root_v2,
                                                          Allocation::root_nodes)),
                         [](const auto& param) {
                           std::string text = integrals()[std::get<0>(param.param)].name;
                           text.append("_").append(name(std::get<1>(param.param)));
                           std::replace(text.begin(), text.end(), '-', '_');
                           return text;
                         });

TEST(PolicyLimitControl, TheBestShareIsNotWhereLuGoes) {
  const Integral1d integral = analytic::broad_times_peaked();
  expect_verdict(
      check_limit(integral, Allocation::lu, best_share(integral, 0.1, 0.9), verify::Verdict::fail));
}

using SlopeVersion = std::function<double(const renderer::SlopeSums&, const TechniqueCounts&)>;

/// V′ from ten samples, of which tenths of α each are of technique 1.
verify::MomentSampler slopes(const Integral1d& integral, const TechniqueCounts& counts,
                             std::uint64_t seed, const SlopeVersion& version) {
  return runs(seed, [&integral, counts, version](verify::Random& random) {
    const IntegralDraw draw(integral, random);
    const double alpha = counts[0] / total_count(counts);
    renderer::SlopeSums sums;
    for (std::size_t t = 0; t < 2; ++t) {
      for (std::uint32_t s = 0; s < counts[t]; ++s) {
        const auto x = draw(t);
        std::array<double, 2> pdf{};
        pdf[t] = x.pdf;
        pdf[1 - t] = x.other_pdf;
        const double p = alpha * pdf[0] + (1 - alpha) * pdf[1];
        sums.add(t, {x.value * x.pdf / p, {pdf[0] / p, pdf[1] / p}});
      }
    }
    return version(sums, counts);
  });
}

const SlopeVersion kVersion1 = [](const auto& sums, const auto& n) { return sums.version_1(n); };
const SlopeVersion kVersion2 = [](const auto& sums, const auto& n) { return sums.version_2(n); };

constexpr std::array<TechniqueCounts, 3> kTenths{{{2, 8}, {5, 5}, {8, 2}}};

verify::MeanOptions slope_options(const Integral1d& integral, const TechniqueCounts& counts,
                                  const std::string& what) {
  verify::MeanOptions options;
  options.subject = integral.name + "/" + what + " at " + std::to_string(counts[0]) + "/10";
  options.relative = false;
  // In units of α: what such an error of V′ shifts its root by.
  options.tolerance = 0.02 * mixture_variance(integral, counts[0] / total_count(counts)).curvature;
  options.max_samples = 100'000;  // 1e6 samples of the integrand
  options.seed = check_seed(options.subject);
  return options;
}

TEST(SlopeVersions, BothAreTheSlopeByQuadratureAndAgreeWithAMillionSamples) {
  for (const Integral1d& integral : integrals()) {
    for (const TechniqueCounts& counts : kTenths) {
      for (const auto& [what, version] :
           {std::pair("V' version 1", kVersion1), std::pair("V' version 2", kVersion2)}) {
        auto options = slope_options(integral, counts, what);
        options.reference = mixture_variance(integral, counts[0] / total_count(counts)).slope;
        expect_verdict(check_mean(options, slopes(integral, counts, options.seed, version)));
      }
      const auto options = slope_options(integral, counts, "V' version 1 - version 2");
      expect_verdict(check_agreement(options, slopes(integral, counts, options.seed, kVersion1),
                                     slopes(integral, counts, options.seed + 1, kVersion2)));
    }
  }
}

TEST(SlopeVersionsControl, SlopeWithTheDensitiesExchangedFails) {
  const Integral1d integral = analytic::broad_times_peaked();
  auto options = slope_options(integral, kTenths[0], "V' with the densities exchanged");
  options.subject.insert(0, "control/");
  options.reference = mixture_variance(integral, 0.2).slope;
  options.expected = verify::Verdict::fail;
  expect_verdict(check_mean(
      options, slopes(integral, kTenths[0], options.seed,
                      [](const auto& sums, const auto& n) { return -sums.version_2(n); })));
}

}  // namespace
}  // namespace plumbline::tests
