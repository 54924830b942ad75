#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <string>

#include <plumbline/verify/gtest.h>

namespace plumbline::verify {
namespace {

CheckResult result(CheckKind kind, const std::string& subject, Verdict verdict,
                   Verdict expected = Verdict::pass) {
  CheckResult r;
  r.kind = kind;
  r.subject = subject;
  r.verdict = verdict;
  r.expected = expected;
  return r;
}

CheckResult passed(const std::string& subject = "a/mean") {
  return result(CheckKind::mean, subject, Verdict::pass);
}

CheckResult failed(const std::string& subject = "a/integral") {
  CheckResult r = result(CheckKind::integral, subject, Verdict::fail);
  r.reason = "the sum of " + subject + " is 2";
  return r;
}

CheckResult skipped() {
  return result(CheckKind::jacobian, "a/jacobian", Verdict::inconclusive, Verdict::inconclusive);
}

CheckResult undecided() {
  CheckResult r = result(CheckKind::energy, "a/energy", Verdict::inconclusive);
  r.advice = "state where it jumps";
  return r;
}

CheckResult control() { return result(CheckKind::mean, "control", Verdict::fail, Verdict::fail); }

std::size_t count_of(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

bool holds(const std::string& text, const std::string& part) { return count_of(part, text) > 0; }

TEST(Report, IsOkWhereAllPassesThatWasNotSkipped) {
  struct Case {
    Report report;
    bool ok, as_expected;
    Verdict verdict;
  };
  const Case cases[] = {
      {passed(), true, true, Verdict::pass},
      {Report({passed(), skipped()}), true, true, Verdict::pass},
      {skipped(), true, true, Verdict::inconclusive},
      {Report({passed(), failed()}), false, false, Verdict::fail},
      {Report({passed(), undecided()}), false, false, Verdict::inconclusive},
      {Report({passed(), control()}), false, true, Verdict::fail},
      {Report({undecided(), failed()}), false, false, Verdict::fail},
      {Report(), false, false, Verdict::inconclusive},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(c.report.ok(), c.ok) << c.report.summary();
    EXPECT_EQ(c.report.as_expected(), c.as_expected) << c.report.summary();
    EXPECT_EQ(c.report.verdict(), c.verdict) << c.report.summary();
  }
}

TEST(Report, SummaryOfWhatIsWellIsOneLine) {
  EXPECT_EQ(Report({passed(), passed(), skipped()}).summary(), "2 of 3 checks passed, 1 skipped\n");
  EXPECT_EQ(Report(passed()).summary(), "1 of 1 check passed\n");
  EXPECT_EQ(Report().summary(), "nothing was checked\n");
}

TEST(Report, SummaryHoldsWhatAPersonActsOn) {
  Report report({passed("good"), undecided(), failed("front/integral")});
  for (int i = 0; i < 20; ++i) report.append(failed("view " + std::to_string(i) + "/integral"));
  for (CheckResult& r : report) {
    if (r.verdict == Verdict::fail) r.diagnosis = "observed/expected = 2: factor 2?";
  }
  report.second_cause = "cosθ missing?";
  report.replay = "ctest -R a";
  const std::string text = report.summary();
  EXPECT_EQ(text.rfind("22 of 23 checks did not give what they should\n"
                       "likely cause: observed/expected = 2: factor 2?\n"
                       "or, nearly as well: cosθ missing?\n"
                       "front/integral: integral check gives fail",
                       0),
            0u)
      << text;
  EXPECT_EQ(count_of("factor 2?", text), 1u) << "the cause is said once:\n" << text;
  EXPECT_EQ(count_of("is 2\n", text), 1u) << "the first of a kind in full, others by name:\n"
                                          << text;
  EXPECT_TRUE(holds(text, "  view 11/integral\n  and 8 more\n")) << text;
  EXPECT_TRUE(holds(text, "state where it jumps")) << text;
  EXPECT_FALSE(holds(text, "good")) << text;
  EXPECT_EQ(count_of("ctest -R a", text), 1u) << text;
  EXPECT_LE(count_of("\n", text), 30u) << text;
}

TEST(Report, SummaryNamesTheCauseOfTheWholeBeforeThatOfOneResult) {
  Report report(failed());
  report.results[0].diagnosis = "of one";
  EXPECT_TRUE(holds(report.summary(), "likely cause: of one")) << report.summary();
  report.cause = "of all";
  EXPECT_TRUE(holds(report.summary(), "likely cause: of all")) << report.summary();
}

TEST(Report, SummaryShowsWhatIsUnexpectedBeforeWhatIsDeclared) {
  EXPECT_FALSE(holds(Report({control(), undecided()}).summary(), "control"));
  EXPECT_TRUE(holds(Report({control(), passed()}).summary(), "1 of 2 checks declared not to pass"));
}

TEST(Report, AppendKeepsTheFirstCause) {
  Report a(passed()), b(failed()), c(failed());
  b.cause = "b";
  b.cause_kind = CauseKind::cosine;
  c.cause = "c";
  a.append(b);
  a.append(c);
  EXPECT_EQ(a.size(), 3u);
  EXPECT_EQ(a.cause, "b");
  EXPECT_EQ(a.cause_kind, CauseKind::cosine);
}

TEST(ReportMacros, PassIsStrictAndVerdictsHoldWhatIsDeclared) {
  PLUMBLINE_EXPECT_PASS(passed());
  PLUMBLINE_ASSERT_PASS(Report({passed(), skipped()}));
  PLUMBLINE_EXPECT_VERDICTS(control());
  PLUMBLINE_ASSERT_VERDICTS(Report({passed(), skipped(), control()}));
  EXPECT_NONFATAL_FAILURE(PLUMBLINE_EXPECT_PASS(control()), "control: mean check gives fail");
  EXPECT_NONFATAL_FAILURE(PLUMBLINE_EXPECT_PASS(Report()), "nothing was checked");
  EXPECT_NONFATAL_FAILURE(PLUMBLINE_EXPECT_PASS(undecided()), "state where it jumps");
  EXPECT_NONFATAL_FAILURE(PLUMBLINE_EXPECT_VERDICTS(failed()), "--gtest_filter=ReportMacros.Pass");
}

}  // namespace
}  // namespace plumbline::verify
