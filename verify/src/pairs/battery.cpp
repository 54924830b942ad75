#include "pairs/battery.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pairs/binned_pair.h"
#include "pairs/chi_square_look.h"
#include "pairs/integral_check.h"
#include "pairs/jacobian.h"
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

  BinnedPair binned(pair, options);
  const RejectedShare rejected = measure_rejected(pair, options.seed);
  CheckResult chi_square = run_chi_square(options, binned, rejected);
  results.push_back(judge_integral(options, binned, rejected));
  if (chi_square.verdict == Verdict::fail) cause.consider(pair, bin_evidence(binned));
  results.push_back(std::move(chi_square));
  const BinCounts& counts = binned.counts();

  for (CheckResult& r : results) {
    if (r.verdict == Verdict::fail) r.diagnosis = cause.best().text;
  }
  return {std::move(results), cause.best(), counts.rejected == counts.drawn, !counts.atoms.empty()};
}

CheckResult nothing_sampled(const std::string& name, const ContractOptions& options,
                            const std::string& advice) {
  CheckResult r;
  r.check = "samples";
  r.subject = name + "/samples";
  r.seed = options.seed;
  r.reason = advice;
  return r;
}

std::vector<CheckResult> check_pair(const SamplingPair& pair, const ContractOptions& options) {
  PairOutcome outcome = judge_pair(pair, options);
  if (outcome.nothing) {
    outcome.results.push_back(nothing_sampled(
        pair.name, options,
        "the sampler rejected every random number, so that nothing was tested: does it take them "
        "as it is given them, and is what it is asked about (direction, side, light) one that it "
        "samples?"));
  }
  return std::move(outcome.results);
}

}  // namespace plumbline::verify
