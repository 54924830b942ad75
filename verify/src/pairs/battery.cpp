#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <plumbline/verify/detail/stopwatch.h>
#include <plumbline/verify/pair.h>

#include "diagnosis/constant_diagnosis.h"
#include "diagnosis/diagnosis.h"
#include "pairs/binned_pair.h"
#include "pairs/chi_square_look.h"
#include "pairs/integral_check.h"
#include "pairs/jacobian.h"
#include "pairs/mass_balance.h"
#include "pairs/pointwise.h"

namespace plumbline::verify {

namespace {

/// What the bins show, at the finest level that still counts at least 100 in most of them.
RatioEvidence bin_evidence(const BinnedPair& binned) {
  constexpr double kCountsPerBin = 100;
  RatioEvidence e;
  e.quotient = "observed/expected";
  e.denominator = "pdf";
  const double n = static_cast<double>(binned.counts().drawn);
  e.strays = binned.counts().strays;
  e.stray_share = static_cast<double>(binned.counts().stray) / n;
  const int depth = std::clamp(static_cast<int>(std::log2(n / kCountsPerBin)), 0, binned.depth());
  const BinTable table = table_of(binned, depth);
  for (std::size_t i = 0; i < table.expected.size(); ++i) {
    if (table.observed[i] < kCountsPerBin / 4 || !(table.expected[i] > 0)) continue;
    // A logarithm of a count has variance 1/count.
    e.points.push_back(
        {binned.center(depth, i), table.observed[i] / table.expected[i], table.observed[i]});
  }
  e.noise = 1;
  return e;
}

/// All failing results of a pair get the best of the diagnoses: they share one cause more often
/// than not.
class Cause {
 public:
  void consider(const SamplingPair& pair, const RatioEvidence& evidence) {
    Diagnosis found = diagnose(pair, evidence);
    // Exact ratios come first and are not outdone by a fit to noise.
    if (!found.text.empty() && found.r_squared > best_.r_squared + 0.01) best_ = std::move(found);
  }
  const Diagnosis& best() const { return best_; }

 private:
  Diagnosis best_;
};

}  // namespace

PairOutcome judge_pair(const SamplingPair& pair, const ContractOptions& options) {
  std::vector<CheckResult> results;
  Cause cause;
  for (PointwiseOutcome& outcome : judge_pointwise(pair, options)) {
    if (outcome.result.verdict == Verdict::fail) cause.consider(pair, outcome.evidence);
    results.push_back(std::move(outcome.result));
  }
  JacobianOutcome jacobian = judge_jacobian(pair, options);
  if (jacobian.result.verdict == Verdict::fail) cause.consider(pair, jacobian.evidence);
  results.push_back(std::move(jacobian.result));

  Stopwatch watch;
  BinnedPair binned(pair, options.finest_bins, options.mass_tolerance / 2, options.seed);
  const RejectedShare rejected = measure_rejected(pair, options.seed);
  const double integration = watch.lap();
  CheckResult chi_square = run_chi_square(options, binned, rejected);
  chi_square.seconds = watch.lap();
  results.push_back(judge_integral(options, binned, rejected));
  results.back().seconds = integration + watch.lap();
  if (chi_square.verdict == Verdict::fail) cause.consider(pair, bin_evidence(binned));
  results.push_back(std::move(chi_square));

  for (CheckResult& r : results) {
    if (r.verdict == Verdict::fail) r.diagnosis = cause.best().text;
  }
  return {std::move(results), cause.best()};
}

Report check_pair(const SamplingPair& pair, const ContractOptions& options) {
  return judge_pair(pair, options).results;
}

}  // namespace plumbline::verify
