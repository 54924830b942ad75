#pragma once

#include <plumbline/verify/ratio.h>

#include "text.h"

namespace plumbline::verify {

/// Fills in interval, verdict and reason of a claim about a probability.
///
/// @param proven, sure  intervals with which a pass, and a fail, is certain
inline void judge_proportion_claim(const ProportionOptions& claim, const Interval& proven,
                                   const Interval& sure, CheckResult& r) {
  r.interval = proven;
  if (sure.low > claim.at_most) {
    r.verdict = Verdict::fail;
    r.reason = "the share is at least " + number(sure.low) + ", the claim is at most " +
               number(claim.at_most);
  } else if (sure.high < claim.at_least) {
    r.verdict = Verdict::fail;
    r.reason = "the share is at most " + number(sure.high) + ", the claim is at least " +
               number(claim.at_least);
  } else if (proven.low >= claim.at_least && proven.high <= claim.at_most) {
    r.verdict = Verdict::pass;
  } else {
    r.reason = "the interval straddles the claim";
  }
}

}  // namespace plumbline::verify
