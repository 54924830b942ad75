#pragma once

#include <plumbline/verify/mean_check.h>

namespace plumbline::verify {

/// Whether two estimators have the same mean: light-only = BSDF-only = MIS.
///
/// The mean check (both ways, sequential) on the difference a − b with the variances of both
/// (Welch). Tolerance and rounding allowance are relative to the mean of both estimates at each
/// look, unless `options.relative` is false; `options.reference` is the difference expected, 0
/// unless stated. Each look draws as many samples from a as from b; `samples` in the result counts
/// both.
///
/// The runs must be independent of each other: give them different seeds.
CheckResult check_agreement(const MeanOptions& options, const MomentSampler& a,
                            const MomentSampler& b);

}  // namespace plumbline::verify
