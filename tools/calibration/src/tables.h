#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <plumbline/calibration/experiments.h>
#include <plumbline/verify/detail/random.h>

/// The experiments of each table, and what they share.
namespace plumbline::calibration {

void add_null_experiments(std::vector<Experiment>& list);
void add_false_failure_experiments(std::vector<Experiment>& list);
void add_wrong_pass_experiments(std::vector<Experiment>& list);
void add_detection_experiments(std::vector<Experiment>& list);
void add_coverage_experiments(std::vector<Experiment>& list);
void add_same_code_experiments(std::vector<Experiment>& list);

/// Seed of one run: no two runs share a stream.
inline std::uint64_t run_seed(const Effort& effort, std::uint64_t run) {
  return verify::Random(effort.seed, run).bits();
}

/// How many of the runs, each with its own seed, end in the event.
template <class Event>
std::uint64_t count_runs(const Effort& effort, std::uint64_t runs, Event event) {
  std::uint64_t hits = 0;
  for (std::uint64_t i = 0; i < runs; ++i) hits += event(run_seed(effort, i)) ? 1u : 0u;
  return hits;
}

/// The smallest rate above `rate` that so many runs can exclude, if `rate` is the truth: they then
/// fail to exclude it less than once in 1e7. The number of hits stays below its mean by 5.2
/// standard deviations and what a Poisson tail adds to them, and the upper limit of the 99.9 %
/// interval lies 3.3 above it.
double excludable_rate(double rate, std::uint64_t runs);

/// Whether p-values are uniform: the share below t, where t·runs = 300, is proven to lie within
/// [t/2, 2t], and no quantile is farther from its place than so many runs can exclude.
///
/// @source distance of distribution functions: Dvoretzky, Kiefer, Wolfowitz 1956, with the constant
///         of Massart 1990
verify::CheckResult judge_uniform(const std::vector<double>& p_values,
                                  verify::Verdict expected = verify::Verdict::pass);

}  // namespace plumbline::calibration
