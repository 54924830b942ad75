#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <plumbline/verify/detail/moments.h>
#include <plumbline/verify/detail/report.h>
#include <plumbline/verify/detail/settings.h>

namespace plumbline::verify {

/// Largest share of a variance that one batch may carry: above, the tail decides, and nothing is
/// decided.
inline constexpr double kBatchShareLimit = 0.25;

/// A claim about the ratio variance(a)/variance(b).
struct VarianceRatioOptions : CheckSettings {
  std::string subject;
  std::optional<double> at_least;  ///< claim: ratio ≥ this
  std::optional<double> at_most;   ///< claim: ratio ≤ this; both may be given
  Verdict expected = Verdict::pass;
};

/// Whether the ratio of two variances keeps a claim, with a 99.9 % interval.
///
/// The samples come in batches (at least 16, equally many of a and b, of about equal size), and the
/// interval is Student's on the logarithm of the ratio with the jackknife over batches, which makes
/// no assumption on the distribution of the samples, widened where the batches are skewed (Hall).
/// Its coverage is measured: docs/statistics.md. Leaving out the same batch of both keeps the
/// interval right, and makes it narrower, when batch i of a and of b shared their random numbers.
///
/// `pass` if the interval keeps the claim, `fail` if it is proven broken at the level of the error
/// budget, else `inconclusive`; also `inconclusive` while one batch carries more than a quarter of
/// a variance, since then the tail decides. The estimate is the ratio; without a claim the verdict
/// is `pass` when the interval is finite and the tail does not decide.
///
/// @throws std::invalid_argument for fewer than 16 batches or unequally many
/// @source Miller 1974 (jackknife of log variances) · Hall 1992 (J. R. Stat. Soc. B 54:1), Section
///         2
CheckResult check_variance_ratio(const VarianceRatioOptions& options, std::span<const Moments> a,
                                 std::span<const Moments> b);

/// The same for any non-negative statistic that is averaged over batches: the mean variance over
/// the pixels of a render, the mean squared error of a replicate.
CheckResult check_variance_ratio(const VarianceRatioOptions& options, std::span<const double> a,
                                 std::span<const double> b);

/// A claim about a probability.
struct ProportionOptions : CheckSettings {
  std::string subject;
  double at_least = 0;  ///< claim: probability ≥ this
  double at_most = 1;   ///< claim: probability ≤ this
  Verdict expected = Verdict::pass;
};

/// Whether the probability of an event keeps a claim, from how often it happened: a hit rate, the
/// share of runs that fail. The interval is exact for independent trials, whatever the probability.
///
/// `pass` if the 99.9 % interval lies within the claim, `fail` if the claim is proven broken at the
/// level of the error budget, else `inconclusive`.
///
/// @param hits, trials  how often it happened, of how many independent trials; hits ≤ trials ≥ 1
/// @throws std::invalid_argument for counts or a claim that make no sense
/// @source Clopper, Pearson 1934 (Biometrika 26:4)
CheckResult check_proportion(const ProportionOptions& options, std::uint64_t hits,
                             std::uint64_t trials);

}  // namespace plumbline::verify
