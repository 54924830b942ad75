#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/history/regressions.h>

#include "simulated_history.h"

namespace plumbline::verify::history {
namespace {

/// Simulated nights of a number with a name.
Series noisy_nights(const char* name, int nights, double spread,
                    const std::function<double(int)>& true_level,
                    const std::set<int>& missing = {}) {
  Random random(tests::check_seed(name));
  Series series = simulated_history(random, nights, {spread}, true_level);
  series.name = name;
  for (const int night : missing) series.nights[static_cast<std::size_t>(night)].values.clear();
  return series;
}

bool is_near(std::size_t night, std::size_t truth, std::size_t reach) {
  return night + reach >= truth && night <= truth + reach;
}

// Sixty nights that are judged as a whole. Steps are large against the spread and alarms rare, so
// that no seed decides: how small a step is found is measured below.
constexpr double kSpread = 0.003;

HistoryOptions rare_alarms() {
  HistoryOptions options;
  options.tracked_numbers = 1'000'000;
  return options;
}

TEST(History, NothingIsFoundWhereNothingIs) {
  const Series series = noisy_nights("history/quiet", 60, kSpread, [](int) { return 1.0; });
  const HistoryJudgement judged = judge_history(series, rare_alarms());
  EXPECT_TRUE(judged.changes.empty());
  EXPECT_EQ(judged.nights, 60u);
}

TEST(History, AStepIsFoundWithItsSizeAndCommits) {
  const Series series =
      noisy_nights("history/step", 60, kSpread, [](int i) { return i < 40 ? 1.0 : 1.05; });
  const HistoryJudgement judged = judge_history(series, rare_alarms());
  ASSERT_EQ(judged.changes.size(), 1u);
  const Change& change = judged.changes[0];
  EXPECT_EQ(change.shape, ChangeShape::step);
  EXPECT_TRUE(change.regression);
  EXPECT_EQ(change.first_night, 40u);
  EXPECT_EQ(change.commit_first, "c" + std::to_string(change.first_night));
  EXPECT_EQ(change.commit_before, "c" + std::to_string(change.first_night - 1));
  EXPECT_EQ(change.commit_last, change.commit_first);
  EXPECT_NEAR(change.relative, 0.05, 0.007);  // six standard errors of 20 correlated nights
  EXPECT_LT(change.low, change.relative);
  EXPECT_GT(change.high, change.relative);
  EXPECT_NEAR(change.after / change.before - 1, change.relative, 1e-12);
  EXPECT_LT(change.means_p_value, change_level(rare_alarms()));
  EXPECT_LE(change.distribution_p_value, 0.01);
}

TEST(History, WhichWayIsGoodDecidesWhatARegressionIs) {
  Series series =
      noisy_nights("history/throughput", 60, kSpread, [](int i) { return i < 30 ? 1.0 : 1.06; });
  ASSERT_EQ(judge_history(series, rare_alarms()).changes.size(), 1u);
  EXPECT_TRUE(judge_history(series, rare_alarms()).changes[0].regression);
  series.better = Better::higher;
  ASSERT_EQ(judge_history(series, rare_alarms()).changes.size(), 1u);
  EXPECT_FALSE(judge_history(series, rare_alarms()).changes[0].regression);
  HistoryOptions options = rare_alarms();
  options.smallest_change = 0.1;
  EXPECT_TRUE(judge_history(series, options).changes.empty());
}

TEST(History, ThereAndBackAreTwoChanges) {
  const Series series = noisy_nights("history/there and back", 60, kSpread,
                                     [](int i) { return i >= 20 && i < 40 ? 1.08 : 1.0; });
  const HistoryJudgement judged = judge_history(series, rare_alarms());
  ASSERT_EQ(judged.changes.size(), 2u);
  EXPECT_TRUE(judged.changes[0].regression);
  EXPECT_FALSE(judged.changes[1].regression);
  EXPECT_EQ(judged.changes[0].first_night, 20u);
  EXPECT_EQ(judged.changes[1].first_night, 40u);
}

TEST(History, ADriftIsOneChangeWithARange) {
  const Series series = noisy_nights("history/drift", 60, kSpread, [](int i) {
    return 1 + 0.15 * std::clamp((i - 15) / 30.0, 0.0, 1.0);
  });
  const HistoryJudgement judged = judge_history(series, rare_alarms());
  ASSERT_EQ(judged.changes.size(), 1u);
  const Change& change = judged.changes[0];
  EXPECT_EQ(change.shape, ChangeShape::drift);
  EXPECT_TRUE(change.regression);
  EXPECT_TRUE(is_near(change.first_night, 16, 5)) << change.first_night;
  EXPECT_TRUE(is_near(change.last_night, 45, 5)) << change.last_night;
  EXPECT_NEAR(change.relative, 0.15, 0.03);
  EXPECT_EQ(change.commit_last, "c" + std::to_string(change.last_night));
}

TEST(History, OneOrTwoBadNightsAreNoChange) {
  for (const int last : {30, 31, 59, 60}) {
    const Series series = noisy_nights("history/bad nights", 61, kSpread, [&](int i) {
      return i == last || (i == 31 && last == 30) ? 1.5 : 1.0;
    });
    const HistoryJudgement judged = judge_history(series, rare_alarms());
    EXPECT_TRUE(judged.changes.empty()) << last;
    EXPECT_EQ(std::count(judged.odd_nights.begin(), judged.odd_nights.end(), last), 1) << last;
  }
}

TEST(History, ABadNightHidesNoChange) {
  const Series series = noisy_nights("history/bad night and step", 60, kSpread, [](int i) {
    return i == 12 || i == 50 ? 2.0 : i < 35 ? 1.0 : 0.94;
  });
  const HistoryJudgement judged = judge_history(series, rare_alarms());
  ASSERT_EQ(judged.changes.size(), 1u);
  EXPECT_FALSE(judged.changes[0].regression);
  EXPECT_EQ(judged.changes[0].first_night, 35u);
  EXPECT_EQ(judged.odd_nights, (std::vector<std::size_t>{12, 50}));
}

TEST(History, MissingNightsWidenTheRangeOfCommits) {
  const Series series = noisy_nights("history/missing", 60, 0.01,
                                     [](int i) { return i < 31 ? 1.0 : 1.2; }, {5, 6, 29, 30, 31});
  const HistoryJudgement judged = judge_history(series, rare_alarms());
  EXPECT_EQ(judged.nights, 55u);
  ASSERT_EQ(judged.changes.size(), 1u);
  EXPECT_EQ(judged.changes[0].commit_before, "c28");
  EXPECT_EQ(judged.changes[0].commit_first, "c32");
}

TEST(History, AChangeTakesFiveNightsAndTenInAll) {
  // Nights without chance: of noisy ones one in a thousand is left out for its own scatter.
  const auto judged = [](int nights, int from) {
    Series series;
    series.name = "history/few";
    for (int i = 0; i < nights; ++i) {
      const double level = (i < from ? 1.0 : 2.0) * (1 + 0.001 * (i * 7 % 5));
      Night& night = series.nights.emplace_back();
      night.commit = "c" + std::to_string(i);
      night.values = {0.999 * level, level, 1.001 * level};
    }
    return judge_history(series).changes.size();
  };
  EXPECT_EQ(judged(34, 30), 0u);
  EXPECT_EQ(judged(35, 30), 1u);
  EXPECT_EQ(judged(9, 5), 0u);
  EXPECT_EQ(judged(10, 5), 1u);
}

Series counter(std::vector<double> values) {
  Series series;
  series.name = "rays";
  series.kind = NumberKind::counter;
  for (std::size_t i = 0; i < values.size(); ++i) {
    Night& night = series.nights.emplace_back();
    night.commit = "c" + std::to_string(i);
    if (values[i] >= 0) night.values = {values[i], values[i]};
  }
  return series;
}

TEST(History, ACounterChangesInOneNight) {
  // One in a million more, a missing night, and back.
  const HistoryJudgement judged = judge_history(counter({1e6, 1e6, 1e6 + 1, -1, 1e6}));
  ASSERT_EQ(judged.changes.size(), 2u);
  EXPECT_EQ(judged.changes[0].first_night, 2u);
  EXPECT_TRUE(judged.changes[0].regression);
  EXPECT_NEAR(judged.changes[0].relative, 1e-6, 1e-15);
  EXPECT_EQ(judged.changes[0].low, judged.changes[0].relative);
  EXPECT_EQ(judged.changes[0].high, judged.changes[0].relative);
  EXPECT_EQ(judged.changes[1].first_night, 4u);
  EXPECT_EQ(judged.changes[1].commit_before, "c2");
  EXPECT_EQ(judged.changes[1].commit_first, "c4");
  EXPECT_FALSE(judged.changes[1].regression);
  EXPECT_TRUE(judge_history(counter({7, 7, -1, 7})).changes.empty());
}

TEST(History, RefusesWhatCannotBeJudged) {
  Series uneven = counter({1, 1});
  uneven.nights[1].values = {1, 2};
  EXPECT_THROW(judge_history(uneven), std::invalid_argument);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    Series series;
    series.nights = {{"c", {1, bad}}};
    EXPECT_THROW(judge_history(series), std::invalid_argument);
  }
  const auto refused = [](auto change) {
    HistoryOptions options;
    change(options);
    EXPECT_THROW(change_level(options), std::invalid_argument);
    EXPECT_THROW(judge_history(counter({1}), options), std::invalid_argument);
  };
  refused([](auto& o) { o.tracked_numbers = 0; });
  refused([](auto& o) { o.false_alarms_per_year = 0; });
  refused([](auto& o) { o.night_correlation = 1; });
  refused([](auto& o) { o.night_correlation = -0.1; });
  refused([](auto& o) { o.smallest_change = -1; });
  refused([](auto& o) { o.confidence = 1; });
}

}  // namespace
}  // namespace plumbline::verify::history
