#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <stdexcept>
#include <vector>

#include <plumbline/verify/ratio.h>

#include "samplers.h"

namespace plumbline::verify {
namespace {

using tests::expect_verdict;
using tests::sampler;

std::vector<Moments> batches(std::uint64_t seed, auto distribution, int count = 64,
                             std::uint64_t size = 2000) {
  const MomentSampler draw = sampler(seed, distribution);
  std::vector<Moments> result;
  for (int i = 0; i < count; ++i) result.push_back(draw(0, size));
  return result;
}

VarianceRatioOptions ratio_options(const char* subject) {
  VarianceRatioOptions o;
  o.subject = subject;
  o.seed = tests::check_seed(subject);
  return o;
}

/// Mean 1, variance (scale)².
auto scaled(double scale) {
  return [scale](Random& r) { return 1 + scale * (tests::Exponential{}(r)-1); };
}

TEST(VarianceRatio, KeepsATrueClaim) {
  VarianceRatioOptions o = ratio_options("ratio/true claim");
  o.at_least = 3;
  const CheckResult r =
      check_variance_ratio(o, batches(o.seed, scaled(2)), batches(o.seed + 1, scaled(1)));
  expect_verdict(r);
  EXPECT_LE(r.interval->low, 4);
  EXPECT_GE(r.interval->high, 4);
}

TEST(VarianceRatio, BreaksAFalseClaim) {
  VarianceRatioOptions o = ratio_options("ratio/false claim");
  o.at_least = 6;
  o.expected = Verdict::fail;
  expect_verdict(
      check_variance_ratio(o, batches(o.seed, scaled(2)), batches(o.seed + 1, scaled(1))));
  o = ratio_options("ratio/false claim from above");
  o.at_most = 2;
  o.expected = Verdict::fail;
  expect_verdict(
      check_variance_ratio(o, batches(o.seed, scaled(2)), batches(o.seed + 1, scaled(1))));
}

TEST(VarianceRatio, SaysSoWhenItCannotTell) {
  VarianceRatioOptions o = ratio_options("ratio/straddles");
  o.at_least = 1;
  o.expected = Verdict::inconclusive;
  expect_verdict(
      check_variance_ratio(o, batches(o.seed, scaled(1)), batches(o.seed + 1, scaled(1))));
}

TEST(VarianceRatio, RefusesToJudgeATail) {
  // One sample that no other is like, in one batch. (Drawn from a Pareto distribution of index 1.2,
  // the largest batch carries less than a quarter in one run of a few dozen.)
  VarianceRatioOptions o = ratio_options("ratio/one sample decides");
  o.at_least = 1;
  o.expected = Verdict::inconclusive;
  auto a = batches(o.seed, scaled(1));
  a.front().add(1e3);
  const CheckResult r = check_variance_ratio(o, a, batches(o.seed + 1, scaled(0.1)));
  expect_verdict(r);
  EXPECT_NE(r.reason.find("its tail decides"), std::string::npos) << r.reason;
}

TEST(VarianceRatio, SharedSeedsNarrowTheInterval) {
  VarianceRatioOptions o = ratio_options("ratio/paired");
  const auto a = batches(o.seed, scaled(1.1));
  const CheckResult paired = check_variance_ratio(o, a, batches(o.seed, scaled(1)));
  const CheckResult apart = check_variance_ratio(o, a, batches(o.seed + 1, scaled(1)));
  EXPECT_LT(paired.interval->high - paired.interval->low,
            0.2 * (apart.interval->high - apart.interval->low));
  EXPECT_NEAR(*paired.estimate, 1.21, 1e-9);
}

TEST(VarianceRatio, OfTheSameRunIsExactlyOne) {
  VarianceRatioOptions o = ratio_options("ratio/the same run");
  o.at_least = o.at_most = 1;
  const auto a = batches(o.seed, scaled(1));
  const CheckResult r = check_variance_ratio(o, a, a);
  expect_verdict(r);
  EXPECT_EQ(r.estimate, 1);
}

TEST(VarianceRatio, RefusesTooFewBatches) {
  const auto a = batches(1, scaled(1), 15);
  EXPECT_THROW(check_variance_ratio(ratio_options("r"), a, a), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::verify
