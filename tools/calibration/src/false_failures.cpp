#include <cmath>
#include <utility>

#include <plumbline/verify/mean.h>
#include <plumbline/verify/ratio.h>

#include "batches.h"
#include "tables.h"

/// How often correct but skewed estimators fail, at levels that can be simulated, and wrong ones
/// pass.
namespace plumbline::calibration {

namespace {

using MakeSampler = std::function<verify::MomentSampler(std::uint64_t seed)>;

struct Trial {
  double level;
  std::uint64_t runs;
};

verify::CheckResult failures(const MakeSampler& make, double reference, std::uint64_t samples,
                             const Trial& trial, const Effort& effort) {
  verify::MeanOptions o;
  o.reference = reference;
  o.max_samples = samples;
  o.budget.suite_level = trial.level;
  o.budget.max_checks = 1;
  const std::uint64_t failed = count_runs(effort, trial.runs, [&](std::uint64_t seed) {
    return check_mean(o, make(seed)).verdict == verify::Verdict::fail;
  });
  verify::ProportionOptions claim;
  claim.at_most = trial.level;
  return check_proportion(claim, failed, trial.runs);
}

struct Estimator {
  const char* name;
  MakeSampler make;
  double mean;
  std::uint64_t samples;  ///< cap
};

std::vector<Estimator> estimators() {
  const auto of = [](auto draw) {
    return [draw](std::uint64_t seed) { return sampler(seed, draw); };
  };
  const auto hits = [](double p) {
    return [p](std::uint64_t seed) { return bernoulli_sampler(p, seed); };
  };
  return {{"Bernoulli 1e-3", hits(1e-3), 1e-3, 1 << 18},
          {"Bernoulli 1e-4", hits(1e-4), 1e-4, 1 << 21},
          {"lognormal, cv 1.3", of(Lognormal{1}), 1, 20'000},
          {"lognormal, cv 2.9", of(Lognormal{1.5}), 1, 20'000},
          {"Pareto, index 3", of(Pareto{3}), 1, 20'000},
          {"Pareto, index 2.1", of(Pareto{2.1}), 1, 20'000}};
}

struct WrongEstimator {
  std::string name;
  MakeSampler make;
  double mean, cv;
  double tolerance;  ///< by which it is off
};

std::vector<WrongEstimator> wrong_estimators() {
  const auto of = [](auto draw) {
    return [draw](std::uint64_t seed) { return sampler(seed, draw); };
  };
  const auto hits = [](double p) {
    return [p](std::uint64_t seed) { return bernoulli_sampler(p, seed); };
  };
  return {{"uniform", of(Uniform{}), 1, std::sqrt(1.0 / 3), 0.05},
          {"exponential", of(Exponential{}), 1, 1, 0.05},
          {"Bernoulli 1e-3", hits(1e-3), 1e-3, std::sqrt(999), 0.05},
          {"lognormal, cv 1.3", of(Lognormal{1}), 1, std::sqrt(std::exp(1.0) - 1), 0.1},
          {"Pareto, index 3", of(Pareto{3}), 1, std::sqrt(1.0 / 3), 0.05},
          {"Pareto, index 2.1", of(Pareto{2.1}), 1, std::sqrt(1 / 0.21), 0.1}};
}

/// Passes of an estimator that is too large by just the tolerance: it passes where its rare large
/// samples are missing.
verify::CheckResult wrong_passes(const WrongEstimator& wrong, const Effort& effort) {
  // Later passes are rare: the estimate would have to come ever nearer to a wrong answer.
  constexpr double kEnough = 40;
  const Trial trial = effort.full ? Trial{0.005, 100'000} : Trial{0.05, 2'000};
  verify::MeanOptions o;
  o.reference = wrong.mean / (1 + wrong.tolerance);
  o.tolerance = wrong.tolerance;
  const double ratio = wrong.cv / wrong.tolerance;
  o.max_samples = static_cast<std::uint64_t>(std::max(5'000.0, kEnough * ratio * ratio));
  o.budget.pass_confidence = 1 - trial.level;
  const std::uint64_t passed = count_runs(effort, trial.runs, [&](std::uint64_t seed) {
    return check_mean(o, wrong.make(seed)).verdict == verify::Verdict::pass;
  });
  verify::ProportionOptions claim;
  claim.at_most = excludable_rate(trial.level, trial.runs);
  return check_proportion(claim, passed, trial.runs);
}

}  // namespace

void add_wrong_pass_experiments(std::vector<Experiment>& list) {
  for (const WrongEstimator& wrong : wrong_estimators()) {
    list.push_back({kTableWrongPasses, wrong.name,
                    [=](const Effort& effort) { return wrong_passes(wrong, effort); }});
  }
}

void add_false_failure_experiments(std::vector<Experiment>& list) {
  for (const Estimator& e : estimators()) {
    // A level with enough failures among so many runs to prove that there are fewer than allowed.
    const auto run = [e](const Effort& effort) {
      return failures(e.make, e.mean, e.samples,
                      effort.full ? Trial{0.005, 100'000} : Trial{0.05, 2'000}, effort);
    };
    list.push_back({kTableFalseFailures, e.name, run});
  }
}

}  // namespace plumbline::calibration
