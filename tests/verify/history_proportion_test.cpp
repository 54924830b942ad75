#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cstdint>
#include <stdexcept>
#include <string>

#include <plumbline/verify/history/confidence_sequence.h>
#include <plumbline/verify/ratio.h>

#include "history_lifetimes.h"

namespace plumbline::verify::history {
namespace {

constexpr int kNightsOfShares = 30;

/// The hits of a night of so many trials.
std::uint64_t hits_of(Random& random, double probability, int trials) {
  std::uint64_t hits = 0;
  for (int i = 0; i < trials; ++i) hits += random.uniform() < probability ? 1u : 0u;
  return hits;
}

TEST(ProportionSequence, IntervalIsWhereTheMixtureHasLittleEvidence) {
  ProportionSequence sequence;
  EXPECT_TRUE(sequence.add_night("a", 2, 3));
  ProportionOptions claim;
  SequenceBudget budget;
  budget.pass_confidence = 0.8;
  const Interval interval = *judge_sequence(sequence, claim, budget).interval;
  // B(2.5, 1.5)/B(½, ½) = 1/16, so that an end has p² (1 − p) = 0.2/16.
  for (const double p : {interval.low, interval.high}) {
    EXPECT_NEAR(p * p * (1 - p), 0.2 / 16, 1e-12);
  }
  EXPECT_LT(interval.low, 2 / 3.0);
  EXPECT_GT(interval.high, 2 / 3.0);
  // Hits alone have no evidence against always.
  sequence = {};
  sequence.add_night("a", 3, 3);
  EXPECT_EQ(judge_sequence(sequence, claim, budget).interval->high, 1);
  EXPECT_EQ(judge_sequence(ProportionSequence{}, claim).verdict, Verdict::inconclusive);
}

TEST(ProportionSequence, KeepsATrueClaimInAllLifetimes) {
  // The claim's edge is the truth: what fails is wrong. Rare events too, whose number is not
  // normal.
  for (const double truth : {0.3, 0.002}) {
    const std::string subject = "history/lifetimes/proportion " + std::to_string(truth);
    tests::expect_verdict(
        share_of_lifetimes(subject, 1000, 0, 0.05, Verdict::pass, [&](Random& random) {
          ProportionSequence sequence;
          ProportionOptions claim;
          claim.at_least = claim.at_most = truth;
          for (int night = 0; night < kNightsOfShares; ++night) {
            sequence.add_night("code", hits_of(random, truth, 100), 100);
            if (judge_sequence(sequence, claim, inflated(0.05)).verdict == Verdict::fail) {
              return true;
            }
          }
          return false;
        }));
  }
}

TEST(ProportionSequence, AShareTooSmallForOneNightIsFoundAfterThirty) {
  // 0.84 for at least 0.9: a night of 200 fails up to 140 hits, 5.4 standard errors below; thirty
  // fail up to 5,205, 5.8 above. The other claims are 10 away.
  Random random(tests::check_seed("history/proportion of thirty nights"));
  ProportionSequence sequence;
  ProportionOptions claim;
  claim.at_least = 0.9;
  for (int night = 1; night <= kNightsOfShares; ++night) {
    sequence.add_night("code", hits_of(random, 0.84, 200), 200);
    if (night == 1) {
      EXPECT_NE(judge_sequence(sequence, claim).verdict, Verdict::fail);
    }
  }
  EXPECT_EQ(judge_sequence(sequence, claim).verdict, Verdict::fail);
  claim.at_least = 0.75;
  EXPECT_EQ(judge_sequence(sequence, claim).verdict, Verdict::pass);
  claim.at_least = 0;
  claim.at_most = 0.75;
  EXPECT_EQ(judge_sequence(sequence, claim).verdict, Verdict::fail);
  EXPECT_TRUE(sequence.add_night("other code", 1, 2));
  EXPECT_EQ(sequence.trials, 2u);
  EXPECT_THROW(sequence.add_night("other code", 3, 2), std::invalid_argument);
  EXPECT_THROW(sequence.add_night("other code", 0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::verify::history
