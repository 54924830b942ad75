#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <plumbline/verify/detail/budget.h>
#include <plumbline/verify/detail/random.h>

namespace plumbline::verify {
namespace {

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

TEST(Budget, GivesEachCheckTheSameLevelWhateverElseRuns) {
  EXPECT_DOUBLE_EQ(ErrorBudget{}.fail_level(), 1e-10);
  EXPECT_NEAR(ErrorBudget{}.pass_level(), 1e-3, 1e-15);
}

TEST(Budget, LooksSpendBothLevelsAndNoMore) {
  for (const std::uint64_t cap : {1u, 1000u, 1250u, 1251u, 20'000u, 95'000'000u}) {
    const LookPlan plan = plan_looks(1250, cap, ErrorBudget{});
    EXPECT_NEAR(sum(plan.fail_level), 1e-10, 1e-22) << cap;
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

TEST(Budget, RefusesNoSamplesAtAll) {
  EXPECT_THROW(plan_looks(0, 10, ErrorBudget{}), std::invalid_argument);
  EXPECT_THROW(plan_looks(10, 0, ErrorBudget{}), std::invalid_argument);
  EXPECT_THROW(samples_to_decide(0, 1), std::invalid_argument);
}

TEST(Budget, SamplesToDecideIsTheCapOfTheStatisticsPolicy) {
  EXPECT_NEAR(static_cast<double>(samples_to_decide(0.001, 1)), 9.5e7, 1);
  EXPECT_NEAR(static_cast<double>(samples_to_decide(0.005, 1)), 3.8e6, 1);
}

TEST(Budget, SamplesToDecideLeaveACorrectEstimatorUndecidedNoMoreOftenThanTheLevel) {
  const boost::math::normal normal;
  for (const double tolerance : {0.1, 0.02, 0.005, 0.001, 0.0005}) {
    const std::uint64_t cap = samples_to_decide(tolerance, 1);
    const double error = 1 / std::sqrt(static_cast<double>(cap));
    // With one look and with as many as a first look at 1,250 samples gives.
    for (const std::uint64_t n0 : {std::uint64_t{1250}, cap}) {
      const LookPlan plan = plan_looks(n0, cap, ErrorBudget{});
      const double z = quantile(complement(normal, plan.pass_level.back()));
      const double undecided = 2 * cdf(complement(normal, tolerance / error - z));
      EXPECT_LE(undecided, ErrorBudget{}.fail_level()) << tolerance << ' ' << n0;
    }
  }
}

TEST(Budget, HalfOfAllRunsNeedAFifthOfIt) {
  // Error by Brownian motion at the looks of the plan, until |error| + z se is below the tolerance.
  constexpr int kRuns = 4000;
  constexpr double kTolerance = 0.005;
  const std::uint64_t cap = samples_to_decide(kTolerance, 1);
  const LookPlan plan = plan_looks(1250, cap, ErrorBudget{});
  const boost::math::normal normal;
  Random random(1);
  std::vector<double> needed;
  for (int run = 0; run < kRuns; ++run) {
    double sum = 0, drawn = 0;
    for (std::size_t k = 0; k < plan.samples.size(); ++k) {
      const double n = static_cast<double>(plan.samples[k]);
      sum += std::sqrt(n - drawn) * quantile(normal, std::max(random.uniform(), 1e-300));
      drawn = n;
      const double z = quantile(complement(normal, plan.pass_level[k]));
      if (std::abs(sum / n) + z / std::sqrt(n) <= kTolerance) break;
    }
    needed.push_back(drawn / static_cast<double>(cap));
  }
  std::nth_element(needed.begin(), needed.begin() + kRuns / 2, needed.end());
  // Looks double, and the median is one of them.
  EXPECT_GT(needed[kRuns / 2], 0.21 / 2);
  EXPECT_LT(needed[kRuns / 2], 0.21 * 2);
}

}  // namespace
}  // namespace plumbline::verify
