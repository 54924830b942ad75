#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <plumbline/renderer/estimators/optimal_weights.h>
#include <plumbline/verify/mean.h>
#include <plumbline_tests/support.h>

#include "estimator_cases.h"
#include "integral_problem.h"

namespace plumbline::tests {
namespace {

using analytic::Integral1d;
using renderer::Heuristic;
using renderer::TechniqueDensity;
using verify::Moments;

using Numbers = std::vector<double>;
using View = std::span<const double>;

/// Both draws from the same random numbers.
template <class A, class B>
void expect_same_draws(A a, B b, double relative, const std::string& what) {
  verify::Random random_a(check_seed(what)), random_b(check_seed(what));
  Uniform<double> uniform_a(random_a), uniform_b(random_b);
  for (int k = 0; k < 500; ++k) {
    const double x = a(uniform_a);
    ASSERT_NEAR(x, b(uniform_b), relative * std::abs(x)) << what;
  }
}

TEST(Estimators, CoinFlipIsOneSampleBalanceWithEqualChances) {
  for (const Integral1d& integral : analytic::known_integrals()) {
    const IntegralProblem<double> problem(integral);
    const Numbers equal(problem.size(), 1 / static_cast<double>(problem.size()));
    expect_same_draws(
        [&](auto& u) { return renderer::coin_flip(problem, u); },
        [&](auto& u) { return renderer::one_sample(problem, Heuristic::balance, View(equal), u); },
        1e-13, integral.name);
  }
}

TEST(Estimators, DeterministicMixtureIsMultiSampleBalance) {
  for (const Integral1d& integral : analytic::known_integrals()) {
    const IntegralProblem<double> problem(integral);
    Numbers counts(problem.size(), 2);
    counts[0] = 7;
    expect_same_draws(
        [&](auto& u) { return renderer::deterministic_mixture(problem, View(counts), u); },
        [&](auto& u) {
          return renderer::multi_sample(problem, Heuristic::balance, View(counts), u);
        },
        1e-13, integral.name);
  }
}

TEST(Estimators, OptimalWithoutCoefficientsIsMultiSampleBalance) {
  for (const Integral1d& integral : analytic::known_integrals()) {
    const IntegralProblem<double> problem(integral);
    const Numbers counts(problem.size(), 3), none(problem.size(), 0);
    expect_same_draws(
        [&](auto& u) { return renderer::optimal(problem, View(counts), View(none), u); },
        [&](auto& u) {
          return renderer::multi_sample(problem, Heuristic::balance, View(counts), u);
        },
        1e-13, integral.name);
  }
}

TEST(Estimators, BalanceWithCountsIsOneSampleWithTheirSharesPointwise) {
  for (const Integral1d& integral : analytic::known_integrals()) {
    const IntegralProblem<double> problem(integral);
    Numbers counts, shares;
    double total = 0;
    for (std::size_t i = 0; i < problem.size(); ++i) {
      counts.push_back(static_cast<double>(2 * i + 1));
      total += counts.back();
    }
    for (const double n : counts) shares.push_back(n / total);
    verify::Random random(check_seed(integral.name));
    Uniform<double> uniform(random);
    for (std::size_t i = 0; i < problem.size(); ++i) {
      for (int k = 0; k < 300; ++k) {
        const double x = *problem.sample(i, uniform);
        const double multi = mis_contribution(problem, Heuristic::balance, View(counts), i, x);
        const double one = mis_contribution(problem, Heuristic::balance, View(shares), i, x);
        ASSERT_NEAR(multi * total, one, 1e-13 * one) << integral.name;
      }
    }
  }
}

TEST(Estimators, OptimalWeightsOfTwoStepsHaveNoVariance) {
  const Integral1d integral = analytic::two_steps();
  const IntegralProblem<double> problem(integral);
  const Numbers alpha = optimal_alpha(integral, {2, 5});
  EXPECT_NEAR(alpha[0], 8, 1e-12);
  EXPECT_NEAR(alpha[1], 7.2, 1e-12);
  const Numbers counts = {2, 5};
  expect_same_draws(
      [&](auto& u) { return renderer::optimal(problem, View(counts), View(alpha), u); },
      [](auto&) { return 15.2; }, 1e-13, "two steps");
}

TEST(OptimalSystem, SingularSystemsAreSolved) {
  // Three densities, of which the third is the average of the others: rank 2.
  renderer::OptimalSystem<double> system(3);
  const double rows[3][2] = {{1, 0.2}, {0.2, 1}, {0.6, 0.6}};
  const double target[2] = {3, 5};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      system.matrix(i, k) = rows[i][0] * rows[k][0] + rows[i][1] * rows[k][1];
    }
    system.vector(i) = rows[i][0] * target[0] + rows[i][1] * target[1];
  }
  const auto alpha = system.solve();
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += system.matrix(i, k) * alpha[k];
    EXPECT_NEAR(sum, system.vector(i), 1e-12);
  }
}

TEST(OptimalSystem, SamplesTendToQuadrature) {
  for (const Integral1d& integral : {analytic::broad_times_peaked(), analytic::three_peaks()}) {
    const IntegralProblem<double> problem(integral);
    const std::vector<int> ones(problem.size(), 1);
    const Numbers counts(problem.size(), 1);
    renderer::OptimalSystem<double> system(problem.size());
    verify::Random random(check_seed(integral.name));
    Uniform<double> uniform(random);
    constexpr int kRounds = 20000;
    for (int k = 0; k < kRounds; ++k) system.add_samples(problem, View(counts), uniform);
    const analytic::OptimalSystem exact = optimal_system(integral, ones);
    for (std::size_t i = 0; i < problem.size(); ++i) {
      for (std::size_t k = 0; k < problem.size(); ++k) {
        // One round adds at most M, in [0, 1] each: eight standard errors are below 8 M/(2
        // √rounds).
        EXPECT_NEAR(system.matrix(i, k) / kRounds, exact.matrix[i][k],
                    4 * static_cast<double>(problem.size()) / std::sqrt(kRounds));
      }
    }
  }
}

TEST(OptimalSystem, CoefficientsFromTheSameSamplesBias) {
  // Two samples of each technique give α and are then used again. On x² by 2x and 3 (1 − x)² that
  // misses the integral; α from two other samples is noisy, and right.
  const Integral1d* integral = nullptr;
  for (const Integral1d& one : analytic::combination_integrals()) {
    if (one.name == "x^2 by rising + falling") integral = &one;
  }
  ASSERT_NE(integral, nullptr);
  const IntegralProblem<double> problem(*integral);
  const Numbers counts = {2, 2};
  const auto estimate = [&](std::uint64_t seed, std::uint64_t count, bool same) {
    Moments moments;
    for (std::uint64_t k = 0; k < count; ++k) {
      verify::Random first(seed, 2 * k);
      Uniform<double> numbers(first);
      renderer::OptimalSystem<double> system(2);
      system.add_samples(problem, View(counts), numbers);
      const auto alpha = system.solve();
      verify::Random second(seed, same ? 2 * k : 2 * k + 1);
      Uniform<double> again(second);
      moments.add(renderer::optimal(problem, View(counts), View(alpha.data(), 2), again));
    }
    return moments;
  };
  for (const bool same : {true, false}) {
    verify::MeanOptions options;
    options.subject = same ? "optimal weights/coefficients from the same samples"
                           : "optimal weights/coefficients from other samples";
    options.reference = integral->value;
    options.tolerance = 0.05;
    options.max_samples = 1 << 18;
    options.expected = same ? verify::Verdict::fail : verify::Verdict::pass;
    options.seed = check_seed(options.subject);
    expect_verdict(verify::check_mean(options, [&](std::uint64_t first, std::uint64_t count) {
      return estimate(options.seed + first, count, same);
    }));
  }
}

TEST(Estimators, RunInFloat) {
  for (const Integral1d& integral : {analytic::two_steps(), analytic::three_peaks()}) {
    const IntegralProblem<float> problem(integral);
    const std::vector<float> counts(problem.size(), 2.0f);
    verify::MeanOptions options;
    options.subject = integral.name + "/multi-sample power 2 in float";
    options.reference = integral.value;
    options.tolerance = 0.01;
    options.rounding_allowance = 1e-5;
    options.max_samples = 1 << 20;
    options.seed = check_seed(options.subject);
    verify::Random random(options.seed);
    Uniform<float> uniform(random);
    expect_verdict(verify::check_mean(options, [&](std::uint64_t, std::uint64_t count) {
      Moments moments;
      for (std::uint64_t k = 0; k < count; ++k) {
        moments.add(static_cast<double>(renderer::multi_sample(
            problem, Heuristic::power, std::span<const float>(counts), uniform)));
      }
      return moments;
    }));
  }
}

/// A mirror and a lamp: f is e^x on [0, 1] and a mass of ½ at 0.3. The first technique always goes
/// to 0.3, the second is uniform and never does.
struct MirrorAndLamp {
  using Scalar = double;
  using Point = double;

  static constexpr double kAt = 0.3;
  static constexpr double kMass = 0.5;

  bool declared = true;  ///< false: the atom passes for a density of 1

  std::size_t size() const { return 2; }
  double value(double x) const { return x == kAt ? kMass : std::exp(x); }

  template <class Random>
  std::optional<double> sample(std::size_t i, Random& random) const {
    return i == 0 ? kAt : random();
  }
  TechniqueDensity<double> density(std::size_t i, double x) const {
    if (i == 1) return {1};
    return {x == kAt ? 1.0 : 0.0, 1, declared && x == kAt};
  }
};

TEST(Estimators, AnAtomAmongTheTechniquesIsCountedWhole) {
  for (const bool declared : {true, false}) {
    for (const bool one : {false, true}) {
      const MirrorAndLamp problem{declared};
      const Numbers counts = {1, 3}, shares = {0.25, 0.75};
      verify::MeanOptions options;
      options.subject = std::string("mirror and lamp/") + (one ? "one-sample" : "multi-sample") +
                        (declared ? "" : ", atom passed off as a density");
      options.reference = std::exp(1) - 1 + MirrorAndLamp::kMass;
      options.tolerance = 0.01;
      options.max_samples = 1 << 20;
      options.expected = declared ? verify::Verdict::pass : verify::Verdict::fail;
      options.seed = check_seed(options.subject);
      verify::Random random(options.seed);
      Uniform<double> uniform(random);
      expect_verdict(verify::check_mean(options, [&](std::uint64_t, std::uint64_t count) {
        Moments moments;
        for (std::uint64_t k = 0; k < count; ++k) {
          moments.add(
              one ? renderer::one_sample(problem, Heuristic::power, View(shares), uniform)
                  : renderer::multi_sample(problem, Heuristic::power, View(counts), uniform));
        }
        return moments;
      }));
    }
  }
}

/// Rejects half of its samples: uniform on [0, 1], of which the part above ½ is thrown away.
struct Rejecting {
  using Scalar = double;
  using Point = double;

  std::size_t size() const { return 2; }
  double value(double x) const { return 3 * x * x; }
  template <class Random>
  std::optional<double> sample(std::size_t i, Random& random) const {
    const double x = random();
    if (i == 0 && x > 0.5) return std::nullopt;
    return x;
  }
  TechniqueDensity<double> density(std::size_t i, double x) const {
    return {i == 0 && x > 0.5 ? 0.0 : 1.0};
  }
};

TEST(Estimators, RejectedSamplesCountAsZero) {
  const Rejecting problem;
  const Numbers counts = {2, 1}, shares = {0.5, 0.5};
  const std::vector<std::pair<std::string, std::function<double(Uniform<double>&)>>> estimators = {
      {"multi-sample",
       [&](Uniform<double>& u) {
         return renderer::multi_sample(problem, Heuristic::balance, View(counts), u);
       }},
      {"one-sample",
       [&](Uniform<double>& u) {
         return renderer::one_sample(problem, Heuristic::balance, View(shares), u);
       }},
      {"coin flip", [&](Uniform<double>& u) { return renderer::coin_flip(problem, u); }},
      {"second technique alone",
       [&](Uniform<double>& u) { return renderer::single(problem, 1, u); }}};
  for (const auto& estimator : estimators) {
    verify::MeanOptions options;
    options.subject = "rejecting technique/" + estimator.first;
    options.reference = 1;
    options.tolerance = 0.02;
    options.max_samples = 1 << 20;
    options.seed = check_seed(options.subject);
    verify::Random random(options.seed);
    Uniform<double> uniform(random);
    expect_verdict(verify::check_mean(options, [&](std::uint64_t, std::uint64_t count) {
      Moments moments;
      for (std::uint64_t k = 0; k < count; ++k) moments.add(estimator.second(uniform));
      return moments;
    }));
  }
}

}  // namespace
}  // namespace plumbline::tests
