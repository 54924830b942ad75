#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/waiver.h>

namespace plumbline::verify {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::year_month_day kToday = 2026y / 11 / 30;

CheckResult result(const std::string& subject, Verdict verdict) {
  CheckResult r;
  r.subject = subject;
  r.verdict = verdict;
  return r;
}

Report of_a_coat() {
  return Report({result("coat/front 0°/energy", Verdict::fail),
                 result("coat/front 80°/energy", Verdict::inconclusive),
                 result("coat/front 0°/integral", Verdict::pass)});
}

Waiver waiver(const std::string& check, std::chrono::year_month_day until = kToday) {
  return {check, "multiple scattering is missing", until};
}

TEST(Waiver, LetsTheFailuresThatItNamesPass) {
  const Report report = waive(of_a_coat(), {waiver("coat/*/energy")}, kToday);
  EXPECT_TRUE(report.ok()) << report.summary();
  EXPECT_TRUE(report.as_expected());
  EXPECT_EQ(report.verdict(), Verdict::pass);
  EXPECT_EQ(report.size(), 3u);
  EXPECT_EQ(report.summary(),
            "1 of 3 checks passed, 2 waived\n"
            "waived: coat/front 0°/energy: multiple scattering is missing (until 2026-11-30)\n"
            "waived: coat/front 80°/energy: multiple scattering is missing (until 2026-11-30)\n");
}

TEST(Waiver, LeavesOtherFailuresAlone) {
  const Report report = waive(of_a_coat(), {waiver("coat/front 0°/energy")}, kToday);
  EXPECT_FALSE(report.ok());
  EXPECT_NE(report.summary().find("coat/front 80°/energy"), std::string::npos);
}

/// * stands for any text, also for none, wherever it is.
TEST(Waiver, NamesChecksByPatterns) {
  const auto names = [](const std::string& pattern) {
    const Report report =
        waive(Report({result("coat/energy", Verdict::fail)}), {waiver(pattern)}, kToday);
    return report.ok();
  };
  for (const char* pattern : {"coat/energy", "coat/energy*", "*coat/energy", "*", "coat*energy",
                              "coat*/*energy", "c*t/*y", "**"}) {
    EXPECT_TRUE(names(pattern)) << pattern;
  }
  for (const char* pattern :
       {"coat", "energy", "coat/energy/*", "*/coat/energy", "c*x*y", "coat/e"}) {
    EXPECT_FALSE(names(pattern)) << pattern;
  }
}

/// Why a waiver itself fails.
std::string complaint(const Waiver& w) {
  const Report report = waive(of_a_coat(), {w}, kToday);
  EXPECT_FALSE(report.ok());
  const CheckResult& last = report.results.back();
  EXPECT_EQ(last.subject, "waiver/" + w.check);
  EXPECT_EQ(last.verdict, Verdict::fail);
  return last.reason;
}

TEST(Waiver, FailsWhenItHasExpired) {
  EXPECT_EQ(complaint(waiver("coat/*/energy", 2026y / 11 / 29)),
            "expired on 2026-11-29: multiple scattering is missing");
}

TEST(Waiver, FailsWhenItIsNotNeeded) {
  EXPECT_EQ(complaint(waiver("coat/*/integral")), "what it waives passes: take it away");
  EXPECT_EQ(complaint(waiver("coat/back*")), "no check has the name that it states");
}

TEST(Waiver, DoesNotCountAControlThatFailsAsItMust) {
  Report report(result("control", Verdict::fail));
  report.results[0].expected = Verdict::fail;
  EXPECT_FALSE(waive(report, {waiver("control")}, kToday).ok());
}

TEST(Waiver, MustMakeSense) {
  const Report report = of_a_coat();
  EXPECT_THROW(waive(report, {{"", "why", kToday}}, kToday), std::invalid_argument);
  EXPECT_THROW(waive(report, {{"coat*", "", kToday}}, kToday), std::invalid_argument);
  EXPECT_THROW(waive(report, {waiver("coat*", 2026y / 2 / 30)}, kToday), std::invalid_argument);
}

TEST(Waiver, DaysReadLikeADate) {
  EXPECT_EQ(parse_day("2027-01-31"), 2027y / 1 / 31);
  EXPECT_EQ(parse_day("2028-02-29"), 2028y / 2 / 29);
  for (const char* text : {"2027-02-29", "2027-13-01", "2027-1-31", "31.01.2027", "2027-01-3x", "",
                           "+027-01-31", "2027-01-31 "}) {
    EXPECT_THROW(parse_day(text), std::invalid_argument) << text;
  }
  EXPECT_TRUE(today().ok());
}

}  // namespace
}  // namespace plumbline::verify
