#include <gtest/gtest.h>
#include <plumbline_tests/scoped_variable.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>

#include <plumbline/verify/detail/budget.h>
#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/history/confidence_sequence.h>
#include <plumbline/verify/mean.h>
#include <plumbline/verify/ratio.h>

namespace plumbline::verify {
namespace {

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

using tests::ScopedVariable;

TEST(Budget, GivesEachCheckTheSameLevelWhateverElseRuns) {
  const ScopedVariable by_day("PLUMBLINE_NIGHTLY", "");
  EXPECT_DOUBLE_EQ(ErrorBudget{}.fail_level(), 1e-10);
  EXPECT_NEAR(ErrorBudget{}.pass_level(), 1e-3, 1e-15);
}

TEST(Budget, LooksSpendBothLevelsAndNoMore) {
  for (const std::uint64_t cap : {1u, 1000u, 1250u, 1251u, 20'000u, 95'000'000u}) {
    const LookPlan plan = plan_looks(1250, cap, ErrorBudget{});
    EXPECT_NEAR(sum(plan.fail_level), ErrorBudget{}.fail_level(), 1e-22) << cap;
    EXPECT_NEAR(sum(plan.pass_level), 1e-3, 1e-12) << cap;
    EXPECT_EQ(plan.samples.back(), cap);
    for (std::size_t k = 1; k < plan.samples.size(); ++k) {
      EXPECT_GT(plan.samples[k], plan.samples[k - 1]) << cap;
    }
  }
}

TEST(Budget, LooksDoubleFromTheFirst) {
  const LookPlan plan = plan_looks(1250, 20'000, ErrorBudget{});
  EXPECT_EQ(plan.samples, (std::vector<std::uint64_t>{1250, 2500, 5000, 10'000, 20'000}));
}

TEST(Budget, LooksOfAMeanSpendBothLevelsAndNoMore) {
  for (const std::uint64_t cap : {1u, 1000u, 1250u, 1251u, 1487u, 2000u, 20'000u, 95'000'000u}) {
    const LookPlan plan = plan_mean_looks(1250, cap, ErrorBudget{});
    EXPECT_NEAR(sum(plan.fail_level), 1e-10, 1e-22) << cap;
    EXPECT_NEAR(sum(plan.pass_level) + plan.line_level + plan.unseen_level, 1e-3, 1e-12) << cap;
    EXPECT_EQ(plan.samples.back(), cap);
    for (std::size_t k = 1; k < plan.samples.size(); ++k) {
      // Rounded to whole samples.
      EXPECT_GE(static_cast<double>(plan.samples[k]) + 1,
                kLookRatio * static_cast<double>(plan.samples[k - 1] - 1))
          << cap;
    }
  }
}

TEST(Budget, LooksOfAMeanAreEvenInTheLogarithmAndFourInADoubling) {
  const LookPlan plan = plan_mean_looks(1250, 20'000, ErrorBudget{});
  ASSERT_EQ(plan.samples.size(), 17u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(plan.samples[4 * k], 1250u << k);
  // Where no whole number of steps fits, they are longer.
  using Counts = std::vector<std::uint64_t>;
  EXPECT_EQ(plan_mean_looks(1250, 1486, ErrorBudget{}).samples, (Counts{1486}));
  EXPECT_EQ(plan_mean_looks(1250, 1760, ErrorBudget{}).samples, (Counts{1250, 1760}));
  EXPECT_EQ(plan_mean_looks(1, 4, ErrorBudget{}).samples, (Counts{1, 2, 3, 4}));
}

TEST(Budget, RefusesNoSamplesAtAll) {
  EXPECT_THROW(plan_looks(0, 10, ErrorBudget{}), std::invalid_argument);
  EXPECT_THROW(plan_looks(10, 0, ErrorBudget{}), std::invalid_argument);
  EXPECT_THROW(plan_mean_looks(0, 10, ErrorBudget{}), std::invalid_argument);
  EXPECT_THROW(plan_mean_looks(10, 0, ErrorBudget{}), std::invalid_argument);
  EXPECT_THROW(samples_to_decide(0, 1), std::invalid_argument);
}

/// What looks at a Brownian motion make of the line: its tolerance is 1, and the samples at a look
/// are counted in (cv/tolerance)².
struct Line {
  double wrong_pass = 0;  ///< chance of a pass where the bias is the tolerance
  double samples = 0;     ///< mean number that a right estimator takes
};

constexpr double kGrid = 0.1;  // of the sum of the deviations; its spread is above 3 at all looks

/// Chances by the sum −M…M of a right estimator after `more` samples.
std::vector<double> after(const std::vector<double>& before, double more, std::size_t half) {
  const double step = std::sqrt(more);
  std::vector<double> kernel;
  for (double x = 0; x < 7 * step; x += kGrid) {
    kernel.push_back(kGrid / step * std::exp(-x * x / (2 * more)) / std::sqrt(2 * M_PI));
  }
  std::vector<double> chance(2 * half + 1, 0.0);
  const auto old_half = static_cast<std::ptrdiff_t>(before.size() / 2);
  const auto new_half = static_cast<std::ptrdiff_t>(half);
  const auto reach = static_cast<std::ptrdiff_t>(kernel.size()) - 1;
  for (std::ptrdiff_t from = -old_half; from <= old_half; ++from) {
    const double here = before[static_cast<std::size_t>(from + old_half)];
    if (here == 0) continue;
    for (auto to = std::max(-new_half, from - reach); to <= std::min(new_half, from + reach);
         ++to) {
      chance[static_cast<std::size_t>(to + new_half)] +=
          here * kernel[static_cast<std::size_t>(std::abs(to - from))];
    }
  }
  return chance;
}

/// By the recursion of Armitage, McPherson and Rowe over the sums of a right estimator, which a
/// likelihood ratio turns into those of a wrong one.
///
/// @param first  samples at the first look
Line along_the_line(double level, double first) {
  Line result;
  std::vector<double> chance{1};
  double drawn = 0, undecided = 1;
  for (double n = first; undecided > 1e-7; n *= kLookRatio) {
    const auto half = static_cast<std::size_t>(8 * std::sqrt(n) / kGrid);
    chance = after(chance, n - drawn, half);
    drawn = n;
    const double most = n - line_quantile(std::sqrt(n), level) * std::sqrt(n);
    for (std::size_t i = 0; i < chance.size(); ++i) {
      const double x = kGrid * (static_cast<double>(i) - static_cast<double>(half));
      // The part of the cell that lies within.
      const double part = std::clamp((most - std::abs(x)) / kGrid + 0.5, 0.0, 1.0);
      const double passed = part * chance[i];
      result.wrong_pass += passed * std::exp(x - n / 2);
      result.samples += passed * n;
      undecided -= passed;
      chance[i] -= passed;
    }
  }
  return result;
}

TEST(Budget, TheLineIsWrongAtAllLooksTogetherNoMoreOftenThanItsLevel) {
  for (const double level : {0.05, 0.01, 1e-3, 1e-5, 1e-8}) {
    double worst = 0;
    for (int phase = 0; phase < 4; ++phase) {
      worst =
          std::max(worst, along_the_line(level, 5 * std::pow(kLookRatio, phase / 4.0)).wrong_pass);
    }
    EXPECT_LE(worst, level) << level;
    EXPECT_GE(worst, 0.85 * level) << level;
  }
  // Line and levels of a single look each would be wrong too often, or take more samples.
  EXPECT_NEAR(along_the_line(7.2e-4, 5).samples, 20.8, 0.3);
}

TEST(Budget, SamplesToDecideIsTheCapOfTheStatisticsPolicy) {
  const ScopedVariable by_day("PLUMBLINE_NIGHTLY", "0");
  EXPECT_NEAR(static_cast<double>(samples_to_decide(0.001, 1)), 1.04e8, 1);
  EXPECT_NEAR(static_cast<double>(samples_to_decide(0.005, 1)), 4.16e6, 1);
}

/// Standard errors of the bound at a look, as judge_mean takes them.
double reach(const LookPlan& plan, std::size_t look, double tolerance_over_error) {
  const double own = quantile(complement(boost::math::normal(), plan.pass_level[look]));
  if (plan.line_level == 0) return own;
  return std::min(own, line_quantile(tolerance_over_error, plan.line_level));
}

TEST(Budget, SamplesToDecideLeaveACorrectEstimatorUndecidedNoMoreOftenThanTheLevel) {
  const boost::math::normal normal;
  for (const double tolerance : {0.1, 0.02, 0.005, 0.001, 0.0005}) {
    const std::uint64_t cap = samples_to_decide(tolerance, 1);
    const double error = 1 / std::sqrt(static_cast<double>(cap));
    // With one look and with as many as a first look at 1,250 samples gives.
    for (const std::uint64_t n0 : {std::uint64_t{1250}, cap}) {
      const LookPlan plan = plan_mean_looks(n0, cap, ErrorBudget{});
      const double z = reach(plan, plan.samples.size() - 1, tolerance / error);
      const double undecided = 2 * cdf(complement(normal, tolerance / error - z));
      EXPECT_LE(undecided, ErrorBudget{}.fail_level()) << tolerance << ' ' << n0;
    }
  }
}

TEST(Budget, HalfOfAllRunsNeedLessThanAFifthOfIt) {
  // Error by Brownian motion at the looks of the plan, until |error| + z se is below the tolerance.
  constexpr int kRuns = 4000;
  constexpr double kTolerance = 0.005;
  const std::uint64_t cap = samples_to_decide(kTolerance, 1);
  const LookPlan plan = plan_mean_looks(1250, cap, ErrorBudget{});
  const boost::math::normal normal;
  Random random(1);
  std::vector<double> needed;
  for (int run = 0; run < kRuns; ++run) {
    double sum = 0, drawn = 0;
    for (std::size_t k = 0; k < plan.samples.size(); ++k) {
      const double n = static_cast<double>(plan.samples[k]);
      sum += std::sqrt(n - drawn) * quantile(normal, std::max(random.uniform(), 1e-300));
      drawn = n;
      const double z = reach(plan, k, kTolerance * std::sqrt(n));
      if (std::abs(sum / n) + z / std::sqrt(n) <= kTolerance) break;
    }
    needed.push_back(drawn / static_cast<double>(cap));
  }
  std::nth_element(needed.begin(), needed.begin() + kRuns / 2, needed.end());
  // Looks are a factor of 1.19 apart, and the median is one of them.
  EXPECT_GT(needed[kRuns / 2], 0.18 / kLookRatio);
  EXPECT_LT(needed[kRuns / 2], 0.18 * kLookRatio);
}

TEST(NightLevel, IsInForceWhereTheEnvironmentSaysSo) {
  for (const char* night : {"1", "gate"}) {
    const ScopedVariable variable("PLUMBLINE_NIGHTLY", night);
    EXPECT_DOUBLE_EQ(ErrorBudget{}.fail_level(), 1e-10 / 365) << night;
    EXPECT_DOUBLE_EQ(MeanOptions{}.budget.fail_level(), history::night_budget().fail_level());
    EXPECT_DOUBLE_EQ(ErrorBudget{}.pass_confidence, 0.999);
    // 3.719 + 7.302 standard errors, where it is 3.719 + 6.467 by day.
    EXPECT_NEAR(static_cast<double>(samples_to_decide(0.001, 1)), 1.22e8, 1);
  }
  const ScopedVariable night("PLUMBLINE_NIGHTLY", "1");
  EXPECT_DOUBLE_EQ(ErrorBudget{.suite_level = 0.5}.suite_level, 0.5);
}

TEST(NightLevel, WhatFailsByDayAndLiesWithinTheNightsLevelIsNoFailureOfANight) {
  // One look at 125,000 numbers with mean ½ and standard deviation √(1/12) exactly: 6.9 standard
  // errors off. By day 6.5 of them are a failure, at night 7.3.
  const auto verdict = [](const char* night) {
    const ScopedVariable variable("PLUMBLINE_NIGHTLY", night);
    constexpr int kCount = 125'000;
    MeanOptions off;
    off.n0 = off.max_samples = kCount;
    off.reference = 0.5 + 6.9 * std::sqrt(1 / 12.0 / kCount);
    return check_mean(off,
                      [](std::uint64_t first, std::uint64_t count) {
                        Moments moments;
                        for (std::uint64_t i = first; i < first + count; ++i) {
                          moments.add((static_cast<double>(i) + 0.5) / kCount);
                        }
                        return moments;
                      })
        .verdict;
  };
  EXPECT_EQ(verdict(""), Verdict::fail);
  EXPECT_EQ(verdict("1"), Verdict::inconclusive);
}

/// Of so many years, the share with a night on which a right mean fails, against 5 %, which are
/// spent each `period` nights, over 8 checks of which one is made.
CheckResult red_years(const char* subject, std::uint64_t years, double period, Verdict expected) {
  ProportionOptions claim;
  claim.subject = subject;
  claim.seed = tests::check_seed(subject);
  claim.at_most = 0.05;
  claim.expected = expected;
  MeanOptions check;
  check.reference = 0.5;
  check.n0 = check.max_samples = 1000;  // the fewest that are judged
  check.budget.suite_level = claim.at_most / period;
  check.budget.max_checks = 8;
  Random random(claim.seed);
  std::uint64_t red = 0;
  for (std::uint64_t year = 0; year < years; ++year) {
    bool fails = false;
    for (int night = 0; night < 365 && !fails; ++night) {
      const CheckResult r = check_mean(check, [&](std::uint64_t, std::uint64_t count) {
        Moments moments;
        for (std::uint64_t i = 0; i < count; ++i) moments.add(random.uniform());
        return moments;
      });
      fails = r.verdict == Verdict::fail;
    }
    red += fails ? 1u : 0u;
  }
  return check_proportion(claim, red, years);
}

TEST(NightLevel, YearsOfNightsAreAsSeldomRedAsStated) {
  // An eighth of 5 % is made use of: at most 2.5 years of 400 are expected, and a tenth of that,
  // since a fail needs what none of 1,000 samples may have shown on top; more than eight leave the
  // claim undecided.
  tests::expect_verdict(red_years("budget/years of nights", 400, 365, Verdict::pass));
}

TEST(NightLevel, NightsWithTheLevelOfARunMakeRedYears) {
  tests::expect_verdict(red_years("budget/years of gates", 100, 1, Verdict::fail));
}

}  // namespace
}  // namespace plumbline::verify
