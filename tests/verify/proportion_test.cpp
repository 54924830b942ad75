#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <stdexcept>

#include <plumbline/verify/ratio.h>

namespace plumbline::verify {
namespace {

using tests::expect_verdict;

ProportionOptions claim(const char* subject, double at_least, double at_most,
                        Verdict expected = Verdict::pass) {
  ProportionOptions o;
  o.subject = subject;
  o.at_least = at_least;
  o.at_most = at_most;
  o.expected = expected;
  return o;
}

TEST(Proportion, IntervalIsThatOfClopperAndPearson) {
  // No hit in n: the upper limit solves (1 − p)^n = 0.0005.
  const CheckResult none = check_proportion(claim("proportion/none", 0, 1), 0, 100);
  EXPECT_EQ(none.interval->low, 0);
  EXPECT_NEAR(none.interval->high, 1 - std::pow(0.0005, 0.01), 1e-12);
  const CheckResult all = check_proportion(claim("proportion/all", 0, 1), 100, 100);
  EXPECT_NEAR(all.interval->low, std::pow(0.0005, 0.01), 1e-12);
  EXPECT_EQ(all.interval->high, 1);
}

TEST(Proportion, PassesWhatIsProvenAndFailsWhatIsDisproven) {
  expect_verdict(check_proportion(claim("proportion/half", 0.4, 0.6), 5'000, 10'000));
  expect_verdict(
      check_proportion(claim("proportion/too many", 0, 0.4, Verdict::fail), 5'000, 10'000));
  expect_verdict(
      check_proportion(claim("proportion/too few", 0.6, 1, Verdict::fail), 5'000, 10'000));
  expect_verdict(check_proportion(
      claim("proportion/too close to say", 0.5, 1, Verdict::inconclusive), 5'000, 10'000));
}

TEST(Proportion, PValueIsThatOfTheBrokenEdge) {
  // P(X ≥ 3 | n = 3, p = ½) = 1/8, two-sided.
  EXPECT_NEAR(check_proportion(claim("p", 0, 0.5), 3, 3).p_value.value(), 0.25, 1e-12);
  EXPECT_NEAR(check_proportion(claim("p", 0.5, 1), 0, 3).p_value.value(), 0.25, 1e-12);
  EXPECT_EQ(check_proportion(claim("p", 0, 1), 2, 3).p_value, 1);
}

TEST(Proportion, RefusesCountsAndClaimsThatMakeNoSense) {
  EXPECT_THROW(check_proportion(claim("p", 0, 1), 0, 0), std::invalid_argument);
  EXPECT_THROW(check_proportion(claim("p", 0, 1), 2, 1), std::invalid_argument);
  EXPECT_THROW(check_proportion(claim("p", 0.6, 0.4), 1, 2), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::verify
