#include "pairs/battery.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <plumbline/verify/detail/stopwatch.h>

#include "pairs/binned_pair.h"
#include "pairs/chi_square_look.h"
#include "pairs/integral_check.h"
#include "pairs/inverse.h"
#include "pairs/jacobian.h"
#include "pairs/pointwise.h"
#include "pairs/rejected_share.h"

namespace plumbline::verify {

namespace {

/// The bins at the finest level that still counts about 100 in each.
std::vector<BinSeen> bins_of(const BinnedPair& binned) {
  constexpr double kCountsPerBin = 100;
  const double n = static_cast<double>(binned.counts().drawn);
  const int depth = std::clamp(static_cast<int>(std::log2(n / kCountsPerBin)), 0, binned.depth());
  const BinTable table = table_of(binned, depth);
  const int finer = binned.depth() - depth;
  const auto nodes = binned.nodes();
  std::vector<BinSeen> bins(table.expected.size());
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].observed = table.observed[i];
    bins[i].expected = table.expected[i];
    double total = 0;
    for (std::size_t fine = i << finer; fine < (i + 1) << finer; ++fine) {
      if (fine >= nodes.size()) continue;
      for (const BinnedPair::Node& node : nodes[fine]) {
        bins[i].nodes.push_back(node.x);
        bins[i].shares.push_back(node.mass);
        bins[i].measures.push_back(node.measure);
        total += node.mass;
      }
    }
    bins[i].expected_error = std::sqrt(table.variance[i]);
    for (double& share : bins[i].shares) share = total > 0 ? share / total : 0;
  }
  return bins;
}

/// Samples are as dense as the pdf says, and wherever the map was followed it is less dense: it
/// reaches its points on several ways, of which the check knows one.
void skip_single_branches(CheckResult& jacobian) {
  if (jacobian.verdict != Verdict::fail) return;
  jacobian.verdict = jacobian.expected = Verdict::inconclusive;
  jacobian.reason =
      "skipped: the samples follow the pdf, and single branches of the map are less dense; with "
      "lobes exposed (lobe_count, lobe_probability, sample_lobe, pdf_lobe) they are checked one by "
      "one";
}

MassSeen mass_seen(const BinnedPair& binned, const RejectedShare& rejected,
                   const ContractOptions& options) {
  const MassBalance mass = balance_mass(binned, rejected);
  const double level = options.budget.fail_level() / 2;
  MassSeen seen;
  seen.integral = mass.integral.total;
  seen.integral_error = mass.integral.error(level) + mass_tolerance(options, binned);
  seen.atoms = mass.atoms;
  seen.rejected = mass.rejected.value;
  seen.rejected_error = mass.rejected.error(level);
  return seen;
}

}  // namespace

PairBattery::PairBattery(const SamplingPair& pair, const ContractOptions& options,
                         Progress& progress)
    : pair_(pair), options_(options), progress_(progress) {
  outcome_.view.pair = &pair;
}

void PairBattery::judge_points() {
  progress_.looks_at(pair_.name + ": points");
  std::vector<CheckResult>& results = outcome_.results;
  for (PointwiseOutcome& outcome : judge_pointwise(pair_, options_)) {
    if (!outcome.ratios.points.empty()) outcome_.view.ratios.push_back(std::move(outcome.ratios));
    results.push_back(std::move(outcome.result));
    progress_.decided(results.back());
  }
  progress_.looks_at(pair_.name + ": Jacobian");
  jacobian_ = judge_jacobian(pair_, options_);
  jacobian_at_ = results.size();
  results.push_back(jacobian_.result);
  if (!jacobian_.below_everywhere) progress_.decided(results.back());
  if (!has_inverse(pair_)) return;
  results.push_back(judge_inverse(pair_, options_));
  progress_.decided(results.back());
}

void PairBattery::judge_samples() {
  Stopwatch watch;
  progress_.looks_at(pair_.name + ": integral");
  const double error = mass_error(options_);
  BinnedPair& binned = binned_.emplace(pair_, options_, error);
  const RejectedShare rejected = measure_rejected(pair_, options_, error);
  const double integration = watch.lap();
  progress_.looks_at(pair_.name + ": chi-square");
  CheckResult chi_square = run_chi_square(options_, binned, rejected);
  chi_square.seconds = watch.lap();
  CheckResult integral = judge_integral(options_, binned, rejected);
  integral.seconds = integration + watch.lap();
  if (jacobian_.below_everywhere && integral.verdict == Verdict::pass &&
      chi_square.verdict == Verdict::pass) {
    skip_single_branches(outcome_.results[jacobian_at_]);
    jacobian_.ratios.clear();
  }
  if (jacobian_.below_everywhere) progress_.decided(outcome_.results[jacobian_at_]);
  for (CheckResult* r : {&integral, &chi_square}) {
    progress_.decided(*r);
    outcome_.results.push_back(std::move(*r));
  }
  outcome_.view.mass = mass_seen(binned, rejected, options_);
}

PairOutcome PairBattery::outcome() {
  ViewEvidence& view = outcome_.view;
  for (RatioSeries& s : jacobian_.ratios) view.ratios.push_back(std::move(s));
  const BinCounts& counts = binned_->counts();
  view.samples = static_cast<double>(counts.drawn);
  view.strays = counts.strays;
  view.stray_share = static_cast<double>(counts.stray) / std::max(1.0, view.samples);
  for (const CheckResult& r : outcome_.results) {
    view.failed = view.failed || r.verdict == Verdict::fail;
  }
  outcome_.nothing = counts.rejected == counts.drawn;
  outcome_.atoms = has_atoms();
  return std::move(outcome_);
}

std::vector<BinSeen> PairBattery::bins_seen() const { return bins_of(*binned_); }

void name_cause(const Cause& cause, Report& report) {
  report.cause = cause.headline;
  report.second_cause = cause.second;
  report.cause_kind = cause.kind;
  for (CheckResult& r : report) {
    if (r.verdict != Verdict::fail) continue;
    r.diagnosis = cause.headline;
    r.cause = cause.kind;
  }
}

CheckResult nothing_sampled(const std::string& name, const ContractOptions& options,
                            const std::string& reason, const std::string& advice) {
  CheckResult r;
  r.kind = CheckKind::samples;
  r.subject = name + "/samples";
  r.seed = options.seed;
  r.reason = reason;
  r.advice = advice;
  return r;
}

Report check_pair(const SamplingPair& pair, const ContractOptions& options) {
  Progress progress(pair.name, options);
  PairBattery battery(pair, options, progress);
  battery.judge_points();
  battery.judge_samples();
  PairOutcome outcome = battery.outcome();
  Report report(std::move(outcome.results));
  if (outcome.nothing) {
    report.results.push_back(nothing_sampled(
        pair.name, options, "the sampler rejected every random number, so that nothing was tested",
        "see that it takes them as it is given them, and that what it is asked "
        "about (direction, side, light) is one that it samples"));
    progress.decided(report.results.back());
  }
  if (outcome.view.failed) {
    progress.looks_at("the cause");
    outcome.view.bins = battery.bins_seen();
    name_cause(diagnose({{std::move(outcome.view)}, {}, {}}), report);
  }
  return report;
}

}  // namespace plumbline::verify
