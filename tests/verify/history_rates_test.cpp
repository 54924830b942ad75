#include <gtest/gtest.h>
#include <plumbline_tests/figures.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include <plumbline/verify/history/regressions.h>
#include <plumbline/verify/ratio.h>

#include "simulated_history.h"

/// How often `judge_history` is wrong, and how small a step it finds: the numbers of
/// docs/statistics.md, "Over nights". The gate simulates few and short histories, the night those
/// of the tables: PLUMBLINE_NIGHTLY=1 build/release/tests/verify/history_test
/// --gtest_filter='HistoryRates.*'
namespace plumbline::verify::history {
namespace {

/// Whether a history of nights without any change ever shows one, judged each night.
bool ever_alarms(Random& random, int nights, const NightNoise& noise,
                 const HistoryOptions& options) {
  CorrelatedNoise night_noise(random, noise.correlation);
  Series series;
  for (int i = 0; i < nights; ++i) {
    series.nights.push_back(simulated_night(random, noise, night_noise, 1));
    if (!judge_history(series, options).changes.empty()) return true;
  }
  return false;
}

/// Histories that show a change, of so many, against the share that the options promise.
CheckResult alarms(const std::string& subject, std::uint64_t histories, int nights,
                   const NightNoise& noise, const HistoryOptions& options) {
  ProportionOptions claim;
  claim.subject = subject;
  claim.seed = tests::check_seed(subject);
  claim.at_most = options.false_alarms_per_year / options.tracked_numbers * nights / 365;
  Random random(claim.seed);
  std::uint64_t hits = 0;
  for (std::uint64_t i = 0; i < histories; ++i) {
    hits += ever_alarms(random, nights, noise, options) ? 1u : 0u;
  }
  return check_proportion(claim, hits, histories);
}

HistoryOptions with_numbers(int tracked) {
  HistoryOptions options;
  options.tracked_numbers = tracked;
  return options;
}

TEST(HistoryRates, FalseAlarmsAreAsSeldomAsPromised) {
  tests::expect_verdict(alarms("history/alarms/60 nights", 300, 60, {}, with_numbers(1)));
  if (!tests::nightly()) return;
  tests::expect_verdict(
      alarms("history/alarms/a year, 100 numbers", 2000, 365, {}, with_numbers(100)));
  NightNoise uncorrelated;
  uncorrelated.correlation = 0;
  tests::expect_verdict(
      alarms("history/alarms/uncorrelated nights", 300, 365, uncorrelated, with_numbers(10)));
}

TEST(HistoryRates, NightsThatAreMoreCorrelatedThanAssumedAlarmTooOften) {
  NightNoise noise;
  noise.correlation = 0.9;
  HistoryOptions options = with_numbers(1);
  options.night_correlation = 0;
  CheckResult r = alarms("history/alarms/correlation not assumed", 60, 60, noise, options);
  r.expected = Verdict::fail;
  tests::expect_verdict(r);
}

/// The share of histories in which a step in their middle is found, against the stated 95 %.
CheckResult found(const std::string& subject, std::uint64_t histories, int nights, double spread,
                  double step, double at_least) {
  ProportionOptions claim;
  claim.subject = subject;
  claim.seed = tests::check_seed(subject);
  claim.at_least = at_least;
  Random random(claim.seed);
  std::uint64_t hits = 0;
  for (std::uint64_t i = 0; i < histories; ++i) {
    const Series series = simulated_history(
        random, nights, {spread}, [&](int night) { return night < nights / 2 ? 1 : 1 + step; });
    const std::vector<Change> changes = judge_history(series).changes;
    hits +=
        std::any_of(changes.begin(), changes.end(), [](const Change& c) { return c.regression; })
            ? 1u
            : 0u;
  }
  return check_proportion(claim, hits, histories);
}

/// A row of the table of steps that are found.
struct FoundRow {
  int nights = 0;
  double steps[4] = {};  ///< at 0.5, 1, 2 and 5 % from night to night; 0: none below 200 %
};

// Found in 98.5 % at least, measured with 4,000: then 2,000 prove 95 %, but once in 1e7.
constexpr FoundRow kFoundSteps[] = {{10, {0.28, 0.6, 1.5, 0}},
                                    {30, {0.029, 0.059, 0.121, 0.33}},
                                    {60, {0.0163, 0.0328, 0.0665, 0.176}},
                                    {120, {0.0142, 0.0285, 0.0585, 0.151}}};

constexpr double kSpreads[] = {0.005, 0.01, 0.02, 0.05};

/// The table as the page draws it.
void publish_found_steps() {
  reports::Figure figure;
  figure.group = "What a history can see";
  figure.title = "Steps that are found with 95 %, after as many nights";
  figure.caption =
      "Simulated histories with a step in the middle: the smallest one that 95 % of them show, as "
      "proven with 2,000 histories each, by how much the nights spread.";
  figure.x = {"nights", true};
  figure.y = {"step [% of the number]", true};
  for (std::size_t i = 0; i < std::size(kSpreads); ++i) {
    reports::FigureSeries series;
    series.name = std::to_string(100 * kSpreads[i]).substr(0, 3) + " % from night to night";
    for (const FoundRow& row : kFoundSteps) {
      if (row.steps[i] == 0) continue;
      series.x.push_back(row.nights);
      series.y.push_back(100 * row.steps[i]);
    }
    figure.series.push_back(series);
  }
  tests::publish(figure, "history");
}

TEST(HistoryRates, StepsOfTheTableAreFound) {
  // 98.75 % are, of 4,000: of 300 in the gate 19 misses leave 0.88 unproven, once in 4e7 runs.
  tests::expect_verdict(found("history/found/60 nights, 1 %", 300, 60, 0.01, 0.0328, 0.88));
  if (!tests::nightly()) return;
  for (const FoundRow& row : kFoundSteps) {
    for (int i = 0; i < 4; ++i) {
      const double step = row.steps[i];
      if (step == 0) continue;
      const std::string subject = "history/found/" + std::to_string(row.nights) + " nights, " +
                                  std::to_string(kSpreads[i]) + ", step " + std::to_string(step);
      tests::expect_verdict(found(subject, 2000, row.nights, kSpreads[i], step, 0.95));
    }
  }
  publish_found_steps();
}

}  // namespace
}  // namespace plumbline::verify::history
