#include <cmath>
#include <utility>

#include <plumbline/verify/ratio.h>

#include "batches.h"
#include "tables.h"

/// How often the interval of a variance ratio holds the true ratio.
namespace plumbline::calibration {

namespace {

using MakeBatches = std::function<std::vector<verify::Moments>(std::uint64_t seed)>;

struct Pair {
  const char* name;
  MakeBatches a, b;
  double ratio;
  bool heavy_against_light = false;
};

// Of the intervals that state 95 % (99.9 % at night) so many may miss. A heavy tail against a light
// one is what the jackknife sees worst: the largest values, which decide, are missing in most runs.
constexpr double kMissing = 0.05, kMissingFull = 0.001;
constexpr double kHeavyMissing = 0.065, kHeavyMissingFull = 0.004;

template <class Draw>
MakeBatches in_batches(Draw draw) {
  return [draw](std::uint64_t seed) { return batches(seed, draw, 32, 250); };
}

/// Variance of a Pareto estimator of mean 1.
double pareto_variance(double index) { return 1 / (index * (index - 2)); }

std::vector<Pair> pairs() {
  const MakeBatches uniform = in_batches(Uniform{}), exponential = in_batches(Exponential{});
  const double lognormal = std::exp(1.0) - 1;
  return {{"exponential to uniform", exponential, uniform, 3},
          {"exponential to itself", exponential, exponential, 1},
          {"lognormal (cv 1.3) to itself", in_batches(Lognormal{1}), in_batches(Lognormal{1}), 1},
          {"lognormal (cv 1.3) to uniform", in_batches(Lognormal{1}), uniform, 3 * lognormal, true},
          {"Pareto, index 4.5, to itself", in_batches(Pareto{4.5}), in_batches(Pareto{4.5}), 1},
          {"Pareto, index 4.5, to uniform", in_batches(Pareto{4.5}), uniform,
           3 * pareto_variance(4.5), true}};
}

verify::CheckResult coverage(const Pair& pair, const Effort& effort) {
  const double missing = effort.full ? kMissingFull : kMissing;
  const double heavy = effort.full ? kHeavyMissingFull : kHeavyMissing;
  const std::uint64_t runs = effort.full ? 100'000 : 1'500;
  verify::VarianceRatioOptions o;
  o.budget.pass_confidence = 1 - missing;
  const std::uint64_t held = count_runs(effort, runs, [&](std::uint64_t seed) {
    const verify::CheckResult r = check_variance_ratio(o, pair.a(seed), pair.b(seed + 1));
    return r.interval && r.interval->low <= pair.ratio && pair.ratio <= r.interval->high;
  });
  verify::ProportionOptions claim;
  claim.at_least = 1 - excludable_rate(pair.heavy_against_light ? heavy : missing, runs);
  verify::CheckResult r = check_proportion(claim, held, runs);
  r.figures.emplace_back("stated coverage", 1 - missing);
  return r;
}

}  // namespace

void add_coverage_experiments(std::vector<Experiment>& list) {
  for (const Pair& pair : pairs()) {
    list.push_back(
        {kTableCoverage, pair.name, [pair](const Effort& e) { return coverage(pair, e); }});
  }
}

}  // namespace plumbline::calibration
