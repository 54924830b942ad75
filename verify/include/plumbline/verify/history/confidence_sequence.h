#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include <plumbline/verify/detail/budget.h>
#include <plumbline/verify/detail/result.h>
#include <plumbline/verify/ratio.h>

/// What many nights show of one check together: sequences that may be judged after every night,
/// for years, without spending any level anew.
namespace plumbline::verify::history {

/// How much error the sequences and the checks of the nights may make.
///
/// The chance that any sequence of a correct tree ever says otherwise, in all its life, is at most
/// `life_level`. It is split over a fixed bound on the number of sequences that are ever started; a
/// check starts one more whenever the code that it looks at has changed. 1e8 are those of 10,000
/// checks whose code changes daily for 27 years.
struct SequenceBudget {
  double life_level = 1e-4;                   ///< chance of a false failure of any sequence, ever
  std::uint64_t max_sequences = 100'000'000;  ///< at least as many as are ever started
  double pass_confidence = 0.999;             ///< with which all bounds of one sequence hold

  /// Level of one sequence, over all its nights: 1e-12 by default.
  double fail_level() const { return life_level / static_cast<double>(max_sequences); }

  /// Chance that any bound of one sequence is ever wrong.
  double pass_level() const { return 1 - pass_confidence; }
};

/// The budget for the checks of one night by themselves, in all of its runs: 1e-4/365 for all of
/// them, so that a year of nights is what one run of the gate is: 2.7e-13 for each of a million
/// checks. It is what an ErrorBudget is where PLUMBLINE_NIGHTLY is set (`run_level`).
ErrorBudget night_budget();

/// How many standard errors a mean of independent values may stray at any time: P(it ever strays
/// further) ≤ level, asymptotically, two-sided.
///
/// √((x + 1)/x · (ln(x + 1) − 2 ln level)) with x = tρ²; ρ makes it least at the target, where x
/// solves x = ln(x + 1) − 2 ln level. At a level of 1e-12 it is 7.8 there, against 7.1 for a single
/// look; at a thirtieth of the target 9.2.
///
/// @param count, target  values so far, and when the interval is to be narrowest; both > 0. The
///                       target must not depend on the values.
/// @param level          in (0, 1)
/// @throws std::invalid_argument outside of these ranges
/// @source Waudby-Smith, Arbour, Sinha, Kennedy, Ramdas 2024 (Ann. Statist. 52:6), Theorem 2.2; the
///         choice of ρ: Appendix B.2, solved exactly
double mixture_reach(double count, double target, double level);

/// Means of batches of equally many samples: what a night adds to the sequence of a mean. Plain
/// data, to be stored and restored as it stands.
struct BatchMoments {
  std::uint64_t samples_per_batch = 0;  ///< 0 while there are no batches
  std::uint64_t batches = 0;
  double mean = 0;  ///< of the batch means, in units of the quantity
  double m2 = 0;    ///< sum of their squared deviations from it
  double m3 = 0;    ///< sum of their cubed deviations from it
  double smallest = std::numeric_limits<double>::infinity();  ///< batch mean
  double largest = -std::numeric_limits<double>::infinity();  ///< batch mean
  std::uint64_t non_finite = 0;                               ///< batches that were left out for it

  /// Adds the mean of one batch.
  ///
  /// @param samples  in the batch, ≥ 1
  /// @throws std::invalid_argument where the batches before had another size
  void add(double batch_mean, std::uint64_t samples);

  /// Adds all batches of another set.
  ///
  /// @throws std::invalid_argument where its batches have another size
  void merge(const BatchMoments& other);

  friend bool operator==(const BatchMoments&, const BatchMoments&) = default;
};

/// A mean over the nights.
struct MeanSequence {
  std::string code;  ///< hash of the sources under test that all nights belong to
  std::uint64_t nights = 0;
  BatchMoments all;

  /// Adds a night, with a seed of its own. The sequence starts again where the code, or the size of
  /// the batches, is not that of the nights before.
  ///
  /// @return whether it started again (also with the first night)
  bool add_night(std::string_view code_hash, const BatchMoments& night);

  friend bool operator==(const MeanSequence&, const MeanSequence&) = default;
};

/// What the sequence of a mean is asked.
struct MeanSequenceOptions {
  std::string subject;
  double reference = 0;           ///< the known answer
  double tolerance = 0;           ///< largest |bias| that a pass allows, in its units
  double rounding_allowance = 0;  ///< a bias proven to exceed this fails, in its units
  double target_batches = 1920;   ///< when intervals are narrowest: thirty nights of 64 batches
  SequenceBudget budget;
};

/// The mean check over the nights: `pass` where |bias| ≤ tolerance is proven, `fail` where a bias
/// beyond the rounding allowance is, else `inconclusive`. `bound` shrinks with the nights whatever
/// the verdict is; bounds of all nights hold together with 99.9 % confidence.
///
/// The asymptotic confidence sequence of `mixture_reach`, its reach taken from Student's instead of
/// the normal distribution, and corrected for the skewness of the batch means as single checks are
/// (MeanCheck). No verdict below 64 batches or a 64th of the target, while the skewness of the
/// estimate exceeds 0.1, or while one batch carries more than 15 % of the squared deviations. The
/// p-value holds at any time, too.
///
/// @throws std::invalid_argument for a target that is not positive
CheckResult judge_sequence(const MeanSequence& sequence, const MeanSequenceOptions& options);

/// A ratio of two variances over the nights, by its logarithms.
struct RatioSequence {
  std::string code;
  std::uint64_t nights = 0;
  BatchMoments logs;          ///< logarithms of the nights' ratios, each a batch of one
  double squared_errors = 0;  ///< sum of the squared standard errors of the logarithms
  double degrees = 0;         ///< sum of the degrees of freedom of the errors

  /// Adds a night's ratio; starts again where the code has changed.
  ///
  /// @param log_ratio  ln(variance(a)/variance(b)), finite
  /// @param error      its standard error by the jackknife, finite, ≥ 0: the figure "error of the
  ///                   logarithm" of check_variance_ratio
  /// @param batches    that the jackknife left out in turn, ≥ 2
  /// @return           whether it started again
  /// @throws std::invalid_argument outside of these ranges
  bool add_night(std::string_view code_hash, double log_ratio, double error, double batches);

  friend bool operator==(const RatioSequence&, const RatioSequence&) = default;
};

/// What the sequence of a ratio is asked.
struct RatioSequenceOptions {
  VarianceRatioOptions claim;  ///< subject and claim; seed and budget are not used
  double target_nights = 30;   ///< when intervals are narrowest
  SequenceBudget budget;
};

/// The check of a ratio of variances over the nights. The nights count alike; their error is what
/// they state or what they scatter by, whichever is larger.
CheckResult judge_sequence(const RatioSequence& sequence, const RatioSequenceOptions& options);

/// A probability over the nights: how often something happened, of how many independent trials.
struct ProportionSequence {
  std::string code;
  std::uint64_t nights = 0;
  std::uint64_t hits = 0, trials = 0;

  /// Adds a night; starts again where the code has changed.
  ///
  /// @param night_hits, night_trials  hits ≤ trials ≥ 1
  /// @return  whether it started again
  /// @throws std::invalid_argument outside of these ranges
  bool add_night(std::string_view code_hash, std::uint64_t night_hits, std::uint64_t night_trials);

  friend bool operator==(const ProportionSequence&, const ProportionSequence&) = default;
};

/// The claim about a proportion over the nights: `pass` where the interval of all nights lies
/// within it, `fail` where it is proven broken, else `inconclusive`. Seed and budget of the claim
/// are not used.
///
/// The interval is exact for any number of trials and any time to look: it holds the probabilities
/// p against which the hits k of n have less evidence than 1/level, B(k + ½, n − k + ½)/B(½, ½) /
/// (p^k (1 − p)^(n−k)), a martingale under p.
///
/// @source Robbins 1970 (Ann. Math. Statist. 41:5), mixtures · Ville 1939 · Krichevsky, Trofimov
///         1981 (IEEE Trans. Inf. Theory 27:2), the weight of the mixture
CheckResult judge_sequence(const ProportionSequence& sequence, const ProportionOptions& claim,
                           const SequenceBudget& budget = {});

/// Evidence against a hypothesis that is tested every night, from its p-values: a density by
/// chi-square.
struct TestSequence {
  std::string code;
  std::uint64_t nights = 0;
  double minus_log_p = 0;  ///< Σ −ln p

  /// Adds a night's p-value; starts again where the code has changed.
  ///
  /// @param p_value  in [0, 1]; valid under the hypothesis: P(p ≤ u) ≤ u
  /// @return         whether it started again
  /// @throws std::invalid_argument outside of this range
  bool add_night(std::string_view code_hash, double p_value);

  /// ln of the evidence: of the product over the nights of κ p^(κ−1), averaged over κ in (0, 1).
  /// Under the hypothesis it is a test martingale: P(it ever exceeds −ln level) ≤ level.
  ///
  /// @source Vovk, Wang 2021 (Ann. Statist. 49:3), Section 2 · Ville 1939
  double log_evidence() const;

  friend bool operator==(const TestSequence&, const TestSequence&) = default;
};

/// `fail` where the evidence of all nights refutes the hypothesis, else `inconclusive`: evidence
/// against cannot show that nothing is wrong.
///
/// @param kind  of the nightly check, for the result
CheckResult judge_sequence(const TestSequence& sequence, std::string subject,
                           const SequenceBudget& budget = {},
                           CheckKind kind = CheckKind::chi_square);

}  // namespace plumbline::verify::history
