#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <plumbline/verify/dependent.h>
#include <plumbline/verify/gtest.h>

namespace plumbline::verify {
namespace {

using tests::check_seed;
using tests::repeatable;

using Target = std::function<double(double)>;

/// What is kept of candidates.
///
/// @source Bitterli et al. 2020, Algorithm 2
struct Reservoir {
  double x = 0, sum = 0, count = 0;

  void add(double candidate, double weight, double of_count, Random& random) {
    sum += weight;
    count += of_count;
    if (weight > 0 && random.uniform() * sum < weight) x = candidate;
  }

  /// W by Eq. 6, of a sum that is divided by `divisor`.
  std::optional<WeightedPoint> chosen(const Target& target, double divisor) const {
    if (!(sum > 0)) return std::nullopt;
    return WeightedPoint{{x, 0, 0}, sum / divisor / target(x)};
  }
};

enum class ResamplingFault { none, one_less, no_divisor, other_density, zeros_not_counted };

constexpr int kCandidates = 4;

/// Candidates of the density ½ + x on [0, 1], resampled.
Reservoir resampled(const Target& target, ResamplingFault fault, Random& random) {
  Reservoir r;
  for (int i = 0; i < kCandidates; ++i) {
    const double x = std::sqrt(0.25 + 2 * random.uniform()) - 0.5;
    const double density = fault == ResamplingFault::other_density ? 1 : 0.5 + x;
    const bool counted = fault != ResamplingFault::zeros_not_counted || target(x) > 0;
    r.add(x, target(x) / density, counted ? 1 : 0, random);
  }
  return r;
}

double ramp(double x) { return 1 + 2 * x; }
double ramp_or_dark(double x) { return x < 0.4 ? 0 : ramp(x); }

ContributionSampler chosen_on_the_line(
    std::string name, const Target& target,
    std::function<std::optional<WeightedPoint>(Random&)> sample) {
  return {std::move(name), Domain::interval(), std::move(sample),
          [target](const Vec3& x) { return target(x[0]); }};
}

ContributionSampler importance_resampling(std::string name, const Target& target,
                                          ResamplingFault fault) {
  return chosen_on_the_line(std::move(name), target, [target, fault](Random& random) {
    const Reservoir r = resampled(target, fault, random);
    const double divisor = fault == ResamplingFault::one_less     ? r.count - 1
                           : fault == ResamplingFault::no_divisor ? 1
                                                                  : r.count;
    return r.chosen(target, divisor);
  });
}

ContributionOptions to_two_percent(const std::string& name) {
  ContributionOptions o;
  o.tolerance = 0.02;
  o.seed = check_seed("contribution weights/" + name);
  o.constants = true;  // ramps are nowhere near to 0
  o.functions = {{"wave", [](const Vec3& x) { return 1 + std::sin(9 * x[0]); }}};
  return o;
}

Report check_chosen(const ContributionSampler& sampler) {
  return check_contribution_weights(sampler, to_two_percent(sampler.name));
}

void expect_biased(const ContributionSampler& sampler) {
  const Report report = check_chosen(sampler);
  EXPECT_EQ(report.verdict(), Verdict::fail) << report.summary();
}

TEST(ContributionWeights, OfImportanceResamplingAreUnbiased) {
  PLUMBLINE_EXPECT_PASS(
      repeatable(check_chosen(importance_resampling("ramp", ramp, ResamplingFault::none))));
  PLUMBLINE_EXPECT_PASS(repeatable(
      check_chosen(importance_resampling("half dark", ramp_or_dark, ResamplingFault::none))));
}

TEST(ContributionWeights, OfATargetThatComesNearToZeroAreHeldToTheTarget) {
  // W alone has no variance to speak of there; f(X) W for f the target has.
  const Target bell = [](double x) { return std::exp(-50 * (x - 0.3) * (x - 0.3)); };
  ContributionOptions o;
  o.tolerance = 0.03;
  o.seed = check_seed("contribution weights/bell");
  PLUMBLINE_EXPECT_PASS(repeatable(
      check_contribution_weights(importance_resampling("bell", bell, ResamplingFault::none), o)));
  const Report wrong = check_contribution_weights(
      importance_resampling("bell, one less", bell, ResamplingFault::one_less), o);
  EXPECT_EQ(wrong.verdict(), Verdict::fail) << wrong.summary();
}

TEST(ContributionWeights, WrongDivisorsAndDensitiesAreFound) {
  expect_biased(importance_resampling("one less", ramp, ResamplingFault::one_less));
  expect_biased(importance_resampling("no divisor", ramp, ResamplingFault::no_divisor));
  expect_biased(importance_resampling("other density", ramp, ResamplingFault::other_density));
  // Candidates of a target of 0 count: they say how much of the domain it leaves out.
  expect_biased(importance_resampling("zeros", ramp_or_dark, ResamplingFault::zeros_not_counted));
  const ContributionSampler lit =
      importance_resampling("no zeros", ramp, ResamplingFault::zeros_not_counted);
  PLUMBLINE_EXPECT_PASS(repeatable(check_chosen(lit)));
}

/// Reuses what a neighbour has chosen whose own target is dark on part of the domain.
///
/// @source Bitterli et al. 2020, Algorithms 4 (1/M, biased) and 6 (1/Z)
ContributionSampler reuse_of_neighbours(std::string name, bool by_z) {
  return chosen_on_the_line(std::move(name), ramp, [by_z](Random& random) {
    const Reservoir own = resampled(ramp, ResamplingFault::none, random);
    const Reservoir other = resampled(ramp_or_dark, ResamplingFault::none, random);
    Reservoir both;
    both.add(own.x, own.sum, own.count, random);
    if (const auto y = other.chosen(ramp_or_dark, other.count)) {
      both.add(y->x[0], ramp(y->x[0]) * y->weight * other.count, other.count, random);
    } else {
      both.count += other.count;
    }
    // Z: candidates of those that could have chosen x.
    const double z = own.count + (ramp_or_dark(both.x) > 0 ? other.count : 0);
    return both.chosen(ramp, by_z ? z : both.count);
  });
}

TEST(ContributionWeights, CandidatesThatCouldNotHaveChosenAPointAreNotCountedThere) {
  PLUMBLINE_EXPECT_PASS(repeatable(check_chosen(reuse_of_neighbours("1 over Z", true))));
  expect_biased(reuse_of_neighbours("1 over M", false));
}

/// Reuses the reservoir of the frame before, counted as at most so many candidates.
ContributionSampler reuse_in_time(std::string name, bool cap_the_weight) {
  return chosen_on_the_line(std::move(name), ramp, [cap_the_weight](Random& random) {
    constexpr double kCap = 6;
    Reservoir kept = resampled(ramp, ResamplingFault::none, random);
    for (int frame = 0; frame < 4; ++frame) {
      const auto before = kept.chosen(ramp, kept.count);
      const double count = std::min(kept.count, kCap);
      const double of_weight = cap_the_weight ? count : kept.count;
      kept = resampled(ramp, ResamplingFault::none, random);
      kept.add(before->x[0], ramp(before->x[0]) * before->weight * of_weight, count, random);
    }
    return kept.chosen(ramp, kept.count);
  });
}

TEST(ContributionWeights, ACapOfTheCountIsOneOfTheWeightToo) {
  PLUMBLINE_EXPECT_PASS(repeatable(check_chosen(reuse_in_time("capped", true))));
  expect_biased(reuse_in_time("half capped", false));
}

TEST(ContributionWeights, AWrongShapeThatIntegratesToTheRightValueIsFound) {
  // Right in the mean for f = target, wrong wherever one looks.
  const ContributionSampler flat = chosen_on_the_line("flat", ramp, [](Random& random) {
    const double x = random.uniform();
    return WeightedPoint{{x, 0, 0}, 2 / ramp(x)};
  });
  const Report report = check_chosen(flat);
  EXPECT_EQ(report.results.front().verdict, Verdict::fail) << report.summary();
  ASSERT_TRUE(report.results.front().estimate);
}

TEST(ContributionWeights, RefuseWhatMakesNoSense) {
  EXPECT_THROW(check_contribution_weights({}), std::invalid_argument);
  ContributionSampler set = importance_resampling("set", ramp, ResamplingFault::none);
  set.domain = Domain::discrete(3);
  EXPECT_THROW(check_contribution_weights(set), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::verify
