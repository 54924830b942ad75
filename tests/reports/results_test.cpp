#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <set>
#include <string>
#include <thread>
#include <vector>

#include "samples.h"

namespace plumbline::tests {
namespace {

namespace fs = std::filesystem;
using reports::ResultLog;
using reports::Results;

verify::CheckResult check_named(const std::string& subject) {
  verify::CheckResult check = sample_check();
  check.subject = subject;
  return check;
}

std::string error_of_reading(const fs::path& directory) {
  try {
    reports::read_results(directory);
    return {};
  } catch (const reports::ResultsError& error) {
    return error.what();
  }
}

TEST(ResultLog, RecordsOfEveryKindAreFoundAgainInSubdirectoriesToo) {
  const ScratchDirectory scratch;
  ResultLog(scratch / "checks", "checks").append(sample_check());
  {
    ResultLog bench(scratch / "bench", "bench");
    bench.append(sample_speed_point());
    bench.append(sample_ray_cost());
    bench.append(sample_bar());
    bench.append(sample_stability_record());
    bench.append(sample_causes_record());
    bench.append(sample_duet_record());
    bench.append(sample_figure());
    bench.append(sample_table());
    bench.append(sample_distribution());
    bench.append(sample_counter());
  }
  scratch.write("seeds.jsonl", to_json(sample_seed_run()) + "\n");
  scratch.write("history.json", to_json(sample_history()));
  fs::create_directories(scratch / "images");
  reports::RenderRecord render = sample_render();
  render.image = scratch / "images" / "a.exr";
  reports::write_render_record(scratch / "images" / "a.json", render);

  const Results results = reports::read_results(scratch.path());
  EXPECT_EQ(results.checks.size(), 1u);
  EXPECT_EQ(results.speed.size(), 1u);
  EXPECT_EQ(results.ray_costs.size(), 1u);
  EXPECT_EQ(results.bars.size(), 1u);
  EXPECT_EQ(results.stability.size(), 1u);
  EXPECT_EQ(results.causes.size(), 1u);
  EXPECT_EQ(results.duets.size(), 1u);
  EXPECT_EQ(results.figures.size(), 1u);
  EXPECT_EQ(results.tables.size(), 1u);
  EXPECT_EQ(results.distributions.size(), 1u);
  EXPECT_EQ(results.counters.size(), 1u);
  EXPECT_EQ(results.seed_runs.size(), 1u);
  EXPECT_EQ(results.histories.size(), 1u);
  ASSERT_EQ(results.renders.size(), 1u);
  EXPECT_EQ(fs::weakly_canonical(results.renders[0].image), fs::weakly_canonical(render.image));
  EXPECT_EQ(results.environments.size(), 1u) << "both logs were made by this build";
  EXPECT_TRUE(results.warnings.empty());
}

TEST(ResultLog, AppendsToWhatIsThere) {
  const ScratchDirectory scratch;
  ResultLog(scratch.path(), "checks").append(check_named("a"));
  ResultLog(scratch.path(), "checks").append(check_named("b"));
  const Results results = reports::read_results(scratch.path());
  ASSERT_EQ(results.checks.size(), 2u);
  EXPECT_EQ(results.checks[0].subject, "a");
  EXPECT_EQ(results.checks[1].subject, "b");
  EXPECT_EQ(results.environments.size(), 1u);
}

TEST(ResultLog, ConcurrentWritersDoNotTearEachOthersLines) {
  const ScratchDirectory scratch;
  constexpr int kWriters = 8, kLines = 50;
  std::vector<std::thread> writers;
  for (int writer = 0; writer < kWriters; ++writer) {
    writers.emplace_back([&scratch, writer] {
      for (int line = 0; line < kLines; ++line) {
        verify::CheckResult check =
            check_named(std::to_string(writer) + "/" + std::to_string(line));
        check.reason = std::string(static_cast<std::size_t>(200 * writer), 'x');
        ResultLog(scratch.path(), "checks").append(check);
      }
    });
  }
  for (std::thread& writer : writers) writer.join();

  const Results results = reports::read_results(scratch.path());
  EXPECT_TRUE(results.warnings.empty());
  std::set<std::string> subjects;
  for (const verify::CheckResult& check : results.checks) subjects.insert(check.subject);
  EXPECT_EQ(results.checks.size(), std::size_t{kWriters * kLines});
  EXPECT_EQ(subjects.size(), std::size_t{kWriters * kLines});
}

TEST(ResultLog, TornLastLineIsReportedAndCostsNoOtherRecord) {
  const ScratchDirectory scratch;
  ResultLog(scratch.path(), "checks").append(check_named("before"));
  const std::string whole = text_of(scratch / "checks.jsonl");
  scratch.write("checks.jsonl", whole + reports::to_json(sample_check()).substr(0, 60));
  ResultLog(scratch.path(), "checks").append(check_named("after"));

  const Results results = reports::read_results(scratch.path());
  ASSERT_EQ(results.checks.size(), 2u);
  EXPECT_EQ(results.checks[0].subject, "before");
  EXPECT_EQ(results.checks[1].subject, "after");
  ASSERT_EQ(results.warnings.size(), 1u);
  EXPECT_EQ(results.warnings[0].file.filename(), "checks.jsonl");
  EXPECT_EQ(results.warnings[0].line, 3u) << "after the environment and the first check";
  EXPECT_NE(results.warnings[0].what.find("not JSON"), std::string::npos)
      << results.warnings[0].what;
}

TEST(ResultLog, DirectoryThatCannotBeMadeIsAnError) {
  const ScratchDirectory scratch;
  scratch.write("file", "");
  EXPECT_THROW(ResultLog(scratch / "file" / "results", "checks"), std::system_error);
}

/// Two million take ten seconds to refuse: what is shown here is that the last one too many is, in
/// whichever file.
TEST(ReadResults, NoMoreRecordsAreReadThanAllFilesMayHave) {
  const ScratchDirectory scratch;
  ResultLog(scratch / "a", "checks").append(check_named("1"));  // and the environment
  scratch.write("b.jsonl", "torn, and counted\n\n");
  scratch.write("c.json", to_json(sample_history()));
  EXPECT_EQ(reports::read_results(scratch.path(), 4).warnings.size(), 1u);
  const auto refusal_of = [&](std::size_t most) -> std::string {
    try {
      reports::read_results(scratch.path(), most);
    } catch (const reports::ResultsError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusal_of(3), (scratch / "c.json").string() + ": more than 3 records: split them");
  EXPECT_EQ(refusal_of(2), (scratch / "b.jsonl").string() + ":1: more than 2 records: split them");
  EXPECT_EQ(refusal_of(1),
            (scratch / "a/checks.jsonl").string() + ":2: more than 1 records: split them");
}

TEST(ReadResults, UnknownVersionIsAWarningThatNamesIt) {
  const ScratchDirectory scratch;
  scratch.write("new.jsonl", "{\"format\":\"plumbline.check/9\"}\n" +
                                 reports::to_json(sample_check()) + "\n{\"a\":1}\n");
  const Results results = reports::read_results(scratch.path());
  EXPECT_EQ(results.checks.size(), 1u);
  ASSERT_EQ(results.warnings.size(), 2u);
  EXPECT_EQ(results.warnings[0].what,
            "format \"plumbline.check/9\" is not one that this version reads");
  EXPECT_EQ(results.warnings[1].what, "states no \"format\"");
  EXPECT_EQ(results.warnings[1].line, 3u);
}

TEST(ReadResults, JsonFilesOfOtherProgramsArePassedOver) {
  const ScratchDirectory scratch;
  ResultLog(scratch.path(), "checks").append(sample_check());
  scratch.write("benchmark.json", "{\"context\":{},\"benchmarks\":[]}");
  scratch.write("notes.txt", "not looked at");
  const Results results = reports::read_results(scratch.path());
  EXPECT_EQ(results.checks.size(), 1u);
  EXPECT_TRUE(results.warnings.empty());
}

TEST(ReadResults, MissingFileAndEmptyDirectoryAreErrorsThatSayWhich) {
  const ScratchDirectory scratch;
  const std::string directory = scratch.path().string();
  EXPECT_EQ(error_of_reading(scratch / "none"), directory + "/none: no such directory");
  scratch.write("file", "");
  EXPECT_EQ(error_of_reading(scratch / "file"), directory + "/file: not a directory");
  EXPECT_EQ(error_of_reading(scratch.path()),
            directory + ": holds no results (*.jsonl, or *.json with a format)");
}

TEST(ReadResults, TwoBuildsAreToldApart) {
  const ScratchDirectory scratch;
  ResultLog log(scratch.path(), "checks");
  log.append(sample_environment());
  log.append(sample_check());
  EXPECT_EQ(reports::read_results(scratch.path()).environments.size(), 2u);
}

TEST(RenderRecord, ImageIsFoundAgainAfterTheDirectoryHasMoved) {
  const ScratchDirectory scratch;
  fs::create_directories(scratch / "old");
  reports::RenderRecord record = sample_render();
  record.image = scratch / "old" / "a.exr";
  reports::write_render_record(scratch / "old" / "a.json", record);
  fs::rename(scratch / "old", scratch / "new");
  EXPECT_EQ(reports::read_render_record(scratch / "new" / "a.json").image,
            scratch / "new" / "a.exr");
}

TEST(RenderRecord, FromBeforeThereWereAcceleratorsIsReadAsItStands) {
  const ScratchDirectory scratch;
  std::string text = to_json(sample_render());
  const std::string field = R"("accelerator":"embree",)";
  ASSERT_NE(text.find(field), std::string::npos) << text;
  text.erase(text.find(field), field.size());
  reports::RenderRecord expected = sample_render();
  expected.accelerator.clear();
  expected.image = scratch / "images/a.exr";
  EXPECT_EQ(reports::read_render_record(scratch.write("a.json", text)), expected);
}

TEST(Summary, CountsEachKindOfOutcomeOnce) {
  using verify::Verdict;
  Results results;
  const auto add = [&](Verdict verdict, Verdict expected) {
    verify::CheckResult check;
    check.verdict = verdict;
    check.expected = expected;
    results.checks.push_back(check);
  };
  add(Verdict::pass, Verdict::pass);
  add(Verdict::fail, Verdict::fail);
  add(Verdict::inconclusive, Verdict::inconclusive);
  EXPECT_TRUE(reports::summarise(results).good());
  add(Verdict::fail, Verdict::fail);
  results.checks.back().waived = "known";
  EXPECT_TRUE(reports::summarise(results).good());
  add(Verdict::inconclusive, Verdict::pass);
  add(Verdict::pass, Verdict::fail);
  const reports::Summary summary = reports::summarise(results);
  EXPECT_EQ(summary.passed, 1u);
  EXPECT_EQ(summary.failed_as_expected, 1u);
  EXPECT_EQ(summary.inconclusive_as_expected, 1u);
  EXPECT_EQ(summary.waived, 1u);
  EXPECT_EQ(summary.unexpected, 2u);
  EXPECT_EQ(summary.checks(), 6u);
  EXPECT_FALSE(summary.good());
}

TEST(Summary, LostRecordsAndNoChecksAreNotGood) {
  Results results;
  EXPECT_FALSE(reports::summarise(results).good());
  results.checks.push_back(verify::CheckResult{});
  results.checks[0].verdict = verify::Verdict::pass;
  EXPECT_TRUE(reports::summarise(results).good());
  results.warnings.push_back({"a.jsonl", 1, "torn"});
  EXPECT_FALSE(reports::summarise(results).good());
}

}  // namespace
}  // namespace plumbline::tests
