#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <regex>
#include <string>

#include "ranks.h"

/// A suite of programs and seeds by ranks is the suite by one process.
namespace plumbline::tests {
namespace {

const std::string kProgram = PLUMBLINE_C_EXAMPLE;

/// One that is right, one that is not, and one that is not there; little of each.
std::string suite() {
  const std::string options = R"("angles": [60], "faces": "front", "quick": true})";
  return R"({"exec": ")" + kProgram + R"(", "name": "right", )" + options + "\n\n" +
         R"({"exec": ")" + kProgram + R"( --faulty", "name": "wrong", )" + options + "\n" +
         R"({"exec": "./nosuch", "name": "missing", )" + options + "\n";
}

/// But for times, and the line of the environment.
std::string without_times(const std::string& text) {
  static const std::regex time(
      R"re("seconds":[^,}]*|"time":"[^"]*"|[0-9.]+ s\n|\{"[^\n]*"plumbline.environment[^\n]*\n)re");
  return std::regex_replace(text, time, "");
}

TEST(Suites, OfRanksAreThoseOfOneProcess) {
  const ScratchDirectory scratch;
  scratch.write("suite.jsonl", suite());
  const std::string verify = "verify --suite suite.jsonl --seeds 2 --json ";
  const Outcome alone = run_plumbline(scratch.path(), verify + "alone.jsonl");
  EXPECT_EQ(alone.exit_code, 2) << alone.err;
  EXPECT_NE(alone.out.find("2 of 6 are fine, 2 fail, 2 could not be checked; "), std::string::npos)
      << alone.out;
  EXPECT_NE(alone.out.find("suite.jsonl:3, seed 2\n"), std::string::npos) << alone.out;
  EXPECT_NE(alone.out.find("factor cosθi missing from pdf()"), std::string::npos) << alone.out;
  for (const int count : {2, 3}) {
    const Outcome ranks = run_in_ranks(scratch.path(), count, verify + "ranks.jsonl");
    EXPECT_EQ(ranks.exit_code, 2) << ranks.err;
    EXPECT_EQ(without_times(ranks.out), without_times(alone.out));
    EXPECT_EQ(without_times(scratch.read("ranks.jsonl")),
              without_times(scratch.read("alone.jsonl")));
  }
  EXPECT_NE(scratch.read("alone.jsonl").find("--seed 2"), std::string::npos);
}

TEST(Suites, ThatNobodyCanReadAreRefused) {
  const ScratchDirectory scratch;
  scratch.write("suite.jsonl", suite() + R"({"exce": "./mine"})");
  expect_refused(scratch.path(), "verify --suite suite.jsonl", "suite.jsonl:5: ");
  scratch.write("empty.jsonl", "\n");
  expect_refused(scratch.path(), "verify --suite empty.jsonl", "empty.jsonl: has no line");
  expect_refused(scratch.path(), "verify --suite suite.jsonl --waivers known.json", "excludes");
  expect_refused(scratch.path(), "verify --exec ./mine --mpi", "--suite");
  expect_refused(scratch.path(), "verify --exec ./mine --seeds 3", "--suite");
}

}  // namespace
}  // namespace plumbline::tests
