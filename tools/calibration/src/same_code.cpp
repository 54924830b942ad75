#include <utility>

#include <plumbline/verify/image.h>
#include <plumbline/verify/mean.h>
#include <plumbline/verify/ratio.h>

#include "batches.h"
#include "examples.h"
#include "tables.h"

/// The same code twice never differs: with the same seed, nor with two of its own.
namespace plumbline::calibration {

namespace {

using verify::Verdict;

/// Whether a check of code with one seed against the same code with another says that they differ.
using Differs = std::function<bool(std::uint64_t seed, std::uint64_t other)>;

bool means_differ(std::uint64_t seed, std::uint64_t other) {
  verify::MeanOptions o;
  o.max_samples = 10'000;
  return check_agreement(o, sampler(seed, Exponential{}), sampler(other, Exponential{})).verdict ==
         Verdict::fail;
}

bool variances_differ(std::uint64_t seed, std::uint64_t other) {
  verify::VarianceRatioOptions o;
  o.at_least = o.at_most = 1;
  return check_variance_ratio(o, batches(seed, Exponential{}, 32, 100),
                              batches(other, Exponential{}, 32, 100))
             .verdict == Verdict::fail;
}

bool images_differ(std::uint64_t seed, std::uint64_t other) {
  return check_image({}, noisy_image(16, 64, 1, seed), noisy_image(16, 64, 1, other))
             .check.verdict == Verdict::fail;
}

Experiment never(std::string name, Differs differs, bool same_seed) {
  const auto run = [differs, same_seed](const Effort& effort) {
    const std::uint64_t runs = effort.full ? 20'000 : 400;
    const std::uint64_t hits = count_runs(effort, runs, [&](std::uint64_t seed) {
      return differs(seed, same_seed ? seed : seed + 1);
    });
    verify::ProportionOptions claim;
    claim.at_most = excludable_rate(0, runs);
    return check_proportion(claim, hits, runs);
  };
  name += same_seed ? ", same seed" : ", two seeds";
  return {kTableSameCode, std::move(name), run};
}

}  // namespace

void add_same_code_experiments(std::vector<Experiment>& list) {
  for (const bool same_seed : {true, false}) {
    list.push_back(never("agreement", means_differ, same_seed));
    list.push_back(never("variance ratio", variances_differ, same_seed));
    list.push_back(never("image", images_differ, same_seed));
  }
}

}  // namespace plumbline::calibration
