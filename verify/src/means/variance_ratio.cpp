#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <plumbline/verify/detail/stopwatch.h>
#include <plumbline/verify/ratio.h>

#include "distributions.h"
#include "means/mean_judgement.h"
#include "means/ratio_claim.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kMinimumBatches = 16;

/// A variance estimated from all batches, and from all but one of them.
struct LeaveOneOut {
  double all = 0;
  std::vector<double> without;
  double largest_share = 0;  ///< of one batch
  std::uint64_t samples = 0, non_finite = 0;
};

LeaveOneOut leave_one_out(std::span<const Moments> batches) {
  LeaveOneOut result;
  const std::size_t n = batches.size();
  // Merged before and after each batch: all leave-one-out merges in linear time.
  std::vector<Moments> after(n + 1);
  for (std::size_t i = n; i-- > 0;) {
    after[i] = after[i + 1];
    after[i].merge(batches[i]);
  }
  const Moments& all = after[0];
  Moments before;
  for (std::size_t i = 0; i < n; ++i) {
    Moments rest = before;
    rest.merge(after[i + 1]);
    result.without.push_back(rest.variance());
    before.merge(batches[i]);
    const double offset = batches[i].mean() - all.mean();
    const double squares =
        batches[i].m2() + static_cast<double>(batches[i].count()) * offset * offset;
    result.largest_share = std::max(result.largest_share, squares / all.m2());
  }
  result.all = all.variance();
  result.samples = all.count();
  result.non_finite = all.non_finite();
  return result;
}

LeaveOneOut leave_one_out(std::span<const double> batches) {
  LeaveOneOut result;
  double sum = 0;
  for (const double x : batches) {
    if (!std::isfinite(x)) ++result.non_finite;
    sum += x;
  }
  const double n = static_cast<double>(batches.size());
  for (const double x : batches) {
    result.without.push_back((sum - x) / (n - 1));
    result.largest_share = std::max(result.largest_share, x / sum);
  }
  result.all = sum / n;
  result.samples = batches.size();
  return result;
}

/// Standard error and skewness of log(a/b) by the jackknife.
struct JackknifedLog {
  double error = 0, skewness = 0;
};

JackknifedLog jackknife(const LeaveOneOut& a, const LeaveOneOut& b) {
  const double n = static_cast<double>(a.without.size());
  std::vector<double> logs;
  double mean = 0;
  for (std::size_t i = 0; i < a.without.size(); ++i) {
    logs.push_back(std::log(a.without[i] / b.without[i]));
    mean += logs.back() / n;
  }
  double squares = 0, cubes = 0;
  for (const double x : logs) {
    // What a batch adds lowers the logarithm that leaves it out.
    const double added = mean - x;
    squares += added * added;
    cubes += added * added * added;
  }
  JackknifedLog result;
  result.error = std::sqrt(squares * (n - 1) / n);
  if (squares > 0) result.skewness = cubes / (squares * std::sqrt(squares));
  return result;
}

/// Two-sided p-value of the ratio lying on the edge of the claim that is the least well kept.
double claim_p_value(const VarianceRatioOptions& options, double log_ratio,
                     const JackknifedLog& jackknifed, double degrees) {
  const auto p_at = [&](double claim) {
    const double t = (log_ratio - std::log(claim)) / jackknifed.error;
    return student_two_sided(skewed_statistic(t, jackknifed.skewness), degrees);
  };
  double p = 1;
  if (options.at_least && log_ratio < std::log(*options.at_least)) p = p_at(*options.at_least);
  if (options.at_most && log_ratio > std::log(*options.at_most)) {
    p = std::min(p, p_at(*options.at_most));
  }
  return p;
}

CheckResult judge_ratio(const VarianceRatioOptions& options, const LeaveOneOut& a,
                        const LeaveOneOut& b) {
  CheckResult r;
  r.kind = CheckKind::variance_ratio;
  r.subject = options.subject;
  r.expected = options.expected;
  r.seed = options.seed;
  r.samples = a.samples + b.samples;
  r.leaned_on = "jackknife over " + number(std::uint64_t{a.without.size()}) + " batches";
  r.estimate = a.all / b.all;
  r.reference = options.at_least ? options.at_least : options.at_most;
  r.figures = {{Figure::variance_of_a, a.all},
               {Figure::variance_of_b, b.all},
               {Figure::largest_batch_of_a, a.largest_share},
               {Figure::largest_batch_of_b, b.largest_share},
               {Figure::batches, static_cast<double>(a.without.size())}};
  if (options.at_least) r.figures.emplace_back(Figure::at_least, *options.at_least);
  if (options.at_most) r.figures.emplace_back(Figure::at_most, *options.at_most);
  if (a.non_finite + b.non_finite > 0) {
    r.verdict = Verdict::fail;
    r.reason = number(a.non_finite + b.non_finite) + " samples or batches were not finite";
    return r;
  }
  if (!(a.all > 0 && b.all > 0)) {
    r.reason = "a variance is 0: the ratio says nothing";
    return r;
  }
  const double degrees = static_cast<double>(a.without.size() - 1);
  const double log_ratio = std::log(a.all / b.all);
  const JackknifedLog jackknifed = jackknife(a, b);
  const double error = jackknifed.error;
  r.figures.push_back({Figure::error_of_logarithm, error});
  const auto interval = [&](double level) {
    return skewed_interval(log_ratio, error, jackknifed.skewness, student_quantile(level, degrees));
  };
  const Interval pass = interval(options.budget.pass_level() / 2);
  const Interval fail = interval(options.budget.fail_level() / 2);
  const Interval proven{std::exp(pass.low), std::exp(pass.high)};
  r.interval = proven;
  r.p_value = claim_p_value(options, log_ratio, jackknifed, degrees);
  // As a factor: a ratio this far beyond the claim fails with 99 % probability.
  r.detectable = std::exp(std::max(fail.high - log_ratio, log_ratio - fail.low) +
                          student_quantile(0.01, degrees) * error);
  if (!std::isfinite(error)) {
    r.reason = "a single batch holds all of a variance";
    r.advice = "larger batches, until several of them vary";
  } else if (!(std::max(a.largest_share, b.largest_share) <= kBatchShareLimit)) {
    r.reason = "one batch carries " + number(100 * std::max(a.largest_share, b.largest_share)) +
               " % of a variance (limit 25 %): its tail decides the ratio";
    r.advice = "more and larger batches, until no single sample carries a variance";
  } else {
    judge_ratio_claim(options, proven, {std::exp(fail.low), std::exp(fail.high)}, r);
  }
  return r;
}

template <class Batch>
CheckResult check(const VarianceRatioOptions& options, std::span<const Batch> a,
                  std::span<const Batch> b) {
  if (a.size() != b.size() || a.size() < kMinimumBatches) {
    throw std::invalid_argument("variance ratio '" + options.subject +
                                "': needs equally many batches of a and b, at least 16");
  }
  const Stopwatch watch;
  CheckResult result = judge_ratio(options, leave_one_out(a), leave_one_out(b));
  result.seconds = watch.seconds();
  return result;
}

}  // namespace

void judge_ratio_claim(const VarianceRatioOptions& options, const Interval& proven,
                       const Interval& sure, CheckResult& r) {
  const bool breaks_low = options.at_least && sure.high < *options.at_least;
  const bool breaks_high = options.at_most && sure.low > *options.at_most;
  const bool keeps_low = !options.at_least || proven.low >= *options.at_least;
  const bool keeps_high = !options.at_most || proven.high <= *options.at_most;
  if (breaks_low) {
    r.verdict = Verdict::fail;
    r.reason = "the ratio is at most " + number(sure.high) + ", the claim is at least " +
               number(*options.at_least);
  } else if (breaks_high) {
    r.verdict = Verdict::fail;
    r.reason = "the ratio is at least " + number(sure.low) + ", the claim is at most " +
               number(*options.at_most);
  } else if (keeps_low && keeps_high) {
    r.verdict = Verdict::pass;
  } else {
    r.reason = "the interval straddles the claim";
    r.advice = "larger batches narrow it, all of them";
  }
}

CheckResult check_variance_ratio(const VarianceRatioOptions& options, std::span<const Moments> a,
                                 std::span<const Moments> b) {
  return check(options, a, b);
}

CheckResult check_variance_ratio(const VarianceRatioOptions& options, std::span<const double> a,
                                 std::span<const double> b) {
  return check(options, a, b);
}

}  // namespace plumbline::verify
