#pragma once

#include <plumbline/verify/ratio.h>

namespace plumbline::verify {

/// Fills in verdict, reason and advice of a claim about a ratio.
///
/// @param proven  interval of a pass
/// @param sure    interval of a fail
void judge_ratio_claim(const VarianceRatioOptions& options, const Interval& proven,
                       const Interval& sure, CheckResult& result);

}  // namespace plumbline::verify
