#include <cmath>
#include <stdexcept>

#include <plumbline/verify/mean.h>

#include "means/mean_judgement.h"

namespace plumbline::verify {

CheckResult check_agreement(const MeanOptions& options, const MomentSampler& a,
                            const MomentSampler& b) {
  if (!(options.tolerance > 0) || !std::isfinite(options.reference)) {
    throw std::invalid_argument("agreement check '" + options.subject +
                                "': needs a positive tolerance");
  }
  const Stopwatch watch;
  const LookPlan plan = plan_mean_looks(options.n0, options.max_samples, options.budget);
  Moments moments_a, moments_b;
  CheckResult result;
  std::uint64_t drawn = 0;
  for (std::size_t look = 0; look < plan.samples.size(); ++look) {
    moments_a.merge(a(drawn, plan.samples[look] - drawn));
    moments_b.merge(b(drawn, plan.samples[look] - drawn));
    drawn = plan.samples[look];
    const double scale =
        options.relative ? (std::abs(moments_a.mean()) + std::abs(moments_b.mean())) / 2 : 1.0;
    result = judge_mean(agreement_question(options, plan, look, scale),
                        difference(evidence(moments_a), evidence(moments_b)));
    if (result.verdict != Verdict::inconclusive) break;
  }
  if (result.verdict == Verdict::inconclusive) result.advice = "raise `max_samples`";
  result.kind = CheckKind::agreement;
  result.seconds = watch.seconds();
  result.subject = options.subject;
  result.expected = options.expected;
  result.seed = options.seed;
  result.figures.insert(result.figures.begin(), {{Figure::mean_of_a, moments_a.mean()},
                                                 {Figure::mean_of_b, moments_b.mean()}});
  return result;
}

}  // namespace plumbline::verify
