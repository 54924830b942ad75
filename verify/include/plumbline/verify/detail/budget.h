#pragma once

#include <cstdint>
#include <vector>

namespace plumbline::verify {

/// How much error the whole suite may make, and what that leaves for one check.
///
/// The chance that a correct tree fails anywhere is at most `suite_level`. It is split over a fixed
/// bound on the number of checks, so the level of one check does not depend on which others run.
struct ErrorBudget {
  double suite_level = 1e-4;         ///< chance of a false failure in a whole run, fresh seeds
  std::uint64_t max_checks = 10000;  ///< at least as many as a run ever makes
  double pass_confidence = 0.999;    ///< with which the bound of a pass holds

  /// Level of the null hypothesis of one check: 1e-8 by default.
  double fail_level() const { return suite_level / static_cast<double>(max_checks); }

  /// Chance that the bound of a pass is wrong.
  double pass_level() const { return 1 - pass_confidence; }
};

/// A check looks at the data at n0·2^k samples; the last look is at the cap.
struct LookPlan {
  std::vector<std::uint64_t> samples;  ///< cumulative count at each look, strictly increasing
  std::vector<double> fail_level;      ///< two-sided level of a fail at each look
  std::vector<double> pass_level;      ///< one-sided level of the bound at each look
};

/// Splits both levels over the looks n0, 2·n0, 4·n0, … , max_samples, so that each sums to its
/// total.
///
/// The level of a fail is split evenly: at 1e-8 a factor of 17 costs 0.4 standard errors, and gross
/// bugs are to be seen early. A fifth of the level of a pass is split evenly too, so that a cap far
/// beyond what is needed costs little; the rest is spent from the end, 0.7 of it on the last look
/// and 0.7 of what is left on each look before.
///
/// @param n0           samples at the first look, ≥ 1
/// @param max_samples  samples at the last look; below n0 there is one look, at max_samples
LookPlan plan_looks(std::uint64_t n0, std::uint64_t max_samples, const ErrorBudget& budget);

/// Samples after which a correct estimator has proven the tolerance with a chance of 1 − 1e-7: 73
/// (cv/tolerance)². Half of all runs need 0.28 of it.
///
/// @param relative_tolerance  |bias|/mean, > 0
/// @param cv                  standard deviation of one sample over its mean
std::uint64_t samples_to_decide(double relative_tolerance, double cv);

}  // namespace plumbline::verify
