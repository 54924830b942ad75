#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <plumbline/verify/detail/result.h>
#include <plumbline/verify/mean.h>

/// The verdict on one look at an estimate, shared by mean, agreement and image checks.
namespace plumbline::verify {

/// Of an estimate that is judged at all: reached by a Bernoulli estimator after 100 hits;
/// docs/statistics.md says what it guarantees.
inline constexpr double kSkewnessLimit = 0.1;

/// All in units of the quantity; levels as the look plan gives them.
struct MeanQuestion {
  double reference = 0;
  double tolerance = 0;
  double rounding_allowance = 0;
  std::optional<double> exact_variance;  ///< of one sample
  double fail_level = 0;                 ///< two-sided, at this look
  double pass_level = 0;                 ///< one-sided, at this look alone
  double line_level = 0;                 ///< as LookPlan
  double unseen_level = 0;               ///< as LookPlan
  double last_fail_level = 0;            ///< two-sided, at the last look
  std::uint64_t max_samples = 0;         ///< at the last look
};

/// Takes over what a plan says of a look.
void set_look(MeanQuestion& question, const LookPlan& plan, std::size_t look);

/// What a look of two estimates against each other asks.
///
/// @param scale  that tolerance and rounding allowance are relative to
MeanQuestion agreement_question(const MeanOptions& options, const LookPlan& plan, std::size_t look,
                                double scale);

/// estimate ± quantile · error, each end moved outwards where the skewness of the estimate asks for
/// it (Hall 1992), never inwards.
///
/// @param quantile  of the distribution of (estimate − truth)/error without skewness, > 0
Interval skewed_interval(double estimate, double error, double skewness, double quantile);

/// What is left of u = (estimate − claim)/error under the same correction, ≥ 0.
double skewed_statistic(double u, double skewness);

/// Interval of the true mean with `level` outside on each side: the wider of the normal one and the
/// one corrected for skewness, at each end.
Interval mean_interval(const Evidence& evidence, double level);

/// Two-sided p-value of the hypothesis that the true mean is `reference`: the larger of the normal
/// one and the one corrected for skewness.
double mean_p_value(const Evidence& evidence, double reference);

/// Fills in verdict, numbers and reasons; kind, subject, expected, seconds and seed are left to the
/// caller.
CheckResult judge_mean(const MeanQuestion& question, const Evidence& evidence);

}  // namespace plumbline::verify
