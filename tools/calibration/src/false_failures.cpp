#include <utility>

#include <plumbline/verify/mean.h>
#include <plumbline/verify/ratio.h>

#include "batches.h"
#include "tables.h"

/// How often correct but skewed estimators fail, at levels that can be simulated.
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
  std::uint64_t samples;  ///< cap; looks at 1250, 2500, …
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

}  // namespace

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
