#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/verify/detail/cause.h>

namespace plumbline::verify {

/// What a check concludes. `pass` is a proof (a bound at the stated confidence), `fail` is a proof
/// of a difference, everything else is `inconclusive`.
enum class Verdict { pass, fail, inconclusive };

/// "pass", "fail" or "inconclusive".
std::string_view to_string(Verdict verdict);

/// What a check looks at.
enum class CheckKind {
  other,  ///< a check of a user's own

  // Numbers from a renderer.
  mean,
  agreement,
  variance_ratio,
  proportion,
  image,

  // A sampling pair.
  record_pdf,
  weight,
  support,
  finite,
  jacobian,
  jacobian_autodiff,
  inverse,
  integral,
  chi_square,

  // A BSDF.
  reciprocity,
  energy,
  atoms,
  samples,  ///< whether it gives any

  // Samples that depend on each other.
  strata,
  net,
  replicates,  ///< whether each point is uniform over them

  // Of a whole tree: what its checks claim, and what its estimators should show.
  calibration,
  stability,
  variance
};

/// The word in subjects and records: "variance_ratio".
std::string_view to_string(CheckKind kind);

/// The kind that a word stands for; nullopt if none.
std::optional<CheckKind> check_kind(std::string_view word);

/// What the further numbers of a result are.
enum class Figure {
  other,  ///< has a name of its own

  // Means and agreement.
  standard_error,
  skewness,       ///< of the estimate
  largest_share,  ///< of the squared deviations, carried by one sample
  rejected,       ///< samples
  non_finite,     ///< samples
  mean_of_a,
  mean_of_b,
  quantities,  ///< that were judged, of which this is the worst

  // Ratios of variances, proportions.
  variance_of_a,
  variance_of_b,
  largest_batch_of_a,  ///< its share of the variance
  largest_batch_of_b,
  batches,
  error_of_logarithm,  ///< standard error of the logarithm of the ratio
  hits,
  at_least,
  at_most,

  // Images.
  pixels_judged,
  histogram_p_value,  ///< of the hypothesis that the p-values are uniform

  // Sampling pairs and BSDFs.
  points_tried,
  folds,  ///< points that differences do not converge at: folds, seams, rounding
  failing,
  ill_conditioned,  ///< points
  integral_of_pdf,
  integral_error,
  atoms,  ///< of a chi-square how many, of an integral their probability
  rejected_share,
  rejected_error,    ///< of the rejected share
  unresolved_share,  ///< of the mass, in bins whose mass is not known well enough
  unseen_spike,      ///< share of the domain that a spike may take unseen, once in 1,000 times
  rounding,          ///< what it may do to the integral
  pairs_with_value,
  explained_by_rounding,
  evaluations,
  chi_square,
  degrees_of_freedom,
  bins,
  albedo_of_atoms
};

/// "integral of the pdf"
std::string_view to_string(Figure figure);

/// One further number of a result.
struct FigureValue {
  Figure figure = Figure::other;
  double value = 0;
  std::string own_name;  ///< of Figure::other

  FigureValue(Figure f, double v) : figure(f), value(v) {}

  /// By name, for checks of a user's own; a name that `to_string` gives is that figure.
  FigureValue(std::string_view name, double v);

  std::string_view name() const;

  friend bool operator==(const FigureValue&, const FigureValue&) = default;
};

struct Interval {
  double low = 0, high = 0;

  friend bool operator==(const Interval&, const Interval&) = default;
};

/// A bin that samples were counted in, in the square of the domain's chart; a point i of a discrete
/// set stands from i to i + 1.
struct Bin {
  Interval x, y;
  double expected = 0, expected_error = 0;  ///< samples, and its standard error
  double observed = 0;

  friend bool operator==(const Bin&, const Bin&) = default;
};

/// The outcome of one check. Plain data: what a person needs to act on it, what the page shows, and
/// what replays it. What a kind of check has no use for stays empty.
struct CheckResult {
  CheckKind kind = CheckKind::other;
  std::string subject;  ///< what was checked, coarse to fine: "furnace_sphere/mis/power"
  Verdict verdict = Verdict::inconclusive;
  Verdict expected = Verdict::pass;  ///< what the check declares that it must give

  std::optional<double> estimate;    ///< in units of the quantity
  std::optional<double> reference;   ///< the known answer, same units
  std::optional<double> tolerance;   ///< largest |bias| that a pass allows, same units
  std::optional<double> bound;       ///< proven: |bias| <= bound with 99.9 % confidence
  std::optional<double> detectable;  ///< smallest effect that fails with 99 % probability
  std::optional<double> p_value;     ///< of the null hypothesis "no difference"
  std::optional<Interval> interval;  ///< 99.9 % confidence interval of `estimate`
  std::uint64_t samples = 0;
  double seconds = 0;  ///< that the check took, the code under test included where it calls it

  std::string leaned_on;  ///< assumption behind the verdict: "exact variance", "skewness guard", …
  std::string reason;     ///< why it failed or stayed inconclusive, one sentence for a person
  std::string waived;     ///< why a failure is put up with (waiver.h); empty: it is not
  std::string advice;     ///< what to do where it stayed inconclusive, one sentence
  std::string diagnosis;  ///< what is likely wrong, and how well that fits; empty if nothing fits
  CauseKind cause = CauseKind::none;  ///< the diagnosis in a word
  std::uint64_t seed = 0;
  std::string replay;  ///< one command that repeats the check; filled in by the suite that ran it

  /// Further numbers worth keeping (degrees of freedom, bins, a variance), in the order in which
  /// they are shown.
  std::vector<FigureValue> figures;

  /// What a chi-square test that failed has counted, in at most 256 bins.
  std::vector<Bin> bins;

  /// The first value of a figure; nullopt if the result has none.
  std::optional<double> figure(Figure figure) const;

  /// A pass, and nothing else.
  bool ok() const { return verdict == Verdict::pass; }

  /// The question of a suite with negative controls.
  bool as_expected() const { return verdict == expected; }
};

/// Several lines for a person: subject, verdict against expectation, the numbers, where, why,
/// replay.
std::string describe(const CheckResult& result);

}  // namespace plumbline::verify
