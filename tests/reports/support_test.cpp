#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <plumbline_tests/scoped_variable.h>
#include <plumbline_tests/support.h>
#include <stdlib.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "samples.h"

namespace plumbline::tests {
namespace {

verify::CheckResult result_with(verify::Verdict verdict, verify::Verdict expected) {
  verify::CheckResult result = sample_check();
  result.verdict = verdict;
  result.expected = expected;
  result.replay.clear();
  result.seed = 0;
  return result;
}

TEST(RunSeed, ComesFromTheEnvironment) {
  const ScopedVariable seed("PLUMBLINE_SEED", "18446744073709551615");
  EXPECT_EQ(run_seed(), 18'446'744'073'709'551'615u);
}

TEST(RunSeed, WhatIsNoSeedIsRefusedNotRead) {
  for (const char* text : {"-1", "1e3", "12 ", "0x10", "18446744073709551616", "seed"}) {
    const ScopedVariable seed("PLUMBLINE_SEED", text);
    EXPECT_THROW(run_seed(), std::runtime_error) << text;
  }
}

TEST(CheckSeed, DiffersBetweenSubjectsAndBetweenRuns) {
  const ScopedVariable seed("PLUMBLINE_SEED", "1");
  const std::uint64_t first = check_seed("furnace/mis");
  EXPECT_EQ(check_seed("furnace/mis"), first);
  EXPECT_NE(check_seed("furnace/bsdf"), first);
  const ScopedVariable other("PLUMBLINE_SEED", "2");
  EXPECT_NE(check_seed("furnace/mis"), first);
}

TEST(ExpectVerdict, LogsTheResultWithSeedAndReplay) {
  const ScratchDirectory scratch;
  const ScopedVariable results("PLUMBLINE_RESULTS", scratch.path().string());
  const ScopedVariable seed("PLUMBLINE_SEED", "77");
  expect_verdict(result_with(verify::Verdict::pass, verify::Verdict::pass));
  const reports::Results read = reports::read_results(scratch.path());
  ASSERT_EQ(read.checks.size(), 1u);
  EXPECT_EQ(read.checks[0].seed, 77u);
  EXPECT_EQ(read.checks[0].replay, replay_command());
}

TEST(ExpectVerdict, SecondsAreThoseSinceTheLastResult) {
  const ScratchDirectory scratch;
  const ScopedVariable results("PLUMBLINE_RESULTS", scratch.path().string());
  verify::CheckResult timed = result_with(verify::Verdict::pass, verify::Verdict::pass);
  verify::CheckResult untimed = timed;
  timed.seconds = 100;
  untimed.seconds = 0;
  expect_verdict(timed);
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  expect_verdict(untimed);
  const reports::Results read = reports::read_results(scratch.path());
  ASSERT_EQ(read.checks.size(), 2u);
  EXPECT_EQ(read.checks[0].seconds, 100) << "what a check has measured itself stands";
  EXPECT_GE(read.checks[1].seconds, 0.025);
}

TEST(ExpectVerdict, UnexpectedVerdictFailsTheTestWithSubjectAndReplay) {
  const ScratchDirectory scratch;
  const ScopedVariable results("PLUMBLINE_RESULTS", scratch.path().string());
  const verify::CheckResult result =
      result_with(verify::Verdict::inconclusive, verify::Verdict::pass);
  EXPECT_NONFATAL_FAILURE(expect_verdict(result), "furnace_sphere/mis/power");
  EXPECT_NONFATAL_FAILURE(expect_verdict(result), "ctest ");
}

TEST(ExpectVerdict, ControlThatFailsAsItMustDoesNotFailTheTest) {
  const ScratchDirectory scratch;
  const ScopedVariable results("PLUMBLINE_RESULTS", scratch.path().string());
  expect_verdict(result_with(verify::Verdict::fail, verify::Verdict::fail));
}

TEST(ReplayCommand, NamesThisTestAsCtestKnowsIt) {
  const ScopedVariable seed("PLUMBLINE_SEED", "5");
  const ScopedVariable night("PLUMBLINE_NIGHTLY", "0");
  const std::string command = replay_command();
  EXPECT_EQ(command.rfind("PLUMBLINE_SEED=5 ctest --", 0), 0u) << command;
  EXPECT_NE(command.find(" -R '^ReplayCommand\\.NamesThisTestAsCtestKnowsIt$'"), std::string::npos)
      << command;
}

TEST(ReplayCommand, RepeatsTheNightAtNight) {
  const ScopedVariable night("PLUMBLINE_NIGHTLY", "1");
  EXPECT_EQ(replay_command().rfind("PLUMBLINE_NIGHTLY=1 PLUMBLINE_SEED=", 0), 0u);
}

TEST(ReplayCommand, RepeatsTheGateAtNight) {
  const ScopedVariable night("PLUMBLINE_NIGHTLY", "gate");
  EXPECT_FALSE(nightly());
  EXPECT_EQ(replay_command().rfind("PLUMBLINE_NIGHTLY=gate PLUMBLINE_SEED=", 0), 0u);
}

TEST(ReplayCommand, StandsUnderAFailureThatDoesNotSayIt) {
  // The test runs itself, and fails then.
  if (::getenv("PLUMBLINE_FAIL_HERE") != nullptr) FAIL() << "as it was asked to";
  const ScratchDirectory scratch;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command =
      "PLUMBLINE_FAIL_HERE=1 PLUMBLINE_SEED=5 '" + program +
      "' --gtest_filter=" + "ReplayCommand.StandsUnderAFailureThatDoesNotSayIt >'" +
      (scratch / "output").string() + "'";
  EXPECT_NE(std::system(command.c_str()), 0);
  const ScopedVariable seed("PLUMBLINE_SEED", "5");
  const std::string output = scratch.read("output"), line = "\nreplay: " + replay_command() + "\n";
  EXPECT_NE(output.find(line), std::string::npos) << output;
}

TEST(Repeatable, AReportGetsTheCommandUnlessItHasOne) {
  EXPECT_EQ(repeatable(verify::Report(sample_check())).replay, replay_command());
  verify::Report report;
  report.replay = "make test";
  EXPECT_EQ(repeatable(report).replay, "make test");
}

class ReplayOfNames : public testing::TestWithParam<int> {};

TEST_P(ReplayOfNames, GoByTheirName) {
  EXPECT_NE(replay_command().find("Names/ReplayOfNames\\.GoByTheirName/mis_power$'"),
            std::string::npos)
      << replay_command();
}
INSTANTIATE_TEST_SUITE_P(Names, ReplayOfNames, testing::Values(3),
                         [](const auto&) { return std::string("mis_power"); });

template <class T>
class ReplayOfTypes : public testing::Test {};
TYPED_TEST_SUITE(ReplayOfTypes, testing::Types<int>);

TYPED_TEST(ReplayOfTypes, GoByTheirType) {
  EXPECT_NE(replay_command().find("^ReplayOfTypes\\.GoByTheirType<int>$'"), std::string::npos)
      << replay_command();
}

TEST(ScratchDirectory, IsEmptyAndGoesAway) {
  std::filesystem::path path;
  {
    const ScratchDirectory scratch;
    path = scratch.path();
    EXPECT_TRUE(std::filesystem::is_empty(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(SourceFile, IsFoundFromTheRoot) {
  EXPECT_TRUE(std::filesystem::exists(source_file("CMakePresets.json")));
}

}  // namespace
}  // namespace plumbline::tests
