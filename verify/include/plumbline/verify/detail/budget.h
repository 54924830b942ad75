#pragma once

#include <cstdint>
#include <vector>

namespace plumbline::verify {

/// How much error the whole suite may make, and what that leaves for one check.
///
/// The chance that a correct tree fails anywhere is at most `suite_level`. It is split over a fixed
/// bound on the number of checks, so the level of one check does not depend on which others run. A
/// run of more checks than that is refused by `plumbline report`.
struct ErrorBudget {
  double suite_level = 1e-4;             ///< chance of a false failure in a whole run, fresh seeds
  std::uint64_t max_checks = 1'000'000;  ///< at least as many as a run ever makes
  double pass_confidence = 0.999;        ///< with which the bound of a pass holds

  /// Level of the null hypothesis of one check: 1e-10 by default.
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
/// The level of a fail is split evenly: at 1e-10 a factor of 17 costs 0.4 standard errors, and
/// gross bugs are to be seen early. A fifth of the level of a pass is split evenly too, so that a
/// cap far beyond what is needed costs little; the rest is spent from the end, 0.7 of it on the
/// last look and 0.7 of what is left on each look before.
///
/// @param n0           samples at the first look, ≥ 1
/// @param max_samples  samples at the last look; below n0 there is one look, at max_samples
LookPlan plan_looks(std::uint64_t n0, std::uint64_t max_samples, const ErrorBudget& budget);

/// Samples after which a correct estimator has proven the tolerance with a chance of 1 − 1e-10, the
/// level of one check: 95 (cv/tolerance)². Half of all runs need 0.21 of it.
///
/// A pass at the last look needs |error| + z(5.6e-4) se ≤ tolerance, where 5.6e-4 is the least that
/// plan_looks spends there and z = 3.258; a correct estimate, normally distributed, has |error| ≤
/// 6.467 se but once in 1e10. (3.258 + 6.467)² = 94.6, in units of (cv/tolerance)². Half of all
/// errors are below 0.674 se: (3.8 + 0.674)² = 20 with the z of a look in the middle of the plan.
///
/// @param relative_tolerance  |bias|/mean, > 0
/// @param cv                  standard deviation of one sample over its mean
std::uint64_t samples_to_decide(double relative_tolerance, double cv);

}  // namespace plumbline::verify
