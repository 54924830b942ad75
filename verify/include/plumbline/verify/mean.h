#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include <plumbline/verify/detail/budget.h>
#include <plumbline/verify/detail/moments.h>
#include <plumbline/verify/detail/report.h>
#include <plumbline/verify/detail/settings.h>
#include <plumbline/verify/detail/stopwatch.h>

namespace plumbline::verify {

/// What a check of a mean looks at: an estimate with what is known about its error. Made from
/// moments of independent samples by `evidence()`, or by pooling the pixels of an image
/// (image.h).
struct Evidence {
  std::uint64_t samples = 0;
  double estimate = 0;
  double standard_error = 0;
  double skewness = 0;  ///< of the estimate, not of one sample: γ/√n for independent samples
  double largest_share = 0;  ///< share of the squared deviations carried by a single sample
  double tail_index = std::numeric_limits<double>::infinity();  ///< as Moments::tail_index
  double smallest = std::numeric_limits<double>::quiet_NaN();   ///< sample; NaN: not known
  double largest = std::numeric_limits<double>::quiet_NaN();    ///< sample; NaN: not known
  std::uint64_t rejected = 0;
  std::uint64_t non_finite = 0;
};

/// Evidence of independent samples.
Evidence evidence(const Moments& moments);

/// Evidence of the difference a − b of two independent estimates (Welch).
Evidence difference(const Evidence& a, const Evidence& b);

/// What a mean check is asked.
struct MeanOptions : CheckSettings {
  std::string subject;
  double reference = 0;  ///< the known answer

  /// Largest |bias| that a pass allows. Relative to |reference| where `relative`, else in its
  /// units; where the reference is 0 it must be absolute.
  double tolerance = 0.005;
  bool relative = true;

  /// A bias that is proven to exceed this fails even below the tolerance: what float rounding of
  /// the code under test may do. Relative to |reference|, or absolute, like `tolerance`.
  double rounding_allowance = 1e-5;

  /// Variance of one sample, where a closed form gives it; else it is estimated from the samples.
  /// Infinity says that it is known to be infinite: then nothing passes or fails but the bound
  /// stands.
  std::optional<double> exact_variance;

  std::uint64_t n0 = 1250;              ///< samples at the first look
  std::uint64_t max_samples = 1 << 26;  ///< the cap, where the check stays undecided
  Verdict expected = Verdict::pass;
};

/// Shows |bias| ≤ tolerance, or bias ≠ 0, looking at growing sample counts: equivalence test and
/// difference test at once, group-sequential, both levels spent over the looks (plan_mean_looks).
///
/// - `fail` if the bias is proven to exceed the rounding allowance, at the level of the error
///   budget; also if any sample was not finite.
/// - `pass` if |bias| ≤ tolerance is proven with 99.9 % confidence.
/// - else `inconclusive`, with the reason and the bound still proven.
///
/// Skewed samples: statistics are corrected for skewness (Hall's transformation) and the less
/// extreme of the corrected and the plain one counts. No verdict while the skewness of the estimate
/// exceeds 0.1, one sample carries more than 15 % of the squared deviations, or fewer than 1,000
/// samples are in. No pass while the tail looks so heavy that the variance is infinite. Where an
/// exact variance is given it decides instead: no verdict while the samples show less than half or
/// more than twice of it.
///
/// Samples that differ by less than the tolerance need no normal approximation: their range bounds
/// the error of their mean (Hoeffding). What none of n samples has shown has a probability of at
/// most ln(1/level)/n and is taken to deviate from the mean m by at most |m|; both bound the bias
/// for a pass, and are what a fail must exceed. All zeros may be a rare event instead: they pass
/// from 20,000 samples on and fail from 2^20 on, or, with an exact variance, as soon as they are
/// too improbable under it. The same holds where all samples lie nearer to 0 than the answer and
/// their mean below 0.55 of it: what is missing may be light that none of them has hit.
///
/// @source Hall 1992 (J. R. Stat. Soc. B 54:1), transformation g of Section 2 · two one-sided
///         tests: Schuirmann 1987
class MeanCheck {
 public:
  /// @throws std::invalid_argument for a reference, tolerance or cap that makes no sense
  explicit MeanCheck(MeanOptions options);

  /// Whether a verdict is reached or the cap is.
  bool done() const { return done_; }

  /// Samples still to be drawn before the next look; 0 when done.
  std::uint64_t samples_wanted() const;

  /// Adds samples; looks when enough have come. More than were wanted only count as one look.
  void add(const Moments& batch);

  /// For estimates that are not a plain mean of samples (images): looks at all the evidence so far.
  /// `evidence.samples` decides which look of the plan this is; between looks nothing happens.
  void look(const Evidence& all_so_far);

  /// Verdict, estimate, interval, proven bound, detectable effect, samples used, what it leaned on.
  CheckResult result() const { return result_; }

 private:
  void judge(const Evidence& evidence, std::size_t look);

  MeanOptions options_;
  LookPlan plan_;
  Stopwatch watch_;
  Moments moments_;
  std::size_t next_look_ = 0;
  bool done_ = false;
  CheckResult result_;
};

/// Draws `count` more samples; `first` is the number of samples drawn before. Called from one
/// thread.
using MomentSampler = std::function<Moments(std::uint64_t first, std::uint64_t count)>;

/// Runs a mean check on a sampler until it is decided.
CheckResult check_mean(const MeanOptions& options, const MomentSampler& sampler);

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
