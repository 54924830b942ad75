#include "means/mean_judgement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bernstein.h"
#include "distributions.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr std::uint64_t kMinimumSamples = 1'000;
constexpr std::uint64_t kEnoughZerosToPass = 20'000;
constexpr std::uint64_t kEnoughZerosToFail = 1u << 20;
constexpr double kShareLimit = 0.15;
// A tail index of 2 or less means infinite variance.
constexpr double kTailLimit = 2;

/// @source Hall 1992, the transformation g of Section 2, in units of the standard error
double hall(double u, double skewness) {
  const double g = skewness;
  return u + g * u * u / 3 + g * g * u * u * u / 27 + g / 6;
}

double hall_inverse(double z, double skewness) {
  const double g = skewness;
  if (std::abs(g) < 1e-9) return z;
  return 3 * (std::cbrt(1 + g * (z - g / 6)) - 1) / g;
}

bool knows_variance(const MeanQuestion& q) {
  return q.exact_variance && std::isfinite(*q.exact_variance);
}

/// Samples that differ by less than the tolerance: no normal approximation is needed, or trusted,
/// to bound their mean. Rounding noise with rare larger errors is of this kind.
bool is_nearly_constant(const Evidence& e, double tolerance) {
  return e.standard_error == 0 || e.largest - e.smallest <= tolerance;
}

bool is_all_zero(const Evidence& e) { return e.smallest == 0 && e.largest == 0; }

/// Part of the answer that, if missing, may be carried by what no sample has hit. Half of it is one
/// technique's part of a naive average; the other's own noise takes the rest off that half.
constexpr double kMostOfTheAnswer = 0.45;

/// All samples lie nearer to 0 than the answer, and about half of it or more is not there: what
/// carries the rest may be too rare to have been hit, like the whole of it where all samples are 0.
bool misses_most(const MeanQuestion& q, const Evidence& e) {
  const double farthest = std::max(std::abs(e.smallest), std::abs(e.largest));
  return farthest < std::abs(q.reference) &&
         std::abs(q.reference - e.estimate) > kMostOfTheAnswer * std::abs(q.reference) &&
         e.samples < kEnoughZerosToFail;
}

std::string most_is_missing(const MeanQuestion& q, const Evidence& e) {
  return "all " + number(e.samples) + " samples lie below the answer " + number(q.reference) +
         ", their mean at about half of it or less: what carries the rest may not have been hit "
         "yet";
}

/// Chance, at most, that n samples all lie `distance` or more to the same side of their true mean:
/// each does with probability ≤ σ²/(σ² + distance²) (Cantelli).
double chance_of_distance(double variance, double distance, std::uint64_t n) {
  return std::exp(-static_cast<double>(n) * std::log1p(distance * distance / variance));
}

/// Why no verdict may be given on skewed or scarce samples; empty if one may.
std::string guard(const Evidence& e) {
  if (e.samples < kMinimumSamples) {
    return "only " + number(e.samples) + " samples; at least 1000 are needed";
  }
  if (!(std::abs(e.skewness) <= kSkewnessLimit)) {
    return "the estimate is still skewed (" + number(e.skewness) +
           ", limit 0.1): too few samples carry the sum";
  }
  if (!(e.largest_share <= kShareLimit)) {
    return "one sample carries " + number(100 * e.largest_share) +
           " % of the squared deviations (limit 15 %)";
  }
  return {};
}

/// Replaces the estimated error by the exact one.
Evidence with_exact_variance(Evidence e, double variance) {
  const double exact =
      std::sqrt(variance / static_cast<double>(std::max<std::uint64_t>(e.samples, 1)));
  const double ratio = exact > 0 ? e.standard_error / exact : 1;
  e.standard_error = exact;
  e.skewness *= ratio * ratio * ratio;
  return e;
}

std::string exact_variance_doubt(const Evidence& estimated, const Evidence& exact) {
  const double ratio = std::pow(estimated.standard_error / exact.standard_error, 2);
  if (ratio >= 0.5 && ratio <= 2) return {};
  return "the samples show " + number(ratio) +
         " of the exact variance: part of the distribution has not been seen yet, or the exact "
         "variance is wrong";
}

/// Standard errors that the bound reaches beyond the estimate: this look's own level and the one
/// that all looks share are both spent, so the smaller reach holds.
double pass_quantile(const MeanQuestion& q, const Evidence& e) {
  const double own = normal_quantile(q.pass_level);
  if (!(q.line_level > 0 && e.standard_error > 0)) return own;
  return std::min(own, line_quantile(q.tolerance / e.standard_error, q.line_level));
}

/// What none of n samples about c showed has a probability of at most ln(1/level)/n, and is taken
/// to deviate from c by no more than |c|, as a rejected sample does. That bounds the bias that may
/// hide.
double hidden_bias(double value, std::uint64_t n, double level) {
  return std::abs(value) * std::log(1 / level) / static_cast<double>(n);
}

/// What a difference must exceed to be one, besides its noise: samples that nearly agree say
/// nothing of one in thousands that is rejected and has not been seen, which noise of theirs does
/// not hold. An exact variance holds it; where single samples are not known there is nothing to
/// say.
double unseen(const MeanQuestion& q, const Evidence& e, std::uint64_t n, double level) {
  if (knows_variance(q) || std::isnan(e.smallest)) return 0;
  return hidden_bias(e.estimate, n, level);
}

void judge_zeros(const MeanQuestion& q, const Evidence& e, CheckResult& r) {
  const double distance = std::abs(q.reference);
  r.bound = distance;
  r.interval = {0, 0};
  if (distance <= q.rounding_allowance) {
    r.p_value = 1;
    if (e.samples >= kEnoughZerosToPass && distance <= q.tolerance) {
      r.verdict = Verdict::pass;
    } else {
      r.reason = "all samples are 0; 20000 are needed to trust that";
    }
    return;
  }
  if (e.samples >= kEnoughZerosToFail) r.verdict = Verdict::fail;
  r.reason = "all " + number(e.samples) + " samples are 0, the answer is " + number(q.reference);
}

/// Equal samples away from the answer, under an exact variance: fails when that is too improbable.
bool judge_improbable(const MeanQuestion& q, const Evidence& e, double excess, CheckResult& r) {
  if (!knows_variance(q) || !(*q.exact_variance > 0) || !(excess > 0)) return false;
  r.leaned_on = "exact variance";
  const double p = chance_of_distance(*q.exact_variance, excess, e.samples);
  r.p_value = p;
  r.bound = std::abs(e.estimate - q.reference);
  if (p <= q.fail_level) r.verdict = Verdict::fail;
  r.reason = "all " + number(e.samples) + " samples equal " + number(e.estimate) +
             ", the answer is " + number(q.reference);
  return true;
}

/// How far the mean of n samples within a range may be from its expectation at a level, one-sided.
/// @source Hoeffding 1963, Theorem 2
double hoeffding(double range, std::uint64_t n, double level) {
  return range * std::sqrt(std::log(1 / level) / (2 * static_cast<double>(n)));
}

/// What a failure says where nothing but its proof speaks against the code.
std::string though_small(const MeanQuestion& q, double bound) {
  if (!(bound <= q.tolerance)) return "";
  return ": a difference that is proven, and fails within the tolerance of " + number(q.tolerance) +
         " too, which is what a pass has to prove and not what is let go";
}

void judge_nearly_constant(const MeanQuestion& q, const Evidence& e, CheckResult& r) {
  r.leaned_on = "nearly equal samples";
  const double range = std::isfinite(e.largest - e.smallest) ? e.largest - e.smallest : 0.0;
  const double distance = std::abs(e.estimate - q.reference);
  const double excess = distance - q.rounding_allowance;
  if (judge_improbable(q, e, excess - range, r)) return;
  if (is_all_zero(e)) {
    judge_zeros(q, e, r);
    return;
  }
  const auto doubt = [&](std::uint64_t n, double level, double unseen_level) {
    return hoeffding(range, n, level) + hidden_bias(e.estimate, n, unseen_level);
  };
  const double half_width = doubt(e.samples, q.pass_level, std::max(q.pass_level, q.unseen_level));
  const double bound = distance + half_width;
  r.bound = bound;
  r.interval = {e.estimate - half_width, e.estimate + half_width};
  r.detectable = q.rounding_allowance + doubt(q.max_samples, q.last_fail_level, q.last_fail_level);
  r.p_value =
      excess > 0
          ? std::exp(-static_cast<double>(e.samples) * std::min(1.0, excess / std::abs(e.estimate)))
          : 1.0;
  if (e.samples < kMinimumSamples) {
    r.reason = "only " + number(e.samples) + " samples; at least 1000 are needed";
  } else if (misses_most(q, e)) {
    r.reason = most_is_missing(q, e);
  } else if (excess > doubt(e.samples, q.fail_level, q.fail_level)) {
    r.verdict = Verdict::fail;
    r.reason = "all samples are close to " + number(e.estimate) + ", the answer is " +
               number(q.reference) + though_small(q, bound);
  } else if (excess <= hoeffding(range, e.samples, q.pass_level) && bound <= q.tolerance) {
    r.verdict = Verdict::pass;
  } else {
    r.reason = "all samples are close to " + number(e.estimate) + "; " + number(e.samples) +
               " are too few to exclude what they have not shown";
  }
}

/// Equal samples but for a few that are off by no more than themselves, as where one in millions is
/// rejected: for long no look of theirs is free of skewness, but what deviates is bounded. One in a
/// hundred rejected makes the estimate smaller by 1 %, and the range that much larger beside it.
bool deviates_like_rejections(const Evidence& e) {
  return e.samples >= kMinimumSamples && e.largest - e.smallest <= 1.01 * std::abs(e.estimate);
}

/// A pass alone: that more is not to be seen is no proof of a difference.
void judge_rare_deviations(const MeanQuestion& q, const Evidence& e, CheckResult& r) {
  const double range = e.largest - e.smallest;
  const double squares = e.standard_error * e.standard_error;
  const double half_width =
      bernstein(squares, range / static_cast<double>(e.samples), q.pass_level);
  const double distance = std::abs(e.estimate - q.reference);
  const double bound = distance + half_width +
                       hidden_bias(e.estimate, e.samples, std::max(q.pass_level, q.unseen_level));
  if (!(distance - q.rounding_allowance <= half_width && bound <= q.tolerance)) return;
  r.verdict = Verdict::pass;
  r.reason.clear();
  r.leaned_on = "samples that deviate no more than rejected ones";
  r.bound = bound;
  r.interval = {e.estimate - half_width, e.estimate + half_width};
}

/// Smallest |bias| that ends in a fail with 99 % probability: it must be too large to pass (at the
/// tolerance a pass has a chance of 0.1 %) and seen at the cap at the latest (with 99.1 %).
double detectable_bias(const MeanQuestion& q, const Evidence& e) {
  const double at_cap = e.standard_error * std::sqrt(static_cast<double>(e.samples) /
                                                     static_cast<double>(q.max_samples));
  const double seen = q.rounding_allowance + unseen(q, e, q.max_samples, q.last_fail_level) +
                      (normal_quantile(q.last_fail_level / 2) + normal_quantile(0.009)) * at_cap;
  return std::max(q.tolerance, seen);
}

void judge_difference(const MeanQuestion& q, const Evidence& e, const std::string& doubt,
                      CheckResult& r) {
  const Interval pass =
      skewed_interval(e.estimate, e.standard_error, e.skewness, pass_quantile(q, e));
  const Interval fail = mean_interval(e, q.fail_level / 2);
  const double bound = std::max(pass.high - q.reference, q.reference - pass.low);
  const double no_difference = q.rounding_allowance + unseen(q, e, e.samples, q.fail_level);
  r.interval = pass;
  r.bound = bound;
  r.p_value = mean_p_value(e, q.reference);
  r.detectable = detectable_bias(q, e);
  if (!doubt.empty()) {
    r.reason = doubt;
  } else if (fail.low > q.reference + no_difference || fail.high < q.reference - no_difference) {
    r.verdict = Verdict::fail;
    r.reason = "estimate " + number(e.estimate) + " is " +
               number(std::abs(e.estimate - q.reference) / e.standard_error) +
               " standard errors from the answer " + number(q.reference) + though_small(q, bound);
  } else if (!(bound <= q.tolerance)) {
    r.reason = "neither a difference nor |bias| <= " + number(q.tolerance) + " is proven after " +
               number(e.samples) + " samples";
  } else if (!knows_variance(q) && !(e.tail_index > kTailLimit)) {
    r.reason = "the largest samples fall off with index " + number(e.tail_index) +
               " or less: the variance looks infinite";
  } else {
    r.verdict = Verdict::pass;
  }
}

}  // namespace

void set_look(MeanQuestion& q, const LookPlan& plan, std::size_t look) {
  q.fail_level = plan.fail_level[look];
  q.pass_level = plan.pass_level[look];
  q.line_level = plan.line_level;
  q.unseen_level = plan.unseen_level;
  q.last_fail_level = plan.fail_level.back();
  q.max_samples = plan.samples.back();
}

MeanQuestion agreement_question(const MeanOptions& options, const LookPlan& plan, std::size_t look,
                                double scale) {
  MeanQuestion q;
  q.reference = options.reference;
  q.tolerance = options.tolerance * scale;
  q.rounding_allowance = options.rounding_allowance * scale;
  set_look(q, plan, look);
  q.max_samples *= 2;
  return q;
}

Interval skewed_interval(double estimate, double error, double skewness, double quantile) {
  const double below = std::max(quantile, hall_inverse(quantile, skewness));
  const double above = std::max(quantile, -hall_inverse(-quantile, skewness));
  return {estimate - below * error, estimate + above * error};
}

double skewed_statistic(double u, double skewness) {
  const double corrected = hall(u, skewness);
  if (!(corrected * u > 0)) return 0;
  return std::min(std::abs(u), std::abs(corrected));
}

Interval mean_interval(const Evidence& e, double level) {
  return skewed_interval(e.estimate, e.standard_error, e.skewness, normal_quantile(level));
}

double mean_p_value(const Evidence& e, double reference) {
  const double u = (e.estimate - reference) / e.standard_error;
  if (std::isnan(u)) return 1;  // no error and no difference
  return std::min(1.0, 2 * normal_tail(skewed_statistic(u, e.skewness)));
}

CheckResult judge_mean(const MeanQuestion& q, const Evidence& seen) {
  CheckResult r;
  r.estimate = seen.estimate;
  r.reference = q.reference;
  r.tolerance = q.tolerance;
  r.samples = seen.samples;
  r.figures = {{Figure::standard_error, seen.standard_error},
               {Figure::skewness, seen.skewness},
               {Figure::largest_share, seen.largest_share},
               {Figure::rejected, static_cast<double>(seen.rejected)},
               {Figure::non_finite, static_cast<double>(seen.non_finite)}};
  if (seen.non_finite > 0) {
    r.verdict = Verdict::fail;
    r.reason = number(seen.non_finite) + " of " + number(seen.samples + seen.non_finite) +
               " samples were not finite";
    return r;
  }
  if (!std::isfinite(seen.estimate) || !std::isfinite(seen.standard_error)) {
    r.reason = "the samples are finite, their sum or the squares of their deviations are not";
    r.advice = "divide samples and answer by the size of the answer";
    return r;
  }
  const bool exact = knows_variance(q);
  if (is_nearly_constant(seen, q.tolerance)) {
    judge_nearly_constant(q, seen, r);
    return r;
  }
  const Evidence e = exact ? with_exact_variance(seen, *q.exact_variance) : seen;
  r.leaned_on = exact ? "exact variance" : "skewness guard";
  std::string doubt = guard(e);
  if (doubt.empty() && exact) doubt = exact_variance_doubt(seen, e);
  if (doubt.empty() && !exact && misses_most(q, seen)) doubt = most_is_missing(q, seen);
  if (q.exact_variance && std::isinf(*q.exact_variance))
    doubt = "the variance is known to be infinite";
  judge_difference(q, e, doubt, r);
  if (!doubt.empty() && !q.exact_variance && deviates_like_rejections(seen)) {
    judge_rare_deviations(q, seen, r);
  }
  return r;
}

}  // namespace plumbline::verify
