#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <plumbline/verify/pair.h>

#include "pairs/battery.h"
#include "pairs/binned_pair.h"
#include "pairs/chi_square_look.h"
#include "pairs/integral_check.h"
#include "pairs/jacobian.h"
#include "pairs/mass_balance.h"
#include "pairs/pointwise.h"

namespace plumbline::verify {

namespace {

/// The bins at the finest level that still counts about 100 in each.
std::vector<BinSeen> bins_seen(const BinnedPair& binned) {
  constexpr double kCountsPerBin = 100;
  const double n = static_cast<double>(binned.counts().drawn);
  const int depth = std::clamp(static_cast<int>(std::log2(n / kCountsPerBin)), 0, binned.depth());
  const BinTable table = table_of(binned, depth);
  const int finer = binned.depth() - depth;
  std::vector<BinSeen> bins(table.expected.size());
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].observed = table.observed[i];
    bins[i].expected = table.expected[i];
    double error2 = 0, total = 0;
    for (std::size_t fine = i << finer; fine < (i + 1) << finer; ++fine) {
      if (fine >= binned.expected().value.size()) continue;
      // Errors of cells are bounds rather than standard errors.
      error2 += std::pow(n * binned.expected().error[fine] / 3, 2);
      for (const BinnedPair::Node& node : binned.nodes_of(fine)) {
        bins[i].nodes.push_back(node.x);
        bins[i].shares.push_back(node.mass);
        bins[i].measures.push_back(node.measure);
        total += node.mass;
      }
    }
    bins[i].expected_error = std::sqrt(error2);
    for (double& share : bins[i].shares) share = total > 0 ? share / total : 0;
  }
  return bins;
}

MassSeen mass_seen(const BinnedPair& binned, const RejectedShare& rejected,
                   const ContractOptions& options) {
  const MassBalance mass = balance_mass(binned, rejected, options.budget.fail_level());
  MassSeen seen;
  seen.integral = mass.integral;
  seen.integral_error = mass.integral_error + (options.mass_tolerance + binned.rounding());
  seen.atoms = mass.atoms;
  seen.rejected = mass.rejected.value;
  seen.rejected_error = mass.rejected.error;
  return seen;
}

}  // namespace

PairOutcome judge_pair(const SamplingPair& pair, const ContractOptions& options) {
  std::vector<CheckResult> results;
  ViewEvidence view;
  view.pair = &pair;
  for (PointwiseOutcome& outcome : judge_pointwise(pair, options)) {
    if (!outcome.ratios.points.empty()) view.ratios.push_back(std::move(outcome.ratios));
    results.push_back(std::move(outcome.result));
  }
  JacobianOutcome jacobian = judge_jacobian(pair, options);
  for (RatioSeries& s : jacobian.ratios) view.ratios.push_back(std::move(s));
  results.push_back(std::move(jacobian.result));

  BinnedPair binned(pair, options.finest_bins, options.mass_tolerance / 2, options.seed);
  const RejectedShare rejected = measure_rejected(pair, options.seed);
  CheckResult chi_square = run_chi_square(options, binned, rejected);
  results.push_back(judge_integral(options, binned, rejected));
  results.push_back(std::move(chi_square));
  view.samples = static_cast<double>(binned.counts().drawn);
  view.bins = bins_seen(binned);
  view.mass = mass_seen(binned, rejected, options);
  view.strays = binned.counts().strays;
  view.stray_share = static_cast<double>(binned.counts().stray) / std::max(1.0, view.samples);
  for (const CheckResult& r : results) view.failed = view.failed || r.verdict == Verdict::fail;
  return {std::move(results), std::move(view)};
}

void name_cause(const Cause& cause, std::vector<CheckResult>& results) {
  std::string text = cause.headline;
  if (!cause.second.empty()) text += "; or: " + cause.second;
  for (CheckResult& r : results) {
    if (r.verdict == Verdict::fail) r.diagnosis = text;
  }
}

std::vector<CheckResult> check_pair(const SamplingPair& pair, const ContractOptions& options) {
  PairOutcome outcome = judge_pair(pair, options);
  if (outcome.view.failed) {
    name_cause(diagnose({{std::move(outcome.view)}, {}, {}}), outcome.results);
  }
  return std::move(outcome.results);
}

}  // namespace plumbline::verify
