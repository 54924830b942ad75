#include <gtest/gtest.h>

#include <set>
#include <string>

#include <plumbline/verify/detail/result.h>

namespace plumbline::verify {
namespace {

TEST(Result, DescriptionSaysWhatAPersonNeeds) {
  CheckResult r;
  r.kind = CheckKind::mean;
  r.subject = "furnace_sphere/mis";
  r.verdict = Verdict::fail;
  r.estimate = 1.02;
  r.reference = 1;
  r.bound = 0.03;
  r.tolerance = 0.005;
  r.samples = 20'000;
  r.reason = "estimate 1.02 is 9 standard errors from the answer 1";
  r.diagnosis = "observed/expected = π";
  r.seed = 42;
  r.replay = "ctest -R furnace";
  r.figures = {{Figure::degrees_of_freedom, 63}};
  const std::string text = describe(r);
  for (const char* part :
       {"furnace_sphere/mis", "fail", "expected pass", "1.02", "0.03", "0.005", "20000",
        "9 standard errors", "= π", "42", "ctest -R furnace", "degrees of freedom", "63"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " missing in:\n" << text;
  }
  EXPECT_EQ(text.find("nan"), std::string::npos) << "unused fields are not shown";
}

TEST(Result, AnExpectedFailureIsAsExpectedAndNotOk) {
  CheckResult r;
  r.verdict = r.expected = Verdict::fail;
  EXPECT_TRUE(r.as_expected());
  EXPECT_FALSE(r.ok());
  EXPECT_NE(describe(r).find("as expected"), std::string::npos);
}

TEST(Result, KindsAndFiguresHaveOneWordEach) {
  std::set<std::string_view> words;
  for (int i = 0; i <= static_cast<int>(CheckKind::variance); ++i) {
    const auto kind = static_cast<CheckKind>(i);
    EXPECT_TRUE(words.insert(to_string(kind)).second) << to_string(kind);
    EXPECT_EQ(check_kind(to_string(kind)), kind);
  }
  EXPECT_EQ(to_string(CheckKind::variance_ratio), "variance_ratio");
  EXPECT_EQ(check_kind("guess"), std::nullopt);
  words.clear();
  for (int i = 0; i <= static_cast<int>(Figure::albedo_of_atoms); ++i) {
    const auto figure = static_cast<Figure>(i);
    EXPECT_TRUE(words.insert(to_string(figure)).second) << to_string(figure);
    EXPECT_EQ(FigureValue(to_string(figure), 1).figure, figure);
  }
  EXPECT_FALSE(words.contains("?"));
}

TEST(Result, EveryCauseHasAHeading) {
  std::set<std::string_view> words;
  for (int i = 0; i <= static_cast<int>(CauseKind::stale_state); ++i) {
    EXPECT_TRUE(words.insert(to_string(static_cast<CauseKind>(i))).second) << i;
  }
  EXPECT_FALSE(words.contains("?"));
}

TEST(Result, FiguresAreFoundByWhatTheyAreAndKeepTheirOrder) {
  CheckResult r;
  r.figures = {{"my own", 1}, {Figure::bins, 64}, {"atoms", 2}};
  EXPECT_EQ(r.figure(Figure::bins), 64);
  EXPECT_EQ(r.figure(Figure::atoms), 2) << "a name in use is that figure";
  EXPECT_EQ(r.figure(Figure::rounding), std::nullopt);
  EXPECT_EQ(r.figures[0].name(), "my own");
  const std::string text = describe(r);
  EXPECT_LT(text.find("my own"), text.find("bins"));
}

}  // namespace
}  // namespace plumbline::verify
