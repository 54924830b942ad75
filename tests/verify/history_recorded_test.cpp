#include <gtest/gtest.h>
#include <plumbline_tests/figures.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <plumbline/verify/history/duet.h>
#include <plumbline/verify/history/regressions.h>
#include <plumbline/verify/ratio.h>

#include "recorded_noise.h"

/// What duets and histories see in noise that was recorded on a machine that compiled other work
/// all the time: docs/statistics.md, "Over nights".
namespace plumbline::verify::history {
namespace {

constexpr std::size_t kBlock = 5;  // nights that stay together: levels of the load lasted longer

TEST(RecordedNoise, IsAllThere) {
  const std::vector<Recorded> runs = recorded_runs(), duets = recorded_duets();
  ASSERT_EQ(runs.size(), 24u);
  ASSERT_EQ(duets.size(), 3u);
  for (const Recorded& recorded : runs) {
    EXPECT_EQ(recorded.runs.size(), 60u) << recorded.name;
    EXPECT_EQ(recorded.runs.back().size(), 5u) << recorded.name;
  }
  for (const Recorded& recorded : duets) EXPECT_EQ(recorded.runs.size(), 60u) << recorded.name;
}

/// One night's duet: launches drawn anew, b slowed.
DuetRatio recorded_duet(Random& random, const Recorded& recorded, int launches, double slowdown) {
  Blocks blocks(random, recorded, 1);
  std::vector<DuetPair> pairs;
  for (int launch = 0; launch < launches; ++launch) {
    for (const double log_ratio : blocks.next()) {
      pairs.push_back({1, (1 + slowdown) * std::exp(log_ratio)});
    }
  }
  return duet_ratio(pairs);
}

/// Of so many nights, in how many a duet says "slower by more than the margin", against a claim.
CheckResult duets_called_slower(const Recorded& recorded, int launches, double slowdown,
                                double margin, std::uint64_t nights, double at_least,
                                double at_most) {
  ProportionOptions claim;
  claim.subject = "history/recorded duet/" + recorded.name + "/" + std::to_string(slowdown) + "/" +
                  std::to_string(launches) + " launches";
  claim.seed = tests::check_seed(claim.subject);
  claim.at_least = at_least;
  claim.at_most = at_most;
  Random random(claim.seed);
  std::uint64_t hits = 0;
  for (std::uint64_t i = 0; i < nights; ++i) {
    const DuetRatio duet = recorded_duet(random, recorded, launches, slowdown);
    hits += judge_duet(duet, margin) == DuetVerdict::slower ? 1u : 0u;
  }
  return check_proportion(claim, hits, nights);
}

TEST(RecordedDuets, FindTwoPercentInOneNight) {
  for (const Recorded& recorded : recorded_duets()) {
    tests::expect_verdict(duets_called_slower(recorded, 60, 0.02, 0, 300, 0.95, 1));
  }
}

TEST(RecordedDuets, SeldomCallIdenticalCodeSlowerByTheMargin) {
  for (const Recorded& recorded : recorded_duets()) {
    tests::expect_verdict(duets_called_slower(recorded, 20, 0, 0.01, 1000, 0, 0.01));
  }
}

/// A night of a number at a level.
Night night_of(const std::vector<double>& logarithms, double level) {
  Night night;
  for (const double value : logarithms) night.values.push_back(level * std::exp(value));
  return night;
}

HistoryOptions options_of(std::size_t numbers) {
  HistoryOptions options;
  options.tracked_numbers = static_cast<int>(numbers);
  return options;
}

bool year_alarms(Blocks& nights, const HistoryOptions& options) {
  Series series;
  for (int night = 0; night < 365; ++night) {
    series.nights.push_back(night_of(nights.next(), 1));
    if (!judge_history(series, options).changes.empty()) return true;
  }
  return false;
}

/// Of years without a change, so many of each number, those that show one, against the promise for
/// all numbers together.
CheckResult recorded_alarms(const std::string& subject, std::uint64_t years_of_each,
                            std::size_t block, const HistoryOptions& options) {
  const std::vector<Recorded> numbers = recorded_runs();
  ProportionOptions claim;
  claim.subject = subject;
  claim.seed = tests::check_seed(subject);
  claim.at_most = 1 / static_cast<double>(numbers.size());
  Random random(claim.seed);
  std::uint64_t hits = 0;
  for (const Recorded& recorded : numbers) {
    for (std::uint64_t year = 0; year < years_of_each; ++year) {
      Blocks nights(random, recorded, block);
      hits += year_alarms(nights, options) ? 1u : 0u;
    }
  }
  return check_proportion(claim, hits, years_of_each * numbers.size());
}

TEST(RecordedNights, AlarmAsSeldomAsIsPromised) {
  if (!tests::nightly()) GTEST_SKIP() << "a thousand years";
  // Drawn one by one: nights are a day apart, and share no load as runs that follow each other do.
  tests::expect_verdict(
      recorded_alarms("history/recorded nights/alarms", 40, 1, options_of(recorded_runs().size())));
}

TEST(RecordedNights, AlarmTooOftenAtTheLevelOfOneNumberWithoutCorrelation) {
  HistoryOptions of_one = options_of(1);
  of_one.night_correlation = 0;
  CheckResult r =
      recorded_alarms("history/recorded nights/alarms, level of one", 2, kBlock, of_one);
  r.expected = Verdict::fail;
  tests::expect_verdict(r);
}

/// The share of histories in which a step in the middle is found within five nights of its place.
double share_found(Random& random, const Recorded& recorded, int nights, double step, int count) {
  int found = 0;
  for (int i = 0; i < count; ++i) {
    Blocks blocks(random, recorded, kBlock);
    Series series;
    for (int night = 0; night < nights; ++night) {
      series.nights.push_back(night_of(blocks.next(), night < nights / 2 ? 1 : 1 + step));
    }
    const std::vector<Change> changes = judge_history(series).changes;
    found += std::any_of(changes.begin(), changes.end(), [&](const Change& c) {
      return c.regression && std::abs(static_cast<int>(c.first_night) - nights / 2) <= 5;
    });
  }
  return static_cast<double>(found) / count;
}

/// How much the medians of runs scatter, robustly: 1.4826 times their median distance from theirs.
double spread_of(const Recorded& recorded) {
  const auto middle = [](std::vector<double> values) {
    std::nth_element(values.begin(),
                     values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  std::vector<double> levels;
  for (const auto& run : recorded.runs) levels.push_back(middle(run));
  const double level = middle(levels);
  for (double& x : levels) x = std::abs(x - level);
  return 1.4826 * middle(levels);
}

/// The smallest of some steps that 95 % of 200 histories show; NaN where none is.
double smallest_found(Random& random, const Recorded& recorded, int nights) {
  for (const double step : {0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0}) {
    if (share_found(random, recorded, nights, step, 200) >= 0.95) return step;
  }
  return std::nan("");
}

TEST(RecordedNights, ShowStepsThatAreLargeBesideTheirSpread) {
  const std::vector<Recorded> numbers = recorded_runs();
  const auto quietest = std::min_element(
      numbers.begin(), numbers.end(),
      [](const Recorded& a, const Recorded& b) { return spread_of(a) < spread_of(b); });
  Random random(tests::check_seed("history/recorded nights/steps"));
  EXPECT_GE(share_found(random, *quietest, 60, 1, 50), 0.8);
  EXPECT_LE(share_found(random, *quietest, 60, 0, 50), 0.2);
}

/// The curves as the page draws them: the quietest, the middle and the noisiest number.
TEST(RecordedNights, PublishTheStepsThatAreFound) {
  if (!tests::nightly()) GTEST_SKIP() << "a minute, for the page";
  std::vector<Recorded> numbers = recorded_runs();
  std::sort(numbers.begin(), numbers.end(),
            [](const Recorded& a, const Recorded& b) { return spread_of(a) < spread_of(b); });
  reports::Figure figure;
  figure.group = "What a history can see";
  figure.title = "The same on recorded noise of a loaded machine";
  figure.caption =
      "Nights drawn anew, in blocks of five, from 60 runs of the benchmarks on a machine that "
      "compiled other work all the time: the smallest of some steps that 95 % of 200 histories "
      "show. Of ten nights, or of a spread this wide, none may be found.";
  figure.x = {"nights", true};
  figure.y = {"step [% of the number]", true};
  Random random(tests::check_seed("history/recorded nights/steps"));
  for (const std::size_t i : {std::size_t{0}, numbers.size() / 2, numbers.size() - 1}) {
    reports::FigureSeries series;
    const int per_mille = static_cast<int>(std::lround(1000 * spread_of(numbers[i])));
    series.name = numbers[i].name + ", spread " + std::to_string(per_mille / 10) + "." +
                  std::to_string(per_mille % 10) + " %";
    for (const int nights : {10, 30, 60, 120}) {
      series.x.push_back(nights);
      series.y.push_back(100 * smallest_found(random, numbers[i], nights));
    }
    figure.series.push_back(series);
  }
  tests::publish(figure, "history_recorded");
}

}  // namespace
}  // namespace plumbline::verify::history
