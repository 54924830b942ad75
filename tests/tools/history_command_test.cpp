#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <filesystem>
#include <string>
#include <vector>

#include <plumbline/reports/history.h>

#include "command_line.h"

/// What `plumbline history` keeps, and what it says of it.
namespace plumbline::tests {
namespace {

verify::CheckResult check(const std::string& subject, verify::Verdict verdict) {
  verify::CheckResult result;
  result.kind = verify::CheckKind::mean;
  result.subject = subject;
  result.verdict = verdict;
  result.estimate = 0.25;
  result.samples = 1000;
  result.reason = "bias of 3 <b>|x|</b>";
  result.replay = "ctest -R '^A$'";
  return result;
}

/// A results directory with a bit of everything that a history keeps.
void write_results(const ScratchDirectory& scratch) {
  reports::ResultLog log(scratch / "results", "night");
  log.append(check("furnace/mis", verify::Verdict::pass));
  log.append(check("furnace/bsdf", verify::Verdict::fail));
  log.append(reports::Distribution{"cost, of a \"call\"", "ns", true, {3, 1, 2}});
  log.append(reports::Counter{"rays", "rays", 12345});
  scratch.write("results/seeds.jsonl",
                to_json(reports::SeedRun{17, "abc", "2024-03-01T12:00:00Z", 2500, {"A.B"}}) + "\n" +
                    to_json(reports::SeedRun{18, "abc", "2024-03-01T13:00:00Z", 2500, {}}) + "\n");
}

constexpr const char* kAppend =
    "history append results --history h.db --seed 9 --sources 0af --part suites=passed,61.5 "
    "--part 'mutants=timed out,7200,cut | short' --part 'fuzzing=skipped,0,no time left'";

void expect_in_order(const std::string& text, const std::vector<std::string>& parts) {
  std::size_t at = 0;
  for (const std::string& part : parts) {
    const std::size_t found = text.find(part, at);
    ASSERT_NE(found, std::string::npos) << part << "\nin\n" << text;
    at = found + part.size();
  }
}

TEST(HistoryCommand, ListsAndShowsWhatWasAppended) {
  const ScratchDirectory scratch;
  write_results(scratch);
  const Outcome appended = run_plumbline(scratch.path(), kAppend);
  EXPECT_EQ(appended.exit_code, 0) << appended.err;
  EXPECT_EQ(appended.out, "h.db: run 1\n");
  EXPECT_EQ(run_plumbline(scratch.path(), "history append results --history h.db --kind test").out,
            "h.db: run 2\n");
  expect_in_order(run_plumbline(scratch.path(), "history list --history h.db").out,
                  {"run", "nightly", " 2 ", " 1 ", " 2 ", "1 passed, 1 timed out, 1 skipped\n",
                   "test", "no parts\n"});
  expect_in_order(run_plumbline(scratch.path(), "history show 1 --history h.db").out,
                  {"run 1, nightly", "sources 0af, seed 9;", "suites", "passed", "1 min", "mutants",
                   "timed out", "2 h 00 min", "cut | short", "2 checks, 1 not as expected",
                   "furnace/bsdf: fail, expected pass", "gate with seed 17: 2500 tests, 1 failed",
                   "cost, of a \"call\"", "median 2 of 3, 1 to 3 ns", "rays", "12345 rays"});
  expect_in_order(run_plumbline(scratch.path(), "history show --history h.db").out,
                  {"run 2, test"});
}

TEST(HistoryCommand, SummaryIsMarkdownThatATextCannotLeave) {
  const ScratchDirectory scratch;
  write_results(scratch);
  ASSERT_EQ(run_plumbline(scratch.path(), kAppend).exit_code, 0);
  ASSERT_EQ(run_plumbline(scratch.path(), kAppend).exit_code, 0);
  expect_in_order(run_plumbline(scratch.path(), "history summary --history h.db").out,
                  {"# Plumbline, ", "1 passed, 1 timed out, 1 skipped\n",
                   "| part | status | took | |\n|---|", "| suites | passed | 1 min |  |\n",
                   "| mutants | **timed out** | 2 h 00 min | cut \\| short |",
                   "| fuzzing | skipped |", "1 of 2 checks did not give",
                   "**furnace/bsdf**: fail, expected pass. bias of 3 \\<b>\\|x\\|\\</b>",
                   "```sh\nctest -R '^A$'\n```",
                   "1 of 2 runs failed this time; 2 of 4 in this history.", "- seed 17: A.B"});
}

TEST(HistoryCommand, ExportsTablesOfAllRunsAsCsv) {
  const ScratchDirectory scratch;
  write_results(scratch);
  ASSERT_EQ(run_plumbline(scratch.path(), kAppend).exit_code, 0);
  const auto csv = [&](const std::string& table) {
    return run_plumbline(scratch.path(), "history export --csv --history h.db --table " + table)
        .out;
  };
  expect_in_order(csv("distributions"),
                  {"run,time,kind,commit,sources,machine,name,unit,better,value\r\n1,", ",nightly,",
                   ",0af,", ",\"cost, of a \"\"call\"\"\",ns,lower,3\r\n", ",1\r\n", ",2\r\n"});
  expect_in_order(csv("counters"), {"rays,rays,12345\r\n"});
  expect_in_order(csv("checks"), {"mean,furnace/mis,pass,pass,0.25,,,,,1000,0\r\n"});
  expect_in_order(csv("parts"), {"suites,passed,61.5,\r\n"});
  expect_in_order(csv("gate-runs"), {"17,2500,1,A.B\r\n", "18,2500,0,\r\n"});
}

TEST(HistoryCommand, ReportsOverTheRunsInMarkdownAndAsARecord) {
  const ScratchDirectory scratch;
  write_results(scratch);
  for (int i = 0; i < 2; ++i) ASSERT_EQ(run_plumbline(scratch.path(), kAppend).exit_code, 0);
  const Outcome outcome =
      run_plumbline(scratch.path(), "history report --history h.db --json results/history.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_in_order(
      outcome.out,
      {"## Over all nightly runs, 2 by now\n", "2 numbers are followed; none has changed.",
       "2 of 4 runs of the gate with fresh seeds failed.\n", "- seed 17, abc: A.B\n"});
  const reports::Results results = reports::read_results(scratch / "results");
  ASSERT_EQ(results.histories.size(), 1u);
  EXPECT_EQ(results.histories[0].nights.size(), 2u);
  EXPECT_EQ(results.histories[0].numbers.size(), 2u);
}

// With the gate's seed the samples that checks take to decide are the same at every run.
TEST(HistoryCommand, CountsTheSamplesOfAWholeGate) {
  const ScratchDirectory scratch;
  write_results(scratch);
  const auto counters_with = [&](const char* options) {
    EXPECT_EQ(run_plumbline(scratch.path(),
                            std::string("history append results --history h.db ") + options)
                  .exit_code,
              0);
    const reports::History history(scratch / "h.db", reports::History::Access::read);
    return history.counters(history.runs().back().id);
  };
  const auto whole = counters_with("--kind test --whole");
  ASSERT_EQ(whole.size(), 2u);
  EXPECT_EQ(whole[1], (reports::Counter{"gate/mean/samples", "samples", 2000}));
  EXPECT_EQ(counters_with("--kind test").size(), 1u);
  EXPECT_EQ(counters_with("--kind test --whole --seed 3").size(), 1u);
}

TEST(HistoryCommand, KeepsANightThatMeasuredNothing) {
  const ScratchDirectory scratch;
  std::filesystem::create_directories(scratch / "results/checks");
  EXPECT_EQ(run_plumbline(scratch.path(), kAppend).exit_code, 0);
  EXPECT_EQ(reports::History(scratch / "h.db", reports::History::Access::read).runs().size(), 1u);
}

TEST(HistoryCommand, RefusesResultsOfAnotherBuild) {
  const ScratchDirectory scratch;
  write_results(scratch);
  reports::RunEnvironment other = reports::current_environment();
  other.compiler = "another 1.0";
  reports::ResultLog(scratch / "results", "old").append(other);
  const Outcome outcome = run_plumbline(scratch.path(), kAppend);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("records of another build"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("another 1.0"), std::string::npos) << outcome.err;
}

TEST(HistoryCommand, SaysWhatIsWrong) {
  const ScratchDirectory scratch;
  write_results(scratch);
  scratch.write("text.db", "this is a text and no database, whatever its name may say of it\n");
  ASSERT_EQ(run_plumbline(scratch.path(), kAppend).exit_code, 0);
  struct Case {
    const char *arguments, *message;
  };
  for (const Case& c : std::vector<Case>{
           {"list", "--history is required"},
           {"list --history none.db", "none.db: there is no such history"},
           {"list --history text.db", "text.db: file is not a database; move it away"},
           {"show 7 --history h.db", "h.db: there is no run 7"},
           {"show first --history h.db", "first: not the number of a run"},
           {"export --history h.db", "--csv"},
           {"export --csv --table planets --history h.db", "planets"},
           {"append --history h.db", "which directory of results?"},
           {"append none --history h.db", "none: no such directory"},
           {"append results --history h.db --part mutants", "--part mutants: not NAME=STATUS"},
           {"append results --history h.db --part mutants=good,1", "not NAME=STATUS"},
           {"append results --history h.db --part mutants=passed,long", "not NAME=STATUS"},
           {"report --history h.db --kind test", "holds no run of the kind \"test\""},
           {"report --history h.db --machine mine", "--machine mine: none of the runs"},
           {"frob --history h.db", "frob"}}) {
    const Outcome outcome = run_plumbline(scratch.path(), std::string("history ") + c.arguments);
    EXPECT_EQ(outcome.exit_code, 2) << c.arguments;
    EXPECT_NE(outcome.err.find(c.message), std::string::npos) << c.arguments << "\n" << outcome.err;
  }
  EXPECT_EQ(reports::History(scratch / "h.db", reports::History::Access::read).runs().size(), 1u);
}

}  // namespace
}  // namespace plumbline::tests
