#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/reports/history_report.h>

#include "history_sequences.h"

/// What nights show together: a step of a time, a bias that is too small for one night.
namespace plumbline::tests {
namespace {

using reports::History;
using reports::HistoryRecord;
using reports::HistoryRun;
using reports::TrackedSequence;
using verify::Verdict;

constexpr std::size_t kNights = 60, kStep = 35;
constexpr double kError = 1e-3;  // standard error of a night's mean
constexpr std::uint64_t kSamples = 65'536;

verify::CheckResult mean_check(const std::string& subject, double estimate) {
  verify::CheckResult check;
  check.kind = verify::CheckKind::mean;
  check.subject = subject;
  check.verdict = Verdict::pass;
  check.estimate = estimate;
  check.reference = 1;
  check.tolerance = 0.01;
  check.samples = kSamples;
  check.figures = {{verify::Figure::standard_error, kError},
                   {verify::Figure::skewness, 0.01},
                   {verify::Figure::largest_share, 0.001}};
  return check;
}

verify::CheckResult chi_square_check(const std::string& subject, double p_value) {
  verify::CheckResult check;
  check.kind = verify::CheckKind::chi_square;
  check.subject = subject;
  check.verdict = Verdict::pass;
  check.p_value = p_value;
  return check;
}

HistoryRun night(std::size_t i) {
  HistoryRun run;
  run.kind = "nightly";
  run.seed = 1000 + i;
  run.sources = "code";
  run.parts = {{"gate", reports::PartStatus::passed, 60, ""},
               {"benchmarks", reports::PartStatus::skipped, 0, "no time"}};
  run.environment = reports::current_environment();
  run.environment.commit = "commit " + std::to_string(i);
  return run;
}

std::string here() { return reports::comparable_key(reports::current_environment()); }

/// Sixty nights in which what is called "biased" is biased, and what is called "slower" gets
/// slower.
class ReportOfSixtyNights : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const ScratchDirectory scratch;
    History history(scratch / "history.db", History::Access::append);
    std::mt19937_64 random(run_seed());
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    for (std::size_t i = 0; i < kNights; ++i) {
      reports::HistoryData data;
      data.checks = {mean_check("biased", 1 + 2.5 * kError + kError * normal(random)),
                     mean_check("right", 1 + kError * normal(random)),
                     chi_square_check("chi/right", uniform(random)),
                     chi_square_check("chi/wrong", 0.1 * uniform(random))};
      data.checks.push_back(mean_check("control", 2));
      data.checks.back().verdict = data.checks.back().expected = Verdict::fail;
      for (const bool slower : {true, false}) {
        reports::Distribution times{slower ? "slower" : "steady", "ns", true, {}};
        const double level = 100 * (slower && i >= kStep ? 1.1 : 1) * (1 + 0.01 * normal(random));
        for (int k = 0; k < 7; ++k) times.values.push_back(level * (1 + 0.005 * normal(random)));
        data.distributions.push_back(times);
      }
      data.counters = {{"rays", "rays", i < kNights - 1 ? 1000u : 1001u}};
      HistoryRun run = night(i);
      if (i == 20) run.seed_runs = {{5, "abc", "", 100, {"A.B"}}, {6, "abc", "", 100, {}}};
      history.append(run, data);
      // What must not be mixed in: the gate's fixed seed, the same seed again, another machine.
      data.checks = {mean_check("right", 3)};
      run.kind = "test";
      history.append(run, data);
      run.kind = "nightly";
      run.environment.cpu = "another";
      history.append(run, data);
    }
    HistoryRun again = night(0);
    history.append(again, {{mean_check("right", 3)}, {}, {}});
    record_ = reports::judge_runs(history, here(), "nightly");
    of_tests_ = reports::judge_runs(history, here(), "test");
  }

  static const TrackedSequence& sequence(const std::string& subject) {
    for (const TrackedSequence& s : record_.sequences) {
      if (s.subject == subject) return s;
    }
    throw std::runtime_error("no sequence of " + subject);
  }

  static const reports::TrackedNumber& number(const std::string& name) {
    for (const reports::TrackedNumber& n : record_.numbers) {
      if (n.name == name) return n;
    }
    throw std::runtime_error("no number " + name);
  }

  inline static HistoryRecord record_, of_tests_;
};

TEST_F(ReportOfSixtyNights, KeepsThePartsOfEachNight) {
  ASSERT_EQ(record_.nights.front().parts.size(), 2u);
  EXPECT_EQ(record_.nights.front().parts[1].name, "benchmarks");
  EXPECT_EQ(record_.nights.front().skipped_parts, 1u);
}

TEST_F(ReportOfSixtyNights, FindsTheBiasThatNoNightShows) {
  const TrackedSequence& biased = sequence("biased");
  EXPECT_EQ(biased.verdict, Verdict::fail);
  EXPECT_EQ(biased.nights, kNights);
  EXPECT_FALSE(biased.reason.empty());
  EXPECT_NE(sequence("right").verdict, Verdict::fail);
}

TEST_F(ReportOfSixtyNights, ProvesSmallerBoundsNightByNight) {
  const std::vector<double>& bound = sequence("right").bound;
  ASSERT_EQ(bound.size(), kNights + 1);
  EXPECT_TRUE(sequence("right").evidence.empty());
  EXPECT_LT(bound[29], bound[4] / 1.5);  // like 1/sqrt(nights), by which it would be 2.4
  EXPECT_LT(bound[kNights - 1], bound[9] / 1.5);
  EXPECT_TRUE(std::isnan(bound[kNights])) << "the same seed again adds nothing";
  EXPECT_EQ(sequence("right").tolerance, 0.01);
}

TEST_F(ReportOfSixtyNights, AddsUpTheEvidenceOfTests) {
  EXPECT_EQ(sequence("chi/wrong").verdict, Verdict::fail);
  EXPECT_NE(sequence("chi/right").verdict, Verdict::fail);
  EXPECT_TRUE(sequence("chi/right").bound.empty());
  EXPECT_GT(sequence("chi/wrong").evidence[kNights - 1], 27);  // −ln 1e-12
}

TEST_F(ReportOfSixtyNights, FollowsWhatIsExpectedToPassAlone) {
  EXPECT_EQ(record_.sequences.size(), 4u);
  EXPECT_EQ(of_tests_.nights.size(), kNights);
  EXPECT_TRUE(of_tests_.sequences.empty()) << "their seed is the same each time";
}

TEST_F(ReportOfSixtyNights, FindsTheStepAndNoOther) {
  const reports::TrackedNumber& slower = number("slower");
  ASSERT_EQ(slower.changes.size(), 1u);
  EXPECT_TRUE(slower.changes[0].regression);
  EXPECT_LE(slower.changes[0].first_night, kStep + 1);
  EXPECT_GE(slower.changes[0].last_night + 1, kStep);
  EXPECT_NEAR(slower.changes[0].relative, 0.1, 0.03);  // ten errors of the difference of two levels
  EXPECT_EQ(slower.median.size(), kNights + 1);
  EXPECT_LE(slower.low[3], slower.median[3]);
  EXPECT_GE(slower.high[3], slower.median[3]);
  EXPECT_TRUE(std::isnan(slower.median[kNights]));
  EXPECT_TRUE(number("steady").changes.empty());
}

TEST_F(ReportOfSixtyNights, FindsTheCounterThatChangedInTheLastNight) {
  const reports::TrackedNumber& rays = number("rays");
  EXPECT_TRUE(rays.counter);
  ASSERT_EQ(rays.changes.size(), 1u);
  EXPECT_EQ(rays.changes[0].first_night, kNights - 1);
  EXPECT_EQ(rays.changes[0].commit_first, "commit 59");
}

TEST_F(ReportOfSixtyNights, CountsRunsOfTheGateAndSurvivesTheRoundTrip) {
  EXPECT_EQ(record_.nights[20].gate_runs, 2u);
  EXPECT_EQ(record_.nights[20].failing_gate_runs, 1u);
  ASSERT_EQ(record_.failing_gate_runs.size(), 1u);
  EXPECT_EQ(record_.failing_gate_runs[0].seed, 5u);
  EXPECT_EQ(to_json(reports::parse_history(to_json(record_))), to_json(record_));
}

TEST(HistorySequences, BeginAgainWhereTheCodeOrTheAnswerIsAnother) {
  const ScratchDirectory scratch;
  History history(scratch / "history.db", History::Access::append);
  const auto nights_after = [&](std::size_t i, const char* sources, double reference) {
    HistoryRun run = night(i);
    run.sources = sources;
    verify::CheckResult check = mean_check("a", reference);
    check.reference = reference;
    history.append(run, {{check}, {}, {}});
    return reports::judge_runs(history, here(), "nightly").sequences.at(0).nights;
  };
  EXPECT_EQ(nights_after(0, "one", 1), 1u);
  EXPECT_EQ(nights_after(1, "one", 1), 2u);
  EXPECT_EQ(nights_after(2, "two", 1), 1u);
  EXPECT_EQ(nights_after(3, "two", 1), 2u);
  EXPECT_EQ(nights_after(4, "two", 2), 1u);
}

TEST(HistorySequences, TakeFromARecordWhatItsSamplesWere) {
  const double kBatches = 64;
  const auto batches = reports::detail::batches_of(mean_check("a", 1.5), kSamples / 64);
  EXPECT_EQ(batches.batches, 64u);
  EXPECT_EQ(batches.mean, 1.5);
  EXPECT_NEAR(std::sqrt(batches.m2 / (kBatches - 1) / kBatches), kError, 1e-15);
  const double m2 = batches.m2 * kBatches / (kBatches - 1);
  EXPECT_NEAR(batches.m3 / std::pow(m2, 1.5), 0.01, 1e-12);  // the skewness of the estimate
  const double off = batches.largest - batches.mean;
  EXPECT_NEAR(off * off / m2, 0.001, 1e-12);  // the largest share
  EXPECT_EQ(reports::detail::batches_of(mean_check("a", 1.5), kSamples * 2).batches, 0u);
  verify::CheckResult bare = mean_check("a", 1.5);
  bare.figures.clear();
  EXPECT_EQ(reports::detail::batches_of(bare, 1).batches, 0u);
}

}  // namespace
}  // namespace plumbline::tests
