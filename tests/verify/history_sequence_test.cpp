#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include <plumbline/verify/detail/moments.h>
#include <plumbline/verify/history/confidence_sequence.h>
#include <plumbline/verify/ratio.h>

#include "distributions.h"
#include "history_lifetimes.h"
#include "history_noise.h"

namespace plumbline::verify::history {
namespace {

constexpr int kNights = 30;
constexpr std::uint64_t kBatchesANight = 64;

double exponential(Random& random) { return -std::log1p(-random.uniform()) - 1; }

/// A night of batch means with mean `bias` and standard deviation 1.
template <class Noise>
BatchMoments night_of(Random& random, double bias, Noise noise) {
  BatchMoments night;
  for (std::uint64_t i = 0; i < kBatchesANight; ++i) night.add(bias + noise(random), 1000);
  return night;
}

/// Whether a sequence of batches around the right answer ever fails.
template <class Noise>
bool ever_fails(Random& random, double level, Noise noise) {
  MeanSequence sequence;
  MeanSequenceOptions options;
  options.tolerance = 1e-9;
  options.budget = inflated(level);
  for (int night = 0; night < kNights; ++night) {
    sequence.add_night("code", night_of(random, 0, noise));
    if (judge_sequence(sequence, options).verdict == Verdict::fail) return true;
  }
  return false;
}

TEST(MixtureReach, IsLeastAtItsTarget) {
  // At the target x = ln(x + 1) − 2 ln level, which makes the reach √(x + 1): for 0.05 x = 8.2120.
  EXPECT_NEAR(mixture_reach(100, 100, 0.05), std::sqrt(9.2120), 1e-4);
  EXPECT_NEAR(mixture_reach(1920, 1920, 1e-12), 7.77, 0.005);
  EXPECT_NEAR(mixture_reach(64, 1920, 1e-12), 9.21, 0.005);
  const double width = mixture_reach(100, 100, 0.05) / 10;
  for (const double target : {20.0, 80.0, 125.0, 500.0}) {
    EXPECT_GT(mixture_reach(100, target, 0.05) / 10, width) << target;
  }
  EXPECT_GT(mixture_reach(1, 100, 0.05), 1.96);
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(mixture_reach(bad, 1, 0.5), std::invalid_argument);
    EXPECT_THROW(mixture_reach(1, bad, 0.5), std::invalid_argument);
    EXPECT_THROW(mixture_reach(1, 1, bad), std::invalid_argument);
  }
  EXPECT_THROW(mixture_reach(1, 1, 1), std::invalid_argument);
}

TEST(SequenceBudget, IsSplitOverLifeAndOverTheYear) {
  EXPECT_DOUBLE_EQ(SequenceBudget{}.fail_level(), 1e-12);
  EXPECT_DOUBLE_EQ(night_budget().suite_level, 1e-4 / 365);
  EXPECT_DOUBLE_EQ(night_budget().fail_level(), 1e-10 / 365);
}

TEST(BatchMoments, MergeToWhatAllTogetherAre) {
  Random random(7);
  BatchMoments all, first, second;
  Moments same;
  for (int i = 0; i < 100; ++i) {
    const double x = exponential(random);
    all.add(x, 10);
    same.add(x);
    (i < 30 ? first : second).add(x, 10);
  }
  first.merge(second);
  EXPECT_EQ(first.batches, 100u);
  EXPECT_EQ(all.batches, 100u);
  EXPECT_NEAR(first.mean, same.mean(), 1e-14);
  EXPECT_NEAR(first.m2, same.m2(), 1e-12);
  EXPECT_NEAR(first.m3, same.m3(), 1e-11);
  EXPECT_NEAR(all.m3, same.m3(), 1e-11);
  EXPECT_EQ(first.smallest, same.smallest());
  EXPECT_EQ(first.largest, same.largest());
  BatchMoments other;
  other.add(1, 11);
  EXPECT_THROW(first.merge(other), std::invalid_argument);
  EXPECT_THROW(first.add(1, 11), std::invalid_argument);
  const BatchMoments before = first;
  first.merge({});
  EXPECT_EQ(first, before);
  first.add(std::nan(""), 10);
  EXPECT_EQ(first.non_finite, 1u);
  EXPECT_EQ(first.batches, 100u);
}

TEST(MeanSequence, ABiasTooSmallForOneNightIsFoundAfterThirty) {
  // 0.3 standard deviations of a batch are 2.4 standard errors of a night (7.3 are needed there)
  // and 13 of thirty (7.9 are needed).
  Random random(tests::check_seed("history/bias of thirty nights"));
  MeanSequence sequence;
  MeanSequenceOptions options;
  options.tolerance = 0.01;
  double width = std::numeric_limits<double>::infinity();
  for (int night = 1; night <= kNights; ++night) {
    const BatchMoments batches = night_of(random, 0.3, normal);
    sequence.add_night("code", batches);
    MeanSequence alone;
    alone.add_night("code", batches);
    EXPECT_NE(judge_sequence(alone, options).verdict, Verdict::fail) << night;
    if (night == 1 || night == 10 || night == kNights) {
      // What is proven beyond the estimate, which is itself as likely to rise as to fall.
      const CheckResult so_far = judge_sequence(sequence, options);
      const double here = *so_far.bound - std::abs(*so_far.estimate);
      EXPECT_LT(here, width) << night;
      width = here;
    }
  }
  const CheckResult r = judge_sequence(sequence, options);
  EXPECT_EQ(r.verdict, Verdict::fail);
  EXPECT_LT(*r.p_value, 1e-12);
  EXPECT_EQ(r.samples, 1'920'000u);
}

TEST(MeanSequence, ProvesAToleranceThatOneNightCannot) {
  // Thirty nights: 4.2 of their standard errors, of 0.0228, are proven, and as much again is noise.
  Random random(tests::check_seed("history/tolerance of thirty nights"));
  MeanSequence sequence;
  MeanSequenceOptions options;
  options.tolerance = 0.25;
  for (int night = 1; night <= kNights; ++night) {
    sequence.add_night("code", night_of(random, 0, normal));
    if (night == 1) {
      EXPECT_EQ(judge_sequence(sequence, options).verdict, Verdict::inconclusive);
    }
  }
  const CheckResult r = judge_sequence(sequence, options);
  EXPECT_EQ(r.verdict, Verdict::pass);
  EXPECT_LE(*r.bound, 0.25);
  EXPECT_EQ(r.kind, CheckKind::mean);
}

TEST(MeanSequence, StartsAgainWithOtherCodeOrOtherBatches) {
  Random random(3);
  MeanSequence sequence;
  const BatchMoments night = night_of(random, 0, normal);
  EXPECT_TRUE(sequence.add_night("a", night));
  EXPECT_FALSE(sequence.add_night("a", night));
  EXPECT_EQ(sequence.nights, 2u);
  EXPECT_EQ(sequence.all.batches, 2 * kBatchesANight);
  EXPECT_TRUE(sequence.add_night("b", night));
  EXPECT_EQ(sequence.nights, 1u);
  EXPECT_EQ(sequence.all, night);
  EXPECT_EQ(sequence.code, "b");
  BatchMoments larger;
  larger.add(1, 2000);
  EXPECT_TRUE(sequence.add_night("b", larger));
  EXPECT_EQ(sequence.all, larger);
}

TEST(MeanSequence, SaysNothingTooEarly) {
  Random random(4);
  const auto judged = [](const MeanSequence& sequence, double target = 1920) {
    MeanSequenceOptions options;
    options.reference = 100;  // far off
    options.target_batches = target;
    return judge_sequence(sequence, options);
  };
  MeanSequence sequence;
  EXPECT_EQ(judged(sequence).verdict, Verdict::inconclusive);
  EXPECT_FALSE(judged(sequence).bound);
  BatchMoments few;
  for (int i = 0; i < 63; ++i) few.add(normal(random), 1000);
  sequence.add_night("a", few);
  EXPECT_EQ(judged(sequence).verdict, Verdict::inconclusive);
  BatchMoments one;
  one.add(normal(random), 1000);
  sequence.add_night("a", one);
  EXPECT_EQ(judged(sequence).verdict, Verdict::fail);
  EXPECT_EQ(judged(sequence, 64 * 65).verdict, Verdict::inconclusive);
  MeanSequence equal;
  for (int i = 0; i < 100; ++i) equal.add_night("a", one);
  EXPECT_EQ(judged(equal).verdict, Verdict::inconclusive);
  EXPECT_THROW(judged(sequence, 0), std::invalid_argument);
}

TEST(MeanSequence, ASingleBatchThatCarriesTheSumIsNoBias) {
  Random random(5);
  BatchMoments night;
  for (int i = 0; i < 1000; ++i) night.add(normal(random) + (i == 500 ? 1000 : 0), 1000);
  MeanSequence sequence;
  sequence.add_night("a", night);
  EXPECT_EQ(judge_sequence(sequence, {}).verdict, Verdict::inconclusive);
}

TEST(MeanSequence, ABatchThatIsNotFiniteFails) {
  BatchMoments night;
  night.add(std::nan(""), 1000);
  MeanSequence sequence;
  sequence.add_night("a", night);
  EXPECT_EQ(judge_sequence(sequence, {}).verdict, Verdict::fail);
}

TEST(MeanSequence, SeldomFailsInALifetimeOfCorrectCode) {
  tests::expect_verdict(
      share_of_lifetimes("history/lifetimes/normal", 1000, 0, 0.05, Verdict::pass,
                         [](Random& random) { return ever_fails(random, 0.05, normal); }));
  tests::expect_verdict(
      share_of_lifetimes("history/lifetimes/exponential", 1000, 0, 0.05, Verdict::pass,
                         [](Random& random) { return ever_fails(random, 0.05, exponential); }));
}

TEST(MeanSequence, TestsThatLookEveryNightAtTheSameLevelFailTooOften) {
  tests::expect_verdict(share_of_lifetimes(
      "history/lifetimes/same level every night", 1000, 0, 0.05, Verdict::fail, [](Random& random) {
        BatchMoments all;
        for (int night = 0; night < kNights; ++night) {
          all.merge(night_of(random, 0, normal));
          const double n = static_cast<double>(all.batches);
          const double z = std::abs(all.mean) * std::sqrt(n * (n - 1) / all.m2);
          if (2 * normal_tail(z) < 0.05) return true;
        }
        return false;
      }));
}

/// A night's logarithm of a ratio, whose error is known as from the jackknife over 32 batches.
void add_ratio(Random& random, double log_ratio, RatioSequence& sequence) {
  constexpr double kError = 0.1;
  double squares = 0;
  for (int i = 0; i < 31; ++i) squares += std::pow(normal(random), 2) / 31;
  sequence.add_night("code", log_ratio + kError * normal(random), kError * std::sqrt(squares), 32);
}

TEST(RatioSequence, KeepsATrueClaimInAllLifetimes) {
  tests::expect_verdict(share_of_lifetimes(
      "history/lifetimes/ratio", 1000, 0, 0.05, Verdict::pass, [](Random& random) {
        RatioSequence sequence;
        RatioSequenceOptions options;
        options.budget = inflated(0.05);
        options.claim.at_least = options.claim.at_most = 2;
        for (int night = 0; night < kNights; ++night) {
          add_ratio(random, std::log(2), sequence);
          if (judge_sequence(sequence, options).verdict == Verdict::fail) return true;
        }
        return false;
      }));
}

TEST(RatioSequence, ALossTooSmallForOneNightIsFoundAfterThirty) {
  // A quarter of the ratio is lost: 2.9 standard errors of a night, 16 of thirty.
  Random random(tests::check_seed("history/ratio of thirty nights"));
  RatioSequence sequence;
  RatioSequenceOptions options;
  options.claim.at_least = 2;
  EXPECT_EQ(judge_sequence(sequence, options).verdict, Verdict::inconclusive);
  for (int night = 1; night <= kNights; ++night) {
    add_ratio(random, std::log(1.5), sequence);
    if (night == 1) {
      EXPECT_EQ(judge_sequence(sequence, options).verdict, Verdict::inconclusive);
    }
  }
  EXPECT_EQ(judge_sequence(sequence, options).verdict, Verdict::fail);
  EXPECT_GT(judge_sequence(sequence, options).interval->high, 1.5);
  options.claim.at_least = 1.2;
  EXPECT_EQ(judge_sequence(sequence, options).verdict, Verdict::pass);
  EXPECT_TRUE(sequence.add_night("other code", 0, 0.1, 32));
  EXPECT_EQ(sequence.nights, 1u);
  EXPECT_EQ(sequence.degrees, 31);
}

TEST(RatioSequence, NightsThatScatterMoreThanTheySayWidenTheInterval) {
  RatioSequence quiet, loud;
  for (int night = 0; night < 20; ++night) {
    quiet.add_night("a", 0.01 * (night % 2), 0.01, 32);
    loud.add_night("a", 1.0 * (night % 2), 0.01, 32);
  }
  const double quiet_error = *judge_sequence(quiet, {}).figure(Figure::standard_error);
  EXPECT_NEAR(quiet_error, 0.01 / std::sqrt(20), 1e-12);
  // Half of the logarithms 0, half 1: variance 5/19.
  const double loud_error = *judge_sequence(loud, {}).figure(Figure::standard_error);
  EXPECT_NEAR(loud_error, std::sqrt(5.0 / 19 / 20), 1e-12);
}

TEST(RatioSequence, RefusesNightsThatSayNothing) {
  RatioSequence sequence;
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_THROW(sequence.add_night("a", infinite, 0.1, 32), std::invalid_argument);
  EXPECT_THROW(sequence.add_night("a", 0, infinite, 32), std::invalid_argument);
  EXPECT_THROW(sequence.add_night("a", 0, -0.1, 32), std::invalid_argument);
  EXPECT_THROW(sequence.add_night("a", 0, 0.1, 1), std::invalid_argument);
  EXPECT_EQ(sequence, RatioSequence{});
}

TEST(TestSequence, EvidenceOfOneAndOfManyNightsIsTheIntegral) {
  TestSequence sequence;
  EXPECT_NEAR(sequence.log_evidence(), 0, 1e-15);
  // One night: (1 − p + p ln p)/(p ln² p), Vovk and Wang 2021.
  const double p = 0.01, log_p = std::log(p);
  EXPECT_TRUE(sequence.add_night("a", p));
  EXPECT_NEAR(sequence.log_evidence(), std::log((1 - p + p * log_p) / (p * log_p * log_p)), 1e-12);
  // Many: Simpson's rule over κ.
  for (int night = 1; night < 20; ++night) sequence.add_night("a", 0.02 + 0.04 * night);
  double sum = 0;
  constexpr int kSteps = 2000;
  for (int i = 0; i <= kSteps; ++i) {
    const double kappa = static_cast<double>(i) / kSteps;
    const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight / (3.0 * kSteps) * std::pow(kappa, 20) *
           std::exp((1 - kappa) * sequence.minus_log_p);
  }
  EXPECT_NEAR(sequence.log_evidence(), std::log(sum), 1e-9);
  // Large sums do not overflow: e^(10000) 1!/10000² for one night.
  TestSequence large;
  large.nights = 1;
  large.minus_log_p = 10'000;
  EXPECT_NEAR(large.log_evidence(), 10'000 - 2 * std::log(10'000.0), 1e-6);
}

TEST(TestSequence, SeldomRefutesWhatIsTrueInALifetime) {
  tests::expect_verdict(share_of_lifetimes(
      "history/lifetimes/uniform p-values", 1000, 0, 0.05, Verdict::pass, [](Random& random) {
        TestSequence sequence;
        for (int night = 0; night < 365; ++night) {
          sequence.add_night("code", 1 - random.uniform());
          if (judge_sequence(sequence, "null", inflated(0.03)).verdict == Verdict::fail)
            return true;
        }
        return false;
      }));
}

TEST(TestSequence, AnErrorTooSmallForOneNightIsFoundAfterThirty) {
  // 2.5 standard errors each night, where 7.3 are needed.
  Random random(tests::check_seed("history/tests of thirty nights"));
  TestSequence sequence;
  for (int night = 1; night <= kNights; ++night) {
    sequence.add_night("code", std::min(1.0, 2 * normal_tail(std::abs(2.5 + normal(random)))));
    if (night == 1) {
      EXPECT_NE(judge_sequence(sequence, "density").verdict, Verdict::fail);
    }
  }
  const CheckResult r = judge_sequence(sequence, "density");
  EXPECT_EQ(r.verdict, Verdict::fail);
  EXPECT_EQ(r.kind, CheckKind::chi_square);
  EXPECT_LT(*r.p_value, 1e-12);
  EXPECT_TRUE(sequence.add_night("other", 1));
  EXPECT_EQ(judge_sequence(sequence, "density").verdict, Verdict::inconclusive);
}

TEST(TestSequence, AnImpossibleNightRefutesAtOnce) {
  TestSequence sequence;
  sequence.add_night("a", 0);
  EXPECT_EQ(judge_sequence(sequence, "density").verdict, Verdict::fail);
  for (const double bad : {-0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(sequence.add_night("a", bad), std::invalid_argument);
  }
}

}  // namespace
}  // namespace plumbline::verify::history
