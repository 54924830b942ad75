#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

#include <plumbline/verify/detail/budget.h>

namespace plumbline::verify {
namespace {

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

TEST(Budget, GivesEachCheckTheSameLevelWhateverElseRuns) {
  EXPECT_DOUBLE_EQ(ErrorBudget{}.fail_level(), 1e-8);
  EXPECT_NEAR(ErrorBudget{}.pass_level(), 1e-3, 1e-15);
}

TEST(Budget, LooksSpendBothLevelsAndNoMore) {
  for (const std::uint64_t cap : {1u, 1000u, 1250u, 1251u, 20'000u, 73'000'000u}) {
    const LookPlan plan = plan_looks(1250, cap, ErrorBudget{});
    EXPECT_NEAR(sum(plan.fail_level), 1e-8, 1e-20) << cap;
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
  EXPECT_NEAR(static_cast<double>(samples_to_decide(0.001, 1)), 7.3e7, 1);
  EXPECT_NEAR(static_cast<double>(samples_to_decide(0.005, 1)), 2.92e6, 1);
}

}  // namespace
}  // namespace plumbline::verify
