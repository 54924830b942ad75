#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <plumbline/verify/history/confidence_sequence.h>

#include "distributions.h"
#include "history/code_change.h"
#include "means/central_moments.h"
#include "means/mean_judgement.h"
#include "means/ratio_claim.h"
#include "text.h"

namespace plumbline::verify::history {

namespace {

// At levels that can be simulated a quarter of it would do, thanks to the guard on skewness
// (docs/statistics.md, "Over nights"); at 1e-12 Student's reach is 13 standard errors here already.
constexpr std::uint64_t kFewestBatches = 64;

/// x = tρ² at the target: x = ln(x + 1) − 2 ln level. The right side rises by less than x does.
double best_mixture(double level) {
  const double c = -2 * std::log(level);
  double x = c + std::log1p(c);
  for (int i = 0; i < 60; ++i) x = c + std::log1p(x);
  return x;
}

/// tρ² after `count` values.
double mixture_at(double count, double target, double level) {
  return best_mixture(level) * count / target;
}

/// The same reach by Student's t: as rarely exceeded at one time.
double student_reach(double reach, double degrees) {
  return student_quantile(normal_tail(reach), degrees);
}

/// The level at which the mixture of a level just excludes a two-sided p-value of Student's t.
double anytime_p_value(double t, double degrees, double mixture) {
  const double p = student_two_sided(t, degrees);
  if (!(p > 0)) return 0;
  if (p >= 1) return 1;
  const double z = normal_quantile(p / 2);
  return std::min(1.0, std::sqrt(1 + mixture) * std::exp(-z * z * mixture / (2 * (mixture + 1))));
}

CentralMoments central(const BatchMoments& b) {
  return {static_cast<double>(b.batches), b.mean, b.m2, b.m3};
}

Evidence evidence_of(const BatchMoments& b) {
  const double n = static_cast<double>(b.batches);
  Evidence e;
  e.samples = b.batches * b.samples_per_batch;
  e.estimate = b.mean;
  e.standard_error = n > 1 ? std::sqrt(b.m2 / (n - 1) / n) : 0.0;
  e.skewness = b.m2 > 0 ? b.m3 / (b.m2 * std::sqrt(b.m2)) : 0.0;
  e.largest_share = largest_share(central(b), b.smallest, b.largest);
  e.non_finite = b.non_finite;
  return e;
}

MeanQuestion question(const MeanSequenceOptions& o, double batches, std::uint64_t samples) {
  const auto level = [&](double of_sequence) {
    const double reach = mixture_reach(batches, o.target_batches, of_sequence);
    return normal_tail(student_reach(reach, batches - 1));
  };
  MeanQuestion q;
  q.reference = o.reference;
  q.tolerance = o.tolerance;
  q.rounding_allowance = o.rounding_allowance;
  q.fail_level = 2 * level(o.budget.fail_level());
  q.pass_level = level(o.budget.pass_level());
  q.last_fail_level = q.fail_level;
  q.max_samples = samples;
  return q;
}

/// Why it is too early to judge; empty if it is not.
std::string too_early(const BatchMoments& all, double target) {
  const double fewest = std::max(static_cast<double>(kFewestBatches), target / 64);
  if (static_cast<double>(all.batches) < fewest) {
    return "only " + number(all.batches) + " batches; at least " + number(std::ceil(fewest)) +
           " are needed";
  }
  if (!(all.m2 > 0)) return "all batches are equal: what none has shown is not bounded";
  return {};
}

}  // namespace

ErrorBudget night_budget() {
  ErrorBudget budget;
  budget.suite_level = kNightLevel;
  return budget;
}

double mixture_reach(double count, double target, double level) {
  if (!(count > 0 && target > 0 && level > 0 && level < 1)) {
    throw std::invalid_argument(
        "confidence sequence: needs a positive count and target, and a level between 0 and 1");
  }
  const double x = mixture_at(count, target, level);
  return std::sqrt((x + 1) / x * (std::log1p(x) - 2 * std::log(level)));
}

void BatchMoments::add(double batch_mean, std::uint64_t samples) {
  BatchMoments one;
  one.samples_per_batch = samples;
  if (std::isfinite(batch_mean)) {
    one.batches = 1;
    one.mean = one.smallest = one.largest = batch_mean;
  } else {
    one.non_finite = 1;
  }
  merge(one);
}

void BatchMoments::merge(const BatchMoments& other) {
  if (other.samples_per_batch == 0) return;
  if (samples_per_batch != 0 && samples_per_batch != other.samples_per_batch) {
    throw std::invalid_argument("batches of " + number(other.samples_per_batch) +
                                " samples cannot join those of " + number(samples_per_batch));
  }
  samples_per_batch = other.samples_per_batch;
  non_finite += other.non_finite;
  if (other.batches == 0) return;
  const CentralMoments both = merged(central(*this), central(other));
  batches += other.batches;
  mean = both.mean;
  m2 = both.m2;
  m3 = both.m3;
  smallest = std::min(smallest, other.smallest);
  largest = std::max(largest, other.largest);
}

bool MeanSequence::add_night(std::string_view code_hash, const BatchMoments& night) {
  if (nights > 0 && night.samples_per_batch != 0 && all.samples_per_batch != 0 &&
      night.samples_per_batch != all.samples_per_batch) {
    *this = {};
  }
  const bool again = start_again(*this, code_hash);
  ++nights;
  all.merge(night);
  return again;
}

CheckResult judge_sequence(const MeanSequence& sequence, const MeanSequenceOptions& options) {
  if (!(options.target_batches > 0)) {
    throw std::invalid_argument("confidence sequence '" + options.subject +
                                "': the target must be positive");
  }
  const BatchMoments& all = sequence.all;
  const double n = static_cast<double>(all.batches);
  const Evidence e = evidence_of(all);
  const std::string early = too_early(all, options.target_batches);
  CheckResult r;
  if (early.empty() || all.non_finite > 0) {
    const double batches = std::max(n, static_cast<double>(kFewestBatches));
    r = judge_mean(question(options, batches, e.samples), e);
    const double u = (e.estimate - options.reference) / e.standard_error;
    r.p_value =
        anytime_p_value(skewed_statistic(u, e.skewness), batches - 1,
                        mixture_at(batches, options.target_batches, options.budget.fail_level()));
  } else {
    r.estimate = e.estimate;
    r.reference = options.reference;
    r.tolerance = options.tolerance;
    r.samples = e.samples;
    r.reason = early;
  }
  r.kind = CheckKind::mean;
  r.subject = options.subject;
  r.leaned_on = "asymptotic confidence sequence, skewness guard";
  r.figures.push_back({"nights", static_cast<double>(sequence.nights)});
  r.figures.push_back({Figure::batches, n});
  return r;
}

bool RatioSequence::add_night(std::string_view code_hash, double log_ratio, double error,
                              double batches) {
  if (!std::isfinite(log_ratio) || !(error >= 0 && std::isfinite(error)) || !(batches >= 2)) {
    throw std::invalid_argument("sequence of ratios: a night with logarithm " + number(log_ratio) +
                                ", error " + number(error) + " and " + number(batches) +
                                " batches says nothing");
  }
  const bool again = start_again(*this, code_hash);
  ++nights;
  logs.add(log_ratio, 1);
  squared_errors += error * error;
  degrees += batches - 1;
  return again;
}

CheckResult judge_sequence(const RatioSequence& sequence, const RatioSequenceOptions& options) {
  CheckResult r;
  r.kind = CheckKind::variance_ratio;
  r.subject = options.claim.subject;
  r.expected = options.claim.expected;
  r.reference = options.claim.at_least ? options.claim.at_least : options.claim.at_most;
  r.leaned_on = "asymptotic confidence sequence of " + number(sequence.nights) + " nights";
  if (sequence.nights == 0) {
    r.reason = "no night is in yet";
    return r;
  }
  const double n = static_cast<double>(sequence.nights), log_ratio = sequence.logs.mean;
  const double stated = sequence.squared_errors / n;
  const double seen = n > 1 ? sequence.logs.m2 / (n - 1) : 0;
  const double error = std::sqrt(std::max(stated, seen) / n);
  const auto interval = [&](double level) {
    const double reach =
        error * student_reach(mixture_reach(n, options.target_nights, level), sequence.degrees);
    return Interval{std::exp(log_ratio - reach), std::exp(log_ratio + reach)};
  };
  const Interval proven = interval(options.budget.pass_level());
  r.estimate = std::exp(log_ratio);
  r.interval = proven;
  r.figures = {{"nights", n}, {Figure::standard_error, error}};
  judge_ratio_claim(options.claim, proven, interval(options.budget.fail_level()), r);
  return r;
}

}  // namespace plumbline::verify::history
