#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <string>
#include <vector>

#include "command_line.h"

namespace plumbline::tests {
namespace {

const std::string kExample = PLUMBLINE_C_EXAMPLE;

/// One direction, with little effort.
Outcome run_verify(const ScratchDirectory& scratch, const std::string& program,
                   const std::string& arguments = "") {
  return run_plumbline(scratch.path(), "verify --quick --angles 60 --faces front --exec \"" +
                                           program + "\" " + arguments);
}

TEST(VerifyCommand, CorrectProgramPassesAndIsKept) {
  const ScratchDirectory scratch;
  const Outcome outcome =
      run_verify(scratch, kExample, "--name mine --json mine.jsonl --results kept");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("checks passed"), std::string::npos) << outcome.out;
  EXPECT_NE(scratch.read("mine.jsonl").find("\"mine/front 60°/chi_square\""), std::string::npos);
  EXPECT_EQ(run_plumbline(scratch.path(), "report kept -o page.html").exit_code, 0);
}

TEST(VerifyCommand, FaultyProgramFailsWithTheCause) {
  const ScratchDirectory scratch;
  const Outcome outcome = run_verify(scratch, kExample + " --faulty", "--seed 5");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("likely cause: factor cosθi missing from pdf()"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("replay: plumbline verify --exec '" + kExample +
                             " --faulty' --angles 60"
                             " --faces front --quick --seed 5"),
            std::string::npos)
      << outcome.out;
}

TEST(VerifyCommand, KnownFailuresAreWaivedUntilTheyExpire) {
  const ScratchDirectory scratch;
  const auto waiver = [](const std::string& until) {
    return R"([{"check": "*", "reason": "known", "until": ")" + until + R"("}])";
  };
  scratch.write("known.json", waiver("2999-01-01"));
  const Outcome waived =
      run_verify(scratch, kExample + " --faulty", "--waivers known.json --results kept");
  EXPECT_EQ(waived.exit_code, 0) << waived.out << waived.err;
  EXPECT_NE(waived.out.find("known (until 2999-01-01)"), std::string::npos) << waived.out;
  EXPECT_NE(run_plumbline(scratch.path(), "report kept -o page.html").out.find("waived"),
            std::string::npos);
  scratch.write("known.json", waiver("2020-01-01"));
  const Outcome expired = run_verify(scratch, kExample + " --faulty", "--waivers known.json");
  EXPECT_EQ(expired.exit_code, 1);
  EXPECT_NE(expired.out.find("expired on 2020-01-01: known"), std::string::npos) << expired.out;
}

TEST(VerifyCommand, ProgramThatBreaksTheProtocolIsBadInput) {
  const ScratchDirectory scratch;
  const Outcome outcome = run_verify(scratch, PLUMBLINE_ANSWERER " dies float32 100", "--json x");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.find("plumbline: query 101 ("), 0u) << outcome.err;
  EXPECT_NE(outcome.err.find("ended with exit status 3"), std::string::npos) << outcome.err;
  EXPECT_EQ(scratch.listing(), "") << "no results of half a battery";
}

TEST(VerifyCommand, OptionsMayStandInAFile) {
  const ScratchDirectory scratch;
  scratch.write("mine.json", R"({"exec": ")" PLUMBLINE_ANSWERER
                             R"( dies", "conventions": ["y-up"], "timeout": 5})");
  const Outcome outcome = run_plumbline(scratch.path(), "verify --options mine.json");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.find("plumbline: query 2 ("), 0u) << outcome.err;
}

TEST(VerifyCommand, SelfTestSaysWhatWasTested) {
  const ScratchDirectory scratch;
  const Outcome good =
      run_plumbline(scratch.path(), "verify --self-test --exec '" + kExample + "'");
  EXPECT_EQ(good.exit_code, 0) << good.out;
  EXPECT_NE(good.out.find("ok   first line: lambertian, float32, 2 uniform numbers"),
            std::string::npos)
      << good.out;
  EXPECT_EQ(run_plumbline(scratch.path(), "verify --self-test --exec '" PLUMBLINE_ANSWERER " type'")
                .exit_code,
            1);
}

struct Wrong {
  const char* arguments;
  const char* message;
};

TEST(VerifyCommand, MisuseHasExitCodeTwoAndAMessage) {
  const ScratchDirectory scratch;
  scratch.write("bad.json", R"({"angels": [60]})");
  scratch.write("day.json", R"([{"check": "a", "reason": "b", "until": "soon"}])");
  for (const Wrong& wrong : std::vector<Wrong>{
           {"", "verify needs --exec COMMAND or --exchange DIR"},
           {"--exec true --angles 60,x", "--angles 60,x: must read like 0,60,80"},
           {"--exec true --angles 95", "angles are degrees from the normal"},
           {"--exec true --faces top", R"(faces are "both", "front" or "back")"},
           {"--exec true --convention yup",
            R"(--convention yup: there is no such convention; did)"},
           {"--exec true --convention normal:0,0,0",
            "must read normal:X,Y,Z, finite and not all 0"},
           {"--exec true --domain disc", R"(--domain disc: there is no such domain; did you mean)"},
           {"--exec true --domain disk:0", "--domain disk:0: must read like disk:2"},
           {"--exec true --domain discrete", "must read like disk:2, interval:-1:1, discrete:5"},
           {"--exec true --eta 0", "0 is not a positive number"},
           {"--exec true --samples 5", "5 is not a whole number from 1000"},
           {"--exec true --timeout nan", "nan is not a positive number"},
           {"--exec true --options missing.json", "missing.json: cannot be read"},
           {"--exec true --options bad.json", R"(bad.json: there is no field "angels")"},
           {"--exec true --waivers bad.json", "bad.json: not a list of waivers"},
           {"--exec true --waivers day.json",
            R"(day.json: waiver 1: "soon" is no day; it must read like 2027-01-31)"},
           {"--exec true --json missing/x", "there is no directory missing"},
           {"--exec '" PLUMBLINE_ANSWERER " square' --domain disk",
            "--domain disk, but the program answers for square"},
           {"--exec '" PLUMBLINE_ANSWERER " square' --angles 60", "belong to a BSDF"},
           {"--exec true", "waiting for the program's first line"},
       }) {
    const Outcome outcome = run_plumbline(scratch.path(), "verify " + std::string(wrong.arguments));
    EXPECT_EQ(outcome.exit_code, 2) << wrong.arguments << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(wrong.message), std::string::npos) << wrong.arguments << "\n"
                                                                  << outcome.err;
  }
  EXPECT_EQ(scratch.listing(), "bad.json day.json");
}

}  // namespace
}  // namespace plumbline::tests
