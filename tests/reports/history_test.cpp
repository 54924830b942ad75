#include <gtest/gtest.h>
#include <plumbline_tests/support.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <limits>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include <plumbline/reports/history.h>

#include "history_schema.h"
#include "samples.h"

namespace plumbline::tests {
namespace {

using reports::History;
using reports::HistoryData;
using reports::HistoryError;
using reports::HistoryRun;
using reports::PartStatus;

HistoryRun sample_run(std::uint64_t seed) {
  HistoryRun run;
  run.kind = "nightly";
  run.seed = seed;
  run.sources = "0123abcd";
  run.environment = sample_environment();
  run.parts = {{"suites", PartStatus::passed, 12.5, ""},
               {"mutants", PartStatus::skipped, 0, "takes 40 minutes, 3 are left"}};
  run.seed_runs = {{17, "abc-dirty", "2024-03-01T12:00:00Z", 2500, {"A.B", "C.D"}}};
  return run;
}

verify::CheckResult expected_mean() {
  verify::CheckResult check = sample_check();
  check.kind = verify::CheckKind::mean;
  check.verdict = check.expected = verify::Verdict::pass;
  check.figures = {{verify::Figure::standard_error, 0.125}, {verify::Figure::skewness, -0.5}};
  return check;
}

HistoryData sample_data(std::size_t values = 3) {
  HistoryData data;
  data.checks = {sample_check(), expected_mean()};
  data.distributions = {{"cost", "ns", true, std::vector<double>(values, 1.25)},
                        {"speed", "1/s", false, {0.1, std::numeric_limits<double>::infinity()}}};
  data.counters = {{"rays", "rays", 123'456'789'012'345}};
  return data;
}

/// The message of what a function throws; empty if it throws nothing of the kind.
template <class Function>
std::string refusal(const Function& function) {
  try {
    function();
    return {};
  } catch (const HistoryError& error) {
    return error.what();
  }
}

std::string refusal_to_open(const std::filesystem::path& file,
                            History::Access access = History::Access::append) {
  return refusal([&] { History(file, access); });
}

std::string pragma(const std::filesystem::path& file, const char* query) {
  const SQLite::Database database(file.string());
  SQLite::Statement statement(database, query);
  return statement.executeStep() ? statement.getColumn(0).getString() : "nothing";
}

/// Runs a function in a process of its own, which ends after it.
template <class Function>
pid_t in_a_process(const Function& function) {
  const pid_t child = fork();
  if (child != 0) return child;
  int status = 0;
  try {
    function();
  } catch (...) {
    status = 1;
  }
  _exit(status);
}

bool ended_well(pid_t child) {
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(History, KeepsARunAsItWas) {
  const ScratchDirectory scratch;
  const auto file = scratch / "deep/history.db";
  HistoryRun run = sample_run(18'446'744'073'709'551'613u);
  run.id = History(file, History::Access::append).append(run, sample_data());
  const History history(file, History::Access::read);
  ASSERT_EQ(history.runs().size(), 1u);
  EXPECT_EQ(history.runs()[0], run);
  EXPECT_EQ(history.run(run.id), run);
  EXPECT_EQ(history.distributions(run.id), sample_data().distributions);
  EXPECT_EQ(history.counters(run.id), sample_data().counters);
  EXPECT_EQ(history.count_checks(run.id).checks, 2u);
  EXPECT_EQ(history.count_checks(run.id).unexpected, sample_check().as_expected() ? 0u : 1u);
}

TEST(History, KeepsOfAnExpectedCheckWhatStatisticsNeedAndOfAnotherAll) {
  const ScratchDirectory scratch;
  History history(scratch / "history.db", History::Access::append);
  verify::CheckResult bad = sample_check();
  bad.verdict = verify::Verdict::fail;
  bad.expected = verify::Verdict::pass;
  HistoryData data;
  data.checks = {bad, expected_mean()};
  const std::int64_t id = history.append(sample_run(1), data);
  ASSERT_EQ(history.unexpected_checks(id).size(), 1u);
  EXPECT_EQ(reports::to_json(history.unexpected_checks(id)[0]), reports::to_json(bad));
  const verify::CheckResult kept = history.checks(id).at(1);
  EXPECT_EQ(kept.kind, verify::CheckKind::mean);
  EXPECT_EQ(kept.subject, bad.subject);
  EXPECT_EQ(kept.estimate, bad.estimate);
  EXPECT_EQ(kept.reference, bad.reference);
  EXPECT_EQ(kept.tolerance, bad.tolerance);
  EXPECT_EQ(kept.bound, bad.bound);
  EXPECT_EQ(kept.p_value, bad.p_value);
  EXPECT_EQ(kept.samples, bad.samples);
  EXPECT_EQ(kept.seconds, bad.seconds);
  EXPECT_EQ(kept.figures, expected_mean().figures);
}

TEST(History, ComparesOnlyWhatIsOfOneMachineCompilerAndFlags) {
  const ScratchDirectory scratch;
  History history(scratch / "history.db", History::Access::append);
  HistoryRun run = sample_run(1);
  const std::string key = reports::comparable_key(run.environment);
  history.append(run, sample_data());
  run.environment.commit = "another";
  run.environment.time = "2025-01-01T00:00:00Z";
  history.append(run, sample_data());
  const auto other = [&](auto member, const auto& value) {
    HistoryRun changed = run;
    changed.environment.*member = value;
    history.append(changed, sample_data());
    EXPECT_NE(reports::comparable_key(changed.environment), key);
  };
  other(&reports::RunEnvironment::cpu, "another");
  other(&reports::RunEnvironment::cores, 77);
  other(&reports::RunEnvironment::compiler, "another");
  other(&reports::RunEnvironment::flags, "another");
  run.kind = "test";
  history.append(run, sample_data());

  EXPECT_EQ(history.runs().size(), 7u);
  EXPECT_EQ(history.runs({.kind = {}, .comparable = key}).size(), 3u);
  const reports::RunFilter filter{.kind = "nightly", .comparable = key};
  EXPECT_EQ(history.runs(filter).size(), 2u);
  const auto series = history.distribution_series(filter);
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[0].name, "cost");
  EXPECT_TRUE(series[0].lower_is_better);
  EXPECT_FALSE(series[1].lower_is_better);
  ASSERT_EQ(series[0].runs.size(), 2u);
  EXPECT_EQ(series[0].runs[1].id, 2);
  EXPECT_EQ(series[1].runs[1].values, sample_data().distributions[1].values);
  const auto counters = history.counter_series(filter);
  ASSERT_EQ(counters.size(), 1u);
  EXPECT_EQ(counters[0].runs.size(), 2u);
  EXPECT_EQ(counters[0].runs[0].value, sample_data().counters[0].value);
}

TEST(History, LosesNothingWhereTwoProcessesAppendAtOnce) {
  constexpr int kRuns = 50;
  const ScratchDirectory scratch;
  const auto file = scratch / "history.db";  // which both make
  const auto writer = [&](std::uint64_t first) {
    return in_a_process([&file, first] {
      History history(file, History::Access::append);
      for (std::uint64_t i = 0; i < kRuns; ++i) {
        history.append(sample_run(first + i), sample_data());
      }
    });
  };
  const pid_t a = writer(0), b = writer(1000);
  EXPECT_TRUE(ended_well(a));
  EXPECT_TRUE(ended_well(b));
  const History history(file, History::Access::read);
  std::set<std::uint64_t> seeds;
  for (const HistoryRun& run : history.runs()) {
    seeds.insert(run.seed);
    EXPECT_EQ(history.distributions(run.id), sample_data().distributions);
    EXPECT_EQ(history.count_checks(run.id).checks, 2u);
  }
  EXPECT_EQ(seeds.size(), 2u * kRuns);
}

// A process that appends without end, and says so after each run, is killed in the middle of one.
TEST(History, StaysWholeWhereAWriterIsKilled) {
  const ScratchDirectory scratch;
  const auto file = scratch / "history.db";
  std::size_t said = 0;
  for (int round = 0; round < 8; ++round) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    const pid_t writer = in_a_process([&] {
      History history(file, History::Access::append);
      for (std::uint64_t i = 0; write(ends[1], "", 1) == 1; ++i) {
        history.append(sample_run(i), sample_data(5000));
      }
    });
    std::array<char, 2> bytes{};
    ASSERT_EQ(read(ends[0], bytes.data(), 1) + read(ends[0], bytes.data() + 1, 1), 2);
    ++said;  // the first byte comes before a run, the second after it
    std::this_thread::sleep_for(std::chrono::milliseconds(3 * round));
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    for (const int end : ends) close(end);

    const History history(file, History::Access::append);
    EXPECT_EQ(pragma(file, "PRAGMA integrity_check"), "ok");
    const std::vector<HistoryRun> runs = history.runs();
    ASSERT_GE(runs.size(), said);
    said = runs.size();
    for (const HistoryRun& run : runs) {
      EXPECT_EQ(run.parts, sample_run(0).parts);
      EXPECT_EQ(history.count_checks(run.id).checks, 2u);
    }
    EXPECT_EQ(history.distributions(runs.back().id), sample_data(5000).distributions);
    EXPECT_EQ(history.counters(runs.back().id), sample_data().counters);
  }
}

TEST(History, IsInTheWriteAheadLogAndStatesItsVersion) {
  const ScratchDirectory scratch;
  const auto file = scratch / "history.db";
  { const History history(file, History::Access::append); }
  EXPECT_EQ(pragma(file, "PRAGMA journal_mode"), "wal");
  EXPECT_EQ(pragma(file, "PRAGMA user_version"), std::to_string(History::kVersion));
  EXPECT_EQ(History::kVersion, static_cast<int>(reports::detail::migrations().size()));
}

TEST(History, OfVersionZeroIsBroughtUpToDate) {
  const ScratchDirectory scratch;
  const auto file = scratch.write("history.db", "");
  History history(file, History::Access::append);
  EXPECT_EQ(history.append(sample_run(1), sample_data()), 1);
  EXPECT_EQ(pragma(file, "PRAGMA user_version"), std::to_string(History::kVersion));
}

// As a later version will: its steps go on from what a file of version 1 holds.
TEST(History, OfAnEarlierVersionKeepsItsRunsWhenALaterOneOpensIt) {
  const ScratchDirectory scratch;
  const auto file = scratch / "history.db";
  { History(file, History::Access::append).append(sample_run(7), sample_data()); }
  std::vector<const char*> steps(reports::detail::migrations().begin(),
                                 reports::detail::migrations().end());
  steps.push_back("ALTER TABLE run ADD COLUMN place TEXT NOT NULL DEFAULT 'here'");
  { const auto database = reports::detail::open_database(file, false, steps); }
  EXPECT_EQ(pragma(file, "PRAGMA user_version"), std::to_string(History::kVersion + 1));
  EXPECT_EQ(pragma(file, "SELECT place FROM run WHERE seed = '7'"), "here");
  EXPECT_NE(refusal_to_open(file).find("use a later Plumbline"), std::string::npos)
      << refusal_to_open(file);
}

// A step that fails in its middle leaves the file at the version it had.
TEST(History, StaysAtItsVersionWhereAStepFails) {
  const ScratchDirectory scratch;
  const auto file = scratch / "history.db";
  { History(file, History::Access::append).append(sample_run(7), sample_data()); }
  std::vector<const char*> steps(reports::detail::migrations().begin(),
                                 reports::detail::migrations().end());
  steps.push_back("ALTER TABLE run ADD COLUMN place TEXT; SELECT nonsense FROM nowhere");
  EXPECT_NE(refusal([&] { reports::detail::open_database(file, false, steps); }), "");
  EXPECT_EQ(History(file, History::Access::read).runs().size(), 1u);
}

TEST(History, RefusesWhatIsNoHistoryAndLeavesItAlone) {
  const ScratchDirectory scratch;
  const std::string text = "this is a text and no database, whatever its name may say of it\n";
  const auto not_a_database = scratch.write("text.db", text);
  const std::string refused = refusal_to_open(not_a_database);
  EXPECT_NE(refused.find("text.db: file is not a database; move it away"), std::string::npos)
      << refused;
  EXPECT_EQ(scratch.read("text.db"), text);

  const auto of_another = scratch / "other.db";
  {
    SQLite::Database database(of_another.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    database.exec("CREATE TABLE run (id INTEGER)");
  }
  const std::string before = scratch.read("other.db");
  EXPECT_NE(refusal_to_open(of_another).find("of another program"), std::string::npos);
  EXPECT_EQ(scratch.read("other.db"), before);

  EXPECT_NE(refusal_to_open(scratch / "none.db", History::Access::read).find("no such history"),
            std::string::npos);
  EXPECT_NE(refusal_to_open(scratch.path()), "");  // a directory
}

TEST(History, SaysThatAFileIsDamaged) {
  const ScratchDirectory scratch;
  const auto file = scratch / "history.db";
  {
    History history(file, History::Access::append);
    for (int i = 0; i < 20; ++i) history.append(sample_run(1), sample_data(500));
  }
  std::string bytes = scratch.read("history.db");
  for (std::size_t i = 4096; i < bytes.size(); ++i) bytes[i] = '?';
  scratch.write("history.db", bytes);
  const std::string refused =
      refusal([&] { History(file, History::Access::read).distribution_series({}); });
  EXPECT_NE(refused.find("malformed; move it away"), std::string::npos) << refused;
}

/// All that is read of a history by some command.
void read_all(const std::filesystem::path& file) {
  const History history(file, History::Access::read);
  for (const reports::HistoryRun& run : history.runs()) {
    history.checks(run.id);
    history.distributions(run.id);
    history.counters(run.id);
  }
  history.distribution_series({});
  history.counter_series({});
}

TEST(History, SaysWhatInItIsNotItsOwn) {
  const std::pair<const char*, const char*> changes[] = {
      {"PRAGMA user_version = -16777216", "states version -16777216; move it away"},
      {"UPDATE run SET seed = '1x'", "holds what no history does: the seed \"1x\"; move it away"},
      {"UPDATE run SET seed = '99999999999999999999'", "the seed \"99999999999999999999\""},
      {"UPDATE run SET environment = '{'", "not JSON"},
      {"UPDATE seed_run SET record = '{}'", "format"},
      {"UPDATE check_result SET record = NULL, verdict = 'maybe'", "the verdict \"maybe\""},
      {"UPDATE distribution SET measured = '[1, x]'", "not JSON"}};
  for (const auto& [change, why] : changes) {
    const ScratchDirectory scratch;
    const auto file = scratch / "history.db";
    History(file, History::Access::append).append(sample_run(1), sample_data(1));
    read_all(file);
    SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec(change);
    const std::string refused = refusal([&] { read_all(file); });
    EXPECT_NE(refused.find("history.db: "), std::string::npos) << change << refused;
    EXPECT_NE(refused.find(why), std::string::npos) << change << refused;
  }
}

/// The id that an empty list would be taken to end with.
TEST(History, ReadsAQuantityWhateverItsNumberIs) {
  const ScratchDirectory scratch;
  const auto file = scratch / "history.db";
  History(file, History::Access::append).append(sample_run(1), sample_data(1));
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE)
      .exec(
          "PRAGMA foreign_keys = OFF; UPDATE counter SET quantity = -1; DELETE FROM quantity WHERE "
          "id = (SELECT max(id) FROM quantity); INSERT INTO quantity (id, name, unit, better) "
          "VALUES (-1, 'a', 'b', 'lower')");
  const auto series = History(file, History::Access::read).counter_series({});
  ASSERT_EQ(series.size(), 1u);
  EXPECT_EQ(series[0].name, "a");
}

TEST(History, HasNoRunThatWasNotAppended) {
  const ScratchDirectory scratch;
  const History history(scratch / "history.db", History::Access::append);
  EXPECT_NE(refusal([&] { history.run(3); }).find("there is no run 3"), std::string::npos);
  EXPECT_TRUE(history.checks(3).empty());
}

}  // namespace
}  // namespace plumbline::tests
