#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include <plumbline/verify/mean.h>

#include "samplers.h"

namespace plumbline::verify {
namespace {

using tests::Bernoulli;
using tests::expect_verdict;
using tests::Exponential;
using tests::Lognormal;
using tests::Pareto;
using tests::sampler;

MeanOptions options(const char* subject, double reference, double tolerance = 0.005) {
  MeanOptions o;
  o.subject = subject;
  o.reference = reference;
  o.tolerance = tolerance;
  o.seed = tests::check_seed(subject);
  return o;
}

CheckResult run(const MeanOptions& o, auto distribution) {
  return check_mean(o, sampler(o.seed, distribution));
}

TEST(MeanCheck, ProvesTheBoundOfACorrectEstimator) {
  const CheckResult r = run(options("mean/exponential", 1), Exponential{});
  expect_verdict(r);
  EXPECT_LE(r.bound, 0.005);
  EXPECT_LE(r.interval->low, 1);
  EXPECT_GE(r.interval->high, 1);
  EXPECT_LE(r.samples, samples_to_decide(0.005, 1));
}

TEST(MeanCheck, FailsATenPercentErrorWithinTwentyThousandSamples) {
  // cv = 1.5 for both: √((1 − p)/p) and √(exp σ² − 1).
  MeanOptions hits = options("mean/ten percent off, hits", 1.1 * 0.3077);
  hits.expected = Verdict::fail;
  MeanOptions tail = options("mean/ten percent off, lognormal", 1.1);
  tail.expected = Verdict::fail;
  int hits_within = 0, tail_within = 0;
  constexpr int kRuns = 100;
  for (int i = 0; i < kRuns; ++i) {
    ++hits.seed;
    ++tail.seed;
    const CheckResult of_hits = run(hits, Bernoulli{0.3077});
    EXPECT_EQ(of_hits.verdict, Verdict::fail);
    hits_within += of_hits.samples <= 20'000u ? 1 : 0;
    const CheckResult of_tail = run(tail, Lognormal{1.08});
    EXPECT_EQ(of_tail.verdict, Verdict::fail);
    tail_within += of_tail.samples <= 20'000u ? 1 : 0;
  }
  // 20,000 samples put the answer 9.4 standard errors off, and a fail takes 6.9: one run of hits in
  // 160 (9 of 1,500) takes another look, and of the lognormal, which may show too large a sample
  // for the guard, one in eight (192 of 1,500). At the upper ends of both 99.9 % intervals, 1.6 %
  // and 16 %, more than 14 and 43 of 100 have a chance below 1e-10.
  EXPECT_GE(hits_within, kRuns - 14);
  EXPECT_GE(tail_within, kRuns - 43);
}

TEST(MeanCheck, FailsAProvenBiasBelowTheTolerance) {
  MeanOptions o = options("mean/bias below the tolerance", 1.0005, 0.1);
  o.expected = Verdict::fail;
  // The noise is so small that the bias is proven before the first look is over.
  const auto near_one = [](Random& r) { return 1 + 1e-3 * (r.uniform() - 0.5); };
  const CheckResult proven = run(o, near_one);
  expect_verdict(proven);
  // Who reads "tolerance 0.1" beside it is told why it fails all the same.
  EXPECT_NE(proven.reason.find("fails within the tolerance of 0.10005 too"), std::string::npos)
      << proven.reason;
  o.tolerance = 1e-4;
  EXPECT_EQ(run(o, near_one).reason.find("within the tolerance"), std::string::npos);
}

TEST(MeanCheck, AllowsWhatFloatRoundingDoes) {
  expect_verdict(run(options("mean/rounding", 1),
                     [](Random& r) { return 1 + 5e-6 + 1e-6 * (r.uniform() - 0.5); }));
}

TEST(MeanCheck, NeverPassesWithASampleThatIsNotFinite) {
  MeanOptions o = options("mean/one NaN", 1);
  o.expected = Verdict::fail;
  int drawn = 0;
  expect_verdict(run(o, [&drawn](Random& r) {
    return ++drawn == 1000 ? std::numeric_limits<double>::quiet_NaN() : 2 * r.uniform();
  }));
}

TEST(MeanCheck, IsUndecidedWhereFiniteSamplesOverflowItsSums) {
  // Squares of 1e300 are infinite. A correct estimator of such an answer is no failure.
  const CheckResult r =
      run(options("mean/huge", 1e300), [](Random& random) { return 2e300 * random.uniform(); });
  EXPECT_EQ(r.verdict, Verdict::inconclusive);
  EXPECT_EQ(r.reason,
            "the samples are finite, their sum or the squares of their deviations are not");
}

TEST(MeanCheck, TakesEqualSamplesForWhatTheyAre) {
  expect_verdict(run(options("mean/constant", 0.5), [](Random&) { return 0.5; }));
  MeanOptions wrong = options("mean/wrong constant", 0.5);
  wrong.expected = Verdict::fail;
  expect_verdict(run(wrong, [](Random&) { return 0.55; }));
}

TEST(MeanCheck, WaitsWhileNothingIsHitAndFailsWhenNothingEverIs) {
  MeanOptions o = options("mean/nothing hit yet", 1e-4);
  o.expected = Verdict::inconclusive;
  o.max_samples = 20'000;
  expect_verdict(run(o, [](Random&) { return 0.0; }));
  o = options("mean/never anything", 1e-4);
  o.expected = Verdict::fail;
  expect_verdict(run(o, [](Random&) { return 0.0; }));
  // With the variance known, zeros are improbable sooner: p = 0.01, and 0.99^5000 = 1e-22.
  o = options("mean/zeros against an exact variance", 0.01);
  o.exact_variance = 0.01 * 0.99;
  o.expected = Verdict::fail;
  const CheckResult r = run(o, [](Random&) { return 0.0; });
  expect_verdict(r);
  EXPECT_LE(r.samples, 5000u);
}

TEST(MeanCheck, WaitsWhileAllSamplesMissTheLargerPartOfTheAnswer) {
  // A sky of mean ½ and a sun that one sample in 100,000 hits: the answer is 10.5.
  const auto sky_and_sun = [](Random& r) { return r.uniform() < 1e-5 ? 1e6 : r.uniform(); };
  MeanOptions o = options("mean/sun not hit yet", 10.5);
  o.expected = Verdict::inconclusive;
  o.max_samples = 1 << 18;
  for (int i = 0; i < 20; ++i, ++o.seed) expect_verdict(run(o, sky_and_sun));
  // A constant sky proves no more.
  const auto flat_sky = [](Random& r) { return r.uniform() < 1e-5 ? 1e6 : 0.5; };
  o.subject = "mean/sun not hit yet, constant sky";
  for (int i = 0; i < 20; ++i, ++o.seed) expect_verdict(run(o, flat_sky));
  // Half of the answer in each of two techniques, of which one has been seen.
  o = options("mean/half not hit yet", 1);
  o.expected = Verdict::inconclusive;
  o.max_samples = 1 << 18;
  const auto half_seen = [](Random& r) {
    return r.uniform() < 1e-7 ? 5e6 : 0.5 + 1e-5 * r.uniform();
  };
  for (int i = 0; i < 20; ++i, ++o.seed) expect_verdict(run(o, half_seen));
  // Without a sun a million samples show it, and a smaller part is missed at once.
  o = options("mean/no sun", 10.5);
  o.expected = Verdict::fail;
  expect_verdict(run(o, [](Random& r) { return r.uniform(); }));
  o = options("mean/ten percent below, all samples", 1);
  o.expected = Verdict::fail;
  const CheckResult r = run(o, [](Random& random) { return 0.85 + 0.1 * random.uniform(); });
  expect_verdict(r);
  EXPECT_LE(r.samples, 20'000u);
}

TEST(MeanCheck, ProvesDarknessWithAnAbsoluteTolerance) {
  MeanOptions o = options("mean/dark", 0, 1e-6);
  o.relative = false;
  expect_verdict(run(o, [](Random&) { return 0.0; }));
}

TEST(MeanCheck, PassesEqualSamplesOfWhichOneInMillionsIsRejected) {
  // The third sample is, and no other for a while: skewness of one in n falls as its root.
  const auto rejects_one = [](const MeanOptions& o) {
    return check_mean(o, [](std::uint64_t first, std::uint64_t count) {
      Moments moments;
      for (std::uint64_t i = first; i < first + count; ++i) moments.add(i == 2 ? 0.0 : 0.5);
      return moments;
    });
  };
  MeanOptions o = options("mean/one rejected", 0.5);
  const CheckResult r = rejects_one(o);
  expect_verdict(r);
  EXPECT_LT(r.samples, 20'000u);
  EXPECT_EQ(r.leaned_on, "samples that deviate no more than rejected ones");
  // What is off by more than the samples are large is no rejection, and left to the skewness guard.
  MeanOptions bright = options("mean/one bright", 0.5);
  bright.max_samples = 1 << 20;
  bright.expected = Verdict::inconclusive;
  expect_verdict(check_mean(bright, [](std::uint64_t first, std::uint64_t count) {
    Moments moments;
    for (std::uint64_t i = first; i < first + count; ++i) moments.add(i == 2 ? 1.25 : 0.5);
    return moments;
  }));
  // Rejected ones that are a bias are still none that passes.
  MeanOptions biased = options("control/two in a hundred rejected", 0.5);
  biased.expected = Verdict::fail;
  expect_verdict(run(biased, [](Random& random) { return random.uniform() < 0.02 ? 0.0 : 0.5; }));
}

TEST(MeanCheck, DoesNotPassWhatItCannotProve) {
  MeanOptions o = options("mean/too few samples", 1, 0.001);
  o.max_samples = 100'000;
  o.expected = Verdict::inconclusive;
  const CheckResult r = run(o, Exponential{});
  expect_verdict(r);
  EXPECT_FALSE(r.reason.empty());
  EXPECT_GT(r.bound, 0.001);
}

/// Enough samples at the first look for the tail to show its index. Fewer than 100,000 say too
/// little about it: of 400 runs with an index of 1.6 (1.8) five (71) passed before, and rightly,
/// since none of 400 passed with a bias of the tolerance. The limit at index a is a + (r ± 2) e
/// with a standard normal r and e ≈ 1.1 a/√k of the k ≥ n/1000 largest: for a = 1.6 it exceeds 2
/// where r > 7, once in 1e12.
constexpr std::uint64_t kShowsItsTail = 1 << 19;

TEST(MeanCheck, RefusesToCertifyInfiniteVariance) {
  MeanOptions o = options("mean/infinite variance", 1, 0.2);
  o.n0 = kShowsItsTail;
  o.max_samples = 1 << 21;
  o.expected = Verdict::inconclusive;
  expect_verdict(run(o, Pareto{1.6}));
  // Also where the closed form says so and the samples do not show it.
  o = options("mean/variance known to be infinite", 1, 0.05);
  o.max_samples = 100'000;
  o.exact_variance = std::numeric_limits<double>::infinity();
  o.expected = Verdict::inconclusive;
  expect_verdict(run(o, Exponential{}));
}

TEST(MeanCheck, DoubtsAnExactVarianceThatTheSamplesDoNotShow) {
  MeanOptions o = options("mean/unseen tail", 1, 0.05);
  o.exact_variance = 100;
  o.max_samples = 1 << 20;
  o.expected = Verdict::inconclusive;
  const CheckResult r = run(o, Exponential{});
  expect_verdict(r);
  EXPECT_NE(r.reason.find("exact variance"), std::string::npos) << r.reason;
}

TEST(MeanCheck, ExactVarianceSettlesARareEvent) {
  MeanOptions o = options("mean/rare event with exact variance", 1e-3, 0.05);
  o.exact_variance = 1e-3 * (1 - 1e-3);
  const CheckResult r = run(o, Bernoulli{1e-3});
  expect_verdict(r);
  EXPECT_EQ(r.leaned_on, "exact variance");
}

TEST(MeanCheck, RefusesQuestionsThatMakeNoSense) {
  EXPECT_THROW(MeanCheck(options("m", 0)), std::invalid_argument);
  EXPECT_THROW(MeanCheck(options("m", 1, 0)), std::invalid_argument);
  EXPECT_THROW(MeanCheck(options("m", std::nan(""))), std::invalid_argument);
}

TEST(MeanCheck, PushedAndPulledSamplesGiveTheSameResult) {
  const MeanOptions o = options("mean/pushed", 1);
  const CheckResult pulled = run(o, Exponential{});
  MeanCheck check(o);
  const MomentSampler draw = sampler(o.seed, Exponential{});
  while (!check.done()) check.add(draw(0, check.samples_wanted()));
  EXPECT_EQ(check.result().estimate, pulled.estimate);
  EXPECT_EQ(check.result().bound, pulled.bound);
}

TEST(Agreement, ProvenForTheSameMeanWithDifferentVariance) {
  const MeanOptions o = options("agreement/same mean", 0);
  expect_verdict(check_agreement(o, sampler(o.seed, Exponential{}),
                                 sampler(o.seed + 1, [](Random& r) { return 2 * r.uniform(); })));
}

TEST(Agreement, FailsWhereOneIsOff) {
  MeanOptions o = options("agreement/two percent off", 0);
  o.expected = Verdict::fail;
  expect_verdict(
      check_agreement(o, sampler(o.seed, Exponential{}),
                      sampler(o.seed + 1, [](Random& r) { return 2.04 * r.uniform(); })));
}

TEST(Agreement, NeverPassesWhereAsManySamplesOfBothAreNotFinite) {
  MeanOptions o = options("agreement/a NaN each", 0);
  o.expected = Verdict::fail;
  const auto with_one_nan = [](std::uint64_t seed) {
    return sampler(seed, [drawn = 0](Random& r) mutable {
      return ++drawn == 1000 ? std::numeric_limits<double>::quiet_NaN() : 2 * r.uniform();
    });
  };
  expect_verdict(check_agreement(o, with_one_nan(o.seed), with_one_nan(o.seed + 1)));
}

TEST(Agreement, InconclusiveWhereATailDecides) {
  MeanOptions o = options("agreement/heavy tail", 0, 0.2);
  o.n0 = kShowsItsTail;
  o.max_samples = 1 << 20;
  o.expected = Verdict::inconclusive;
  expect_verdict(
      check_agreement(o, sampler(o.seed, Exponential{}), sampler(o.seed + 1, Pareto{1.5})));
}

/// About 1 with a spread of 0.0015, and rejected once in 5,000 times: what metal loses below the
/// horizon. Until the first rejection the others agree on too much.
struct SeldomRejected {
  double operator()(Random& random) const {
    if (random.uniform() < 2e-4) return 0;
    return 1 + 0.0015 * (random.uniform() + random.uniform() + random.uniform() - 1.5) * 2;
  }
};

CheckResult seldom_rejected(std::uint64_t seed, double reference) {
  MeanOptions options;
  options.subject = "seldom rejected";
  options.reference = reference;
  options.tolerance = 0.005;
  return check_mean(options, tests::sampler(seed, SeldomRejected{}));
}

TEST(MeanCheck, ARejectionThatHasNotBeenSeenIsNoDifference) {
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    EXPECT_EQ(seldom_rejected(seed, 1 - 2e-4).verdict, Verdict::pass) << seed;
}

TEST(MeanCheck, OneThatIsTooCommonToBeUnseenStillIs) {
  // Three in a thousand that the answer holds and no sample shows, and one in a hundred.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_NE(seldom_rejected(seed, 0.9897).verdict, Verdict::pass) << seed;
    EXPECT_EQ(seldom_rejected(seed, 0.9798).verdict, Verdict::fail) << seed;
  }
}

}  // namespace
}  // namespace plumbline::verify
