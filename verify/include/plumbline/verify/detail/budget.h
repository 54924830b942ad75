#pragma once

#include <cstdint>
#include <vector>

namespace plumbline::verify {

/// Chance of a false failure that a run may have: 1e-4, with fresh seeds.
inline constexpr double kRunLevel = 1e-4;

/// That of all runs of one night together, so that a year of nights has kRunLevel.
inline constexpr double kNightLevel = kRunLevel / 365;

/// kNightLevel where the environment variable PLUMBLINE_NIGHTLY is set and neither empty nor "0":
/// this process is part of a night. Else kRunLevel.
double run_level();

/// How much error the whole suite may make, and what that leaves for one check.
///
/// The chance that a correct tree fails anywhere is at most `suite_level`. It is split over a fixed
/// bound on the number of checks, so the level of one check does not depend on which others run. A
/// run of more checks than that is refused by `plumbline report`.
struct ErrorBudget {
  double suite_level = run_level();      ///< chance of a false failure in a whole run, fresh seeds
  std::uint64_t max_checks = 1'000'000;  ///< at least as many as a run ever makes
  double pass_confidence = 0.999;        ///< with which the bound of a pass holds

  /// Level of the null hypothesis of one check: 1e-10 by default, 2.7e-13 at night.
  double fail_level() const { return suite_level / static_cast<double>(max_checks); }

  /// Chance that the bound of a pass is wrong.
  double pass_level() const { return 1 - pass_confidence; }
};

/// When a check looks at its data, and what each look may spend; the last look is at the cap.
struct LookPlan {
  std::vector<std::uint64_t> samples;  ///< cumulative count at each look, strictly increasing
  std::vector<double> fail_level;      ///< two-sided level of a fail at each look
  std::vector<double> pass_level;      ///< one-sided level of the bound at each look
  double line_level = 0;  ///< one-sided level that all looks share by `line_quantile`; 0: none
  double unseen_level =
      0;  ///< one-sided level, of all looks, for what no sample has shown; 0: none
};

/// Splits both levels over the looks n0, 2·n0, 4·n0, … , max_samples, so that each sums to its
/// total: the plan of checks that test for a difference only.
///
/// The level of a fail is split evenly: at 1e-10 a factor of 17 costs 0.4 standard errors, and
/// gross bugs are to be seen early. A fifth of the level of a pass is split evenly too, so that a
/// cap far beyond what is needed costs little; the rest is spent from the end, 0.7 of it on the
/// last look and 0.7 of what is left on each look before.
///
/// @param n0           samples at the first look, ≥ 1
/// @param max_samples  samples at the last look; below n0 there is one look, at max_samples
LookPlan plan_looks(std::uint64_t n0, std::uint64_t max_samples, const ErrorBudget& budget);

/// The looks of a mean check: n0, then each `kLookRatio` times the last or a little more, even in
/// the logarithm, up to max_samples.
///
/// A quarter of the level of a fail is spent on the last look, which decides what a check detects,
/// the rest evenly on the others. Of the level of a pass the looks share 0.72 along Wald's line,
/// and 0.15 for what no sample has shown: unseen in n samples it was unseen in fewer, so those
/// looks are wrong together, not one after the other. Of the rest 0.1 is the last look's, and 0.03
/// is split evenly for the intervals of looks that are too early for a pass.
///
/// @param n0           samples at the first look, ≥ 1
/// @param max_samples  samples at the last look; below kLookRatio·n0 there is one look, at
///                     max_samples, with the whole of both levels
LookPlan plan_mean_looks(std::uint64_t n0, std::uint64_t max_samples, const ErrorBudget& budget);

/// Least ratio of the samples at neighbouring looks of a mean check: 2^(1/4).
inline constexpr double kLookRatio = 1.189207115002721;

/// Standard errors that the bound of a mean must reach beyond the estimate at a look, where all
/// looks, a factor of kLookRatio or more apart, may be wrong with the probability `level` together.
///
/// With s = tolerance/(standard error) it is s/2 + L/s: the sequential test of Wald for no bias
/// against a bias of the tolerance, |bias| ≤ tolerance/2 − L·(standard error)²/tolerance. A pass
/// is possible from s² = 2L on, and only there the bound is one of all looks; infinity before.
///
/// In continuous time L = ln(1/level). A look sees the line some way behind, and the more so the
/// farther looks are apart, so less will do: L = ln(1/level) − 0.7·ln(1/level)^(1/3), for levels
/// from 1e-8 to 0.01; the recursion of Armitage, McPherson and Rowe, by which the tests compute the
/// chance exactly, allows 0.727 at 1e-3.
///
/// @param s      tolerance over standard error, ≥ 0
/// @param level  one-sided, in (0, 1)
/// @source Wald 1945 (Ann. Math. Stat. 16:2), Section 3; Armitage, McPherson and Rowe 1969 (J. R.
///         Stat. Soc. A 132:2)
double line_quantile(double s, double level);

/// Samples after which a correct estimator has proven the tolerance but with a chance as small as
/// the level of one check: 104 (cv/tolerance)² at 1e-10, 122 (cv/tolerance)² at night. Half of all
/// runs need 0.18 of it.
///
/// A pass at the last look needs |error| + z(1e-4) se ≤ tolerance, where 1e-4 is the least that
/// plan_mean_looks spends there and z = 3.719; a correct estimate, normally distributed, has
/// |error| ≤ 6.467 se but once in 1e10. (3.719 + 6.467)² = 103.8, in units of (cv/tolerance)².
///
/// @param relative_tolerance  |bias|/mean, > 0
/// @param cv                  standard deviation of one sample over its mean
std::uint64_t samples_to_decide(double relative_tolerance, double cv,
                                const ErrorBudget& budget = {});

}  // namespace plumbline::verify
