#include <utility>

#include <plumbline/verify/detail/stopwatch.h>

#include "joints/joint_checks.h"
#include "pairs/battery.h"

namespace plumbline::verify {

namespace {

/// Samples are as dense as the pdf says, and wherever the map was followed it is less dense: it
/// reaches its points on several ways.
void skip_one_of_several_ways(CheckResult& jacobian) {
  jacobian.verdict = jacobian.expected = Verdict::inconclusive;
  jacobian.reason =
      "skipped: the samples follow the pdf, and the map is less dense wherever it was followed: "
      "several random numbers lead to one point (many_to_one)";
}

}  // namespace

Report check_pair(const JointPair& pair, const ContractOptions& options) {
  require_usable(pair, options);
  Report report(judge_joint_pointwise(pair, options));
  JointJacobian jacobian = judge_joint_jacobian(pair, options);
  Stopwatch watch;
  JointBins bins(pair, options);
  const CountedShare rejected = bins.rejected();
  CheckResult integral = judge_joint_integral(bins, rejected, options);
  integral.seconds = watch.lap();
  CheckResult chi_square = run_joint_chi_square(bins, rejected, options);
  chi_square.seconds = watch.lap();
  if (jacobian.result.verdict == Verdict::fail && jacobian.below_everywhere &&
      integral.verdict == Verdict::pass && chi_square.verdict == Verdict::pass) {
    skip_one_of_several_ways(jacobian.result);
  }
  for (CheckResult* r : {&jacobian.result, &integral, &chi_square}) {
    report.results.push_back(std::move(*r));
  }
  if (bins.counts().rejected == bins.counts().drawn) {
    report.results.push_back(nothing_sampled(
        pair.name, options, "the sampler rejected every random number, so that nothing was tested",
        "see that it takes them as it is given them"));
  }
  return report;
}

}  // namespace plumbline::verify
