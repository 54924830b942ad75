#include <gtest/gtest.h>

#include <plumbline/verify/detail/result.h>

namespace plumbline::verify {
namespace {

TEST(Result, DescriptionSaysWhatAPersonNeeds) {
  CheckResult r;
  r.check = "mean";
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
  r.figures = {{"degrees of freedom", 63}};
  const std::string text = describe(r);
  for (const char* part :
       {"furnace_sphere/mis", "fail", "expected pass", "1.02", "0.03", "0.005", "20000",
        "9 standard errors", "= π", "42", "ctest -R furnace", "degrees of freedom", "63"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " missing in:\n" << text;
  }
  EXPECT_EQ(text.find("nan"), std::string::npos) << "unused fields are not shown";
}

TEST(Result, AnExpectedFailureIsAsExpected) {
  CheckResult r;
  r.verdict = r.expected = Verdict::fail;
  EXPECT_TRUE(r.as_expected());
  EXPECT_NE(describe(r).find("as expected"), std::string::npos);
}

}  // namespace
}  // namespace plumbline::verify
