#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <plumbline/verify/detail/stopwatch.h>
#include <plumbline/verify/ratio.h>

#include "distributions.h"
#include "means/proportion_claim.h"

namespace plumbline::verify {

namespace {

/// @param level  one-sided, of each end
Interval clopper_pearson(double hits, double trials, double level) {
  Interval interval{0, 1};
  if (hits > 0) interval.low = beta_quantile(level, hits, trials - hits + 1);
  if (hits < trials) interval.high = beta_quantile(1 - level, hits + 1, trials - hits);
  return interval;
}

/// Two-sided p-value of the edge of the claim that is the least well kept.
double claim_p_value(const ProportionOptions& o, double share, double hits, double trials) {
  if (share > o.at_most && hits > 0) {
    return std::min(1.0, 2 * binomial_at_least(hits, trials, o.at_most));
  }
  if (share < o.at_least && hits < trials) {
    return std::min(1.0, 2 * binomial_at_least(trials - hits, trials, 1 - o.at_least));
  }
  return 1;
}

}  // namespace

CheckResult check_proportion(const ProportionOptions& o, std::uint64_t hits, std::uint64_t trials) {
  if (trials == 0 || hits > trials || !(o.at_least >= 0) || !(o.at_most <= 1) ||
      !(o.at_least <= o.at_most)) {
    throw std::invalid_argument("proportion check '" + o.subject +
                                "': needs hits ≤ trials ≥ 1 and 0 ≤ at_least ≤ at_most ≤ 1");
  }
  const Stopwatch watch;
  const double k = static_cast<double>(hits), n = static_cast<double>(trials);
  const Interval proven = clopper_pearson(k, n, o.budget.pass_level() / 2);
  const Interval sure = clopper_pearson(k, n, o.budget.fail_level() / 2);
  CheckResult r;
  r.kind = CheckKind::proportion;
  r.subject = o.subject;
  r.expected = o.expected;
  r.seed = o.seed;
  r.samples = trials;
  r.estimate = k / n;
  r.p_value = claim_p_value(o, k / n, k, n);
  r.leaned_on = "exact binomial interval";
  r.figures = {{Figure::hits, k}, {Figure::at_least, o.at_least}, {Figure::at_most, o.at_most}};
  judge_proportion_claim(o, proven, sure, r);
  if (r.verdict == Verdict::inconclusive) r.advice = "more trials narrow it";
  r.seconds = watch.seconds();
  return r;
}

}  // namespace plumbline::verify
