#include <gtest/gtest.h>
#include <plumbline_tests/support.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <plumbline/exchange/answerer.h>
#include <plumbline/exchange/self_test.h>
#include <plumbline/verify/gtest.h>

namespace plumbline::tests {
namespace {

using exchange::Answerer;
using exchange::AnswererError;
using exchange::AnswererOptions;
using verify::SampleRecord;
using verify::Uniforms;
using verify::Vec3;

constexpr double kTimeout = 1.5;  // s, of programs that hang: others must make it on a busy machine

AnswererOptions program(const std::string& arguments, double timeout = 60) {
  return {PLUMBLINE_ANSWERER " " + arguments, {}, timeout};
}

/// Two queries of each kind.
void ask_all(Answerer& answerer, std::size_t count) {
  const std::vector<Vec3> wo(count, {0.6, 0, 0.8}), wi(count, {0, 0.6, 0.8});
  const std::vector<Uniforms> u(count, {0.25, 0.5, 0});
  std::vector<std::optional<SampleRecord>> samples(count);
  std::vector<double> pdfs(count);
  std::vector<verify::Channels> values(count);
  for (int i = 0; i < 2; ++i) {
    answerer.pdf(wo, wi, pdfs);
    answerer.sample(wo, u, samples);
    answerer.eval(wo, wi, values);
  }
}

/// What is said of a program that answers its first query well and the others as told.
std::string complaint(const std::string& mode, double timeout = 60, std::size_t count = 3) {
  try {
    Answerer answerer(program(mode, timeout));
    ask_all(answerer, count);
    return answerer.finish();
  } catch (const AnswererError& error) {
    return error.what();
  }
}

TEST(Answerer, ValuesCrossAsTheyAre) {
  for (const bool float64 : {false, true}) {
    Answerer answerer(program(float64 ? "well float64" : "well float32"));
    EXPECT_EQ(answerer.hello().float64, float64);
    const double epsilon = float64 ? 0x1p-53 : 0x1p-24;
    const std::vector<Vec3> wo = {{0.6, 0, 0.8}, {0, 0, -1}, {0, 0, 1}};
    const std::vector<Uniforms> u = {{0.25, 0.5, 0}, {0.5, 0.5, 0}, {0, 0, 0}};
    std::vector<std::optional<SampleRecord>> samples(3);
    answerer.sample(wo, u, samples);
    ASSERT_TRUE(samples[0] && !samples[1] && samples[2]);
    EXPECT_NEAR(samples[0]->x[0], -0.5, 4 * epsilon);
    EXPECT_NEAR(samples[0]->x[2], std::sqrt(0.75), 4 * epsilon);
    EXPECT_NEAR(samples[0]->pdf.value(), std::sqrt(0.75) / std::numbers::pi, 4 * epsilon);
    EXPECT_EQ(samples[0]->weight.count, 1u);
    EXPECT_NEAR(samples[0]->weight[0], 0.8, 4 * epsilon);
    std::vector<double> pdfs(3);
    answerer.pdf(wo, std::vector<Vec3>(3, Vec3{0, 0.6, 0.8}), pdfs);
    EXPECT_NEAR(pdfs[0], 0.8 / std::numbers::pi, 4 * epsilon);
    EXPECT_EQ(pdfs[1], 0);
    EXPECT_EQ(answerer.queries(), 2u);
    EXPECT_EQ(answerer.values(), 6u);
    EXPECT_EQ(answerer.finish(), "");
  }
}

TEST(Answerer, MoreThanAMillionValuesAreSeveralQueries) {
  Answerer answerer(program("well"));
  const std::size_t count = exchange::kMostValues + 1;
  std::vector<double> pdfs(count);
  answerer.pdf(std::vector<Vec3>(count, Vec3{0, 0, 1}), std::vector<Vec3>(count, Vec3{0, 0, 1}),
               pdfs);
  EXPECT_EQ(answerer.queries(), 2u);
  EXPECT_NEAR(pdfs.front(), 1 / std::numbers::pi, 1e-7);
  EXPECT_EQ(pdfs.front(), pdfs.back());
}

TEST(Answerer, ThatWritesBeforeItHasReadAllIsNoDeadlock) {
  EXPECT_EQ(complaint("early", 60, 200'000), "");
}

TEST(Answerer, WithoutEvalHasNone) {
  const auto answerer = std::make_shared<Answerer>(program("no-eval"));
  EXPECT_FALSE(answerer->hello().has_eval);
  const verify::ErasedBsdf bsdf = exchange::as_bsdf(answerer);
  EXPECT_FALSE(bsdf.eval);
  EXPECT_EQ(bsdf.epsilon, 0x1p-24);
}

TEST(Answerer, AtomsColoursAndDensitiesThatAreNotStatedCross) {
  Answerer answerer(program("mirror"));
  std::vector<std::optional<SampleRecord>> samples(2);
  answerer.sample(std::vector<Vec3>(2, Vec3{0, 0.6, 0.8}), std::vector<Uniforms>(2), samples);
  ASSERT_TRUE(samples[1]);
  EXPECT_EQ(samples[1]->mass, 1);
  EXPECT_FALSE(samples[1]->pdf);
  EXPECT_EQ(samples[1]->weight.count, 3u);
  EXPECT_NEAR(samples[1]->x[1], -0.6, 0x1p-24);
}

TEST(Answerer, PairOverAnotherDomainGoesThroughItsBattery) {
  const auto answerer = std::make_shared<Answerer>(program("square float64"));
  EXPECT_EQ(answerer->hello().domain, "square");
  const verify::SamplingPair pair =
      exchange::as_pair(answerer, "uniform", verify::Domain::unit_square());
  PLUMBLINE_EXPECT_PASS(repeatable(verify::check_pair(pair, contract_options("exchange/square"))));
}

TEST(Answerer, NanIsAFindingAndNoErrorOfTheProtocol) {
  const auto answerer = std::make_shared<Answerer>(program("nan"));
  const verify::SamplingPair pair =
      verify::bsdf_pair("nan", exchange::as_bsdf(answerer), {0, 0.6, 0.8});
  std::string failing;
  for (const verify::CheckResult& result : verify::check_pointwise(pair)) {
    if (result.verdict == verify::Verdict::fail) failing += result.subject + " ";
  }
  EXPECT_NE(failing.find("nan/finite"), std::string::npos) << failing;
}

struct Complaint {
  const char* mode;
  const char* message;  ///< part of it
};

TEST(Answerer, WhatIsWrongIsSaidWithTheQuery) {
  for (const Complaint& wrong : std::vector<Complaint>{
           {"dies", "ended with exit status 3 before its answer was complete"},
           {"aborts", "was ended by signal 6"},
           {"closes-output", "closed its standard output, but still runs"},
           {"rubbish", R"(its answer begins with "computing)"},
           {"no-line", R"(wrote no line of JSON, but "xxxx)"},
           {"other-query", "its answer is one to query 99"},
           {"refuses", "the program says: no such BSDF"},
           {"shape", R"(its array "wi" has the shape (3, 3); (3, 3) is wanted)"},
           {"count", R"(its array "wi" has the shape (2, 3); (3, 3) is wanted)"},
           {"huge", R"(its array "wi" has the shape (4000000000, 3); (3, 3) is wanted)"},
           {"type", R"(its array "wi" holds values of type |b1; <f4 or <f8)"},
           {"no-header",
            R"(its array "wi" does not begin as an NPY array does, but with "these ar")"},
           {"flag", R"(its array "accepted" holds a bool that is neither 0 nor 1 but 7)"},
           {"more", R"(wrote more than its last answer: "and more")"},
       }) {
    if (std::string(wrong.mode) == "shape") continue;  // a square: see below
    const std::string said = complaint(wrong.mode);
    EXPECT_NE(said.find(wrong.message), std::string::npos) << wrong.mode << "\n" << said;
    const bool late = std::string(wrong.mode) == "more";  // seen when the next is asked
    EXPECT_EQ(said.find(late ? "query 3 (eval, 3 values): " : "query 2 (sample, 3 values): "), 0u)
        << said;
    EXPECT_NE(said.find("docs/protocol.md"), std::string::npos) << said;
  }
  EXPECT_NE(complaint("shape", 60, 4).find(R"("wi" has the shape (3, 4); (4, 3) is wanted)"),
            std::string::npos);
}

TEST(Answerer, ThatHangsIsWaitedForAsLongAsAllowed) {
  for (const Complaint& wrong : std::vector<Complaint>{
           {"silent", "waiting for the program's first line: the program did not answer"},
           {"hangs",
            "query 2 (sample, 3 values): the program did not answer within 1.5 s; does it"},
           {"midway",
            "query 2 (sample, 3 values): the program did not answer within 1.5 s: its "
            "answer stops after "},
       }) {
    const std::string said = complaint(wrong.mode, kTimeout);
    EXPECT_EQ(said.find(wrong.message), 0u) << wrong.mode << "\n" << said;
  }
}

TEST(Answerer, ThatStopsReadingIsToldApart) {
  const std::string said = complaint("hangs", kTimeout, 500'000);
  EXPECT_NE(said.find("query 2 (sample, 500000 values)"), std::string::npos) << said;
  EXPECT_NE(said.find("bytes of the query"), std::string::npos) << said;
  const std::string closed = complaint("closes-input", kTimeout, 500'000);
  EXPECT_NE(closed.find("closed its standard input, but still runs"), std::string::npos) << closed;
}

TEST(Answerer, FirstLineMustBeUnderstood) {
  EXPECT_NE(complaint("version").find(R"(speaks the protocol "plumbline/9"; this version speaks)"),
            std::string::npos);
  for (const Complaint& wrong : std::vector<Complaint>{
           {"echo hello", R"(the program's first line, "hello", is not what it must be)"},
           {"./there_is_no_such", "exit status 127 (is the command there?)"},
           {"true", "ended with exit status 0 before its answer was complete"},
           {R"(echo '{"protocol": "plumbline/1", "name": "x"}')", R"("precision" is missing)"},
       }) {
    try {
      Answerer answerer({wrong.mode, {}, 60});
      ADD_FAILURE() << wrong.mode;
    } catch (const AnswererError& error) {
      EXPECT_NE(std::string(error.what()).find(wrong.message), std::string::npos) << error.what();
    }
  }
}

TEST(Answerer, EndIsTold) {
  EXPECT_EQ(complaint("bad-end"), "the program ended with exit status 5 after its last answer");
  EXPECT_EQ(complaint("no-end", kTimeout),
            "the program did not end within 1.5 s of the end of its input and was killed");
}

TEST(Answerer, AfterAFailureEveryQueryFailsAlike) {
  Answerer answerer(program("dies"));
  std::string first, second;
  for (std::string* said : {&first, &second}) {
    try {
      ask_all(answerer, 3);
    } catch (const AnswererError& error) {
      *said = error.what();
    }
  }
  EXPECT_EQ(first, second);
}

/// Whether a process is there and no zombie that nobody has reaped yet.
bool is_running(int process) {
  const std::string status = text_of("/proc/" + std::to_string(process) + "/stat");
  return !status.empty() && status.find(") Z ") == std::string::npos;
}

TEST(Answerer, NothingThatItStartedIsLeft) {
  const ScratchDirectory scratch;
  AnswererOptions options = program("hangs-with-child", kTimeout);
  options.command = "cd '" + scratch.path().string() + "' && " + options.command;
  try {
    Answerer answerer(options);
    ask_all(answerer, 3);
  } catch (const AnswererError&) {
  }
  const std::string written = scratch.read("child");
  ASSERT_FALSE(written.empty());
  const int child = std::stoi(written);
  for (int i = 0; i < 1000 && is_running(child); ++i) {
    std::this_thread::sleep_for(
        std::chrono::milliseconds(10));  // it is killed, but not by us reaped
  }
  EXPECT_FALSE(is_running(child));
}

TEST(SelfTest, SaysWhatDoesNotKeepToTheProtocol) {
  std::string told;
  const auto tell = [&](const exchange::SelfTestStep& step) {
    told += (step.ok ? "ok " : "FAIL ") + step.what + ": " + step.detail + "\n";
  };
  const auto bsdf = [](const reports::AnswererHello&) { return std::nullopt; };
  EXPECT_FALSE(exchange::self_test(program("bad-end"), bsdf, tell));
  EXPECT_NE(told.find("ok batches of 1,000,000"), std::string::npos) << told;
  EXPECT_NE(told.find("FAIL ends when its input does: "), std::string::npos) << told;
  told.clear();
  EXPECT_FALSE(exchange::self_test(program("count"), bsdf, tell));
  EXPECT_NE(told.find("FAIL batches of 1 to 1000, in any order: query 2 (sample, 1000"),
            std::string::npos)
      << told;
}

}  // namespace
}  // namespace plumbline::tests
