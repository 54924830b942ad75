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
constexpr double kLogError = 0.1;  // standard error of a night's logarithm of a ratio
constexpr std::uint64_t kTrials = 200;

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

verify::CheckResult agreement_check(const std::string& subject, double difference) {
  verify::CheckResult check = mean_check(subject, difference);
  check.kind = verify::CheckKind::agreement;
  check.reference = 0;
  check.figures.emplace_back(verify::Figure::mean_of_a, 1 + difference);
  check.figures.emplace_back(verify::Figure::mean_of_b, 1);
  return check;
}

/// A ratio of which at least 2 and at most 3 is claimed.
verify::CheckResult ratio_check(const std::string& subject, double log_ratio) {
  verify::CheckResult check;
  check.kind = verify::CheckKind::variance_ratio;
  check.subject = subject;
  check.verdict = Verdict::pass;
  check.estimate = std::exp(log_ratio);
  check.figures = {{verify::Figure::largest_batch_of_a, 0.1},
                   {verify::Figure::largest_batch_of_b, 0.1},
                   {"batches", 32},
                   {verify::Figure::at_least, 2},
                   {verify::Figure::at_most, 3},
                   {"error of the logarithm", kLogError}};
  return check;
}

/// A share of which at least 0.9 is claimed.
verify::CheckResult proportion_check(const std::string& subject, std::uint64_t hits) {
  verify::CheckResult check;
  check.kind = verify::CheckKind::proportion;
  check.subject = subject;
  check.verdict = Verdict::pass;
  check.samples = kTrials;
  check.figures = {{verify::Figure::hits, static_cast<double>(hits)},
                   {verify::Figure::at_least, 0.9},
                   {verify::Figure::at_most, 1}};
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

/// Sixty nights of checks of the other kinds, of which one is right and one wrong by less than a
/// night shows.
class OtherKinds : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const ScratchDirectory scratch;
    History history(scratch / "history.db", History::Access::append);
    std::mt19937_64 random(check_seed("history/other kinds"));
    std::normal_distribution<double> normal;
    std::binomial_distribution<std::uint64_t> right(kTrials, 0.95), wrong(kTrials, 0.85);
    for (std::size_t i = 0; i < kNights; ++i) {
      reports::HistoryData data;
      data.checks = {agreement_check("agreement/right", kError * normal(random)),
                     agreement_check("agreement/wrong", kError * (2.5 + normal(random))),
                     ratio_check("ratio/right", std::log(2.45) + kLogError * normal(random)),
                     ratio_check("ratio/wrong", std::log(1.5) + kLogError * normal(random)),
                     proportion_check("proportion/right", right(random)),
                     proportion_check("proportion/wrong", wrong(random))};
      // What says nothing of nights together: the worst of several, and one batch that decides.
      data.checks.push_back(agreement_check("agreement/worst", 2.5 * kError));
      data.checks.back().figures.emplace_back("quantities", 12);
      data.checks.push_back(ratio_check("ratio/tail", 0));
      data.checks.back().figures[0] = {verify::Figure::largest_batch_of_a, 0.3};
      // A tolerance that is a share of the night's own means is the same question.
      *data.checks[0].tolerance *= 1 + 1e-3 * normal(random);
      history.append(night(i), data);
    }
    record_ = reports::judge_runs(history, here(), "nightly");
  }

  static const TrackedSequence& sequence(const std::string& subject) {
    for (const TrackedSequence& s : record_.sequences) {
      if (s.subject == subject) return s;
    }
    throw std::runtime_error("no sequence of " + subject);
  }

  inline static HistoryRecord record_;
};

TEST_F(OtherKinds, WhatIsWrongByLessThanANightShowsIsFound) {
  EXPECT_EQ(record_.sequences.size(), 6u);
  for (const char* kind : {"agreement", "ratio", "proportion"}) {
    const TrackedSequence& wrong = sequence(std::string(kind) + "/wrong");
    EXPECT_EQ(wrong.verdict, Verdict::fail) << kind;
    EXPECT_EQ(wrong.nights, kNights);
    EXPECT_FALSE(wrong.reason.empty());
    EXPECT_NE(sequence(std::string(kind) + "/right").verdict, Verdict::fail) << kind;
  }
}

TEST_F(OtherKinds, OneNightOfWhatIsWrongIsNoFailure) {
  const ScratchDirectory scratch;
  History history(scratch / "history.db", History::Access::append);
  history.append(night(0), {{agreement_check("agreement/wrong", 2.5 * kError),
                             ratio_check("ratio/wrong", std::log(1.5)),
                             proportion_check("proportion/wrong", 17 * kTrials / 20)},
                            {},
                            {}});
  const HistoryRecord record = reports::judge_runs(history, here(), "nightly");
  EXPECT_EQ(record.sequences.size(), 3u);
  for (const TrackedSequence& s : record.sequences) {
    EXPECT_NE(s.verdict, Verdict::fail) << s.subject;
  }
}

TEST_F(OtherKinds, BoundsShrinkAndEndWithinTheClaim) {
  for (const char* subject : {"agreement/right", "ratio/right", "proportion/right"}) {
    const TrackedSequence& right = sequence(subject);
    EXPECT_EQ(right.verdict, Verdict::pass) << subject;
    EXPECT_LT(right.bound[kNights - 1], right.bound[2]) << subject;
    EXPECT_LE(right.bound[kNights - 1], *right.tolerance) << subject;
  }
  // From the middle of ln 2 and ln 3, and of 0.9 and 1.
  EXPECT_NEAR(*sequence("ratio/right").tolerance, std::log(1.5) / 2, 1e-12);
  EXPECT_NEAR(*sequence("proportion/right").tolerance, 0.05, 1e-12);
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
