#include <cmath>
#include <utility>

#include <plumbline/verify/mean.h>
#include <plumbline/verify/pair.h>
#include <plumbline/verify/ratio.h>

#include "batches.h"
#include "examples.h"
#include "tables.h"

/// How often wrong code fails whose error is as large as `detectable` promises to find.
namespace plumbline::calibration {

namespace {

using verify::CheckResult;
using verify::MeanOptions;
using verify::Verdict;

constexpr double kPromised = 0.99;  // CheckResult::detectable

struct Runs {
  std::uint64_t gate, full;
};

/// @param effect  of the wrong code, in the units of the check's `detectable`
/// @param check   of the wrong code
/// @param promised  share of runs that find it
Experiment detection(std::string name, Runs runs, double effect,
                     std::function<CheckResult(std::uint64_t seed)> check,
                     double promised = kPromised) {
  const auto run = [=](const Effort& effort) {
    const std::uint64_t count = effort.full ? runs.full : runs.gate;
    double promise = 0;
    const std::uint64_t found = count_runs(effort, count, [&](std::uint64_t seed) {
      const CheckResult r = check(seed);
      promise += r.detectable.value() / static_cast<double>(count);
      return r.verdict == Verdict::fail;
    });
    verify::ProportionOptions claim;
    claim.at_least = 1 - excludable_rate(1 - promised, count);
    CheckResult r = check_proportion(claim, found, count);
    r.figures.insert(r.figures.end(),
                     {{"effect", effect}, {"detectable, mean", promise}, {"promised", promised}});
    if (!(promise <= 1.02 * effect)) {
      r.verdict = Verdict::fail;
      r.reason = "the check does not promise to find an effect as small as this";
    }
    return r;
  };
  return {kTableDetection, std::move(name), run};
}

CheckResult shifted_mean(std::uint64_t seed) {
  MeanOptions o;
  o.reference = 1.001;
  o.tolerance = 0.0005;
  o.max_samples = 112'000;
  return check_mean(o, sampler(seed, Uniform{0.05}));
}

CheckResult shifted_pair(std::uint64_t seed) {
  MeanOptions o;
  o.tolerance = 0.0005;
  o.max_samples = 82'000;
  const auto shifted = [](verify::Random& r) { return 1.001 * Uniform{0.02}(r); };
  return check_agreement(o, sampler(seed, Uniform{0.05}), sampler(seed + 1, shifted));
}

CheckResult ratio_of_1_1(std::uint64_t seed) {
  verify::VarianceRatioOptions o;
  o.at_most = 1;
  return check_variance_ratio(o, batches(seed, Uniform{std::sqrt(1.1)}, 64, 390),
                              batches(seed + 1, Uniform{1}, 64, 390));
}

verify::ContractOptions coarse_bins(std::uint64_t seed, std::uint64_t samples) {
  verify::ContractOptions o;
  o.seed = seed;
  o.finest_bins = 64;
  o.first_look = o.samples = samples;
  return o;
}

constexpr double kTilt = 0.3;

CheckResult tilted_lobe(std::uint64_t seed) {
  return check_chi_square(tilted_cosine(kTilt), coarse_bins(seed, 35'000));
}

CheckResult lobe_weight(std::uint64_t seed) {
  return check_chi_square(lobe_mixture(0.51), coarse_bins(seed, 470'000));
}

CheckResult shifted_image(std::uint64_t seed) {
  verify::ImageOptions o;
  o.tolerance = 0.02;
  return check_image(o, noisy_image(16, 144, 1.05, seed), grey_image(16)).check;
}

/// A tenth too much is caught within 20,000 samples.
template <class Draw>
Experiment ten_percent(std::string name, Draw draw, double mean, double promised = kPromised) {
  const auto check = [draw, mean](std::uint64_t seed) {
    MeanOptions o;
    o.reference = 1.1 * mean;
    o.max_samples = 20'000;
    CheckResult r = check_mean(o, sampler(seed, draw));
    *r.detectable /= o.reference;
    return r;
  };
  return detection("10 % within 20,000 samples, " + std::move(name), {500, 20'000}, 0.1, check,
                   promised);
}

}  // namespace

void add_detection_experiments(std::vector<Experiment>& list) {
  const Runs runs{700, 20'000};
  list.push_back(detection("mean, 0.1 % shift", runs, 0.001, shifted_mean));
  list.push_back(detection("agreement, 0.1 % shift", runs, 0.001, shifted_pair));
  list.push_back(detection("variance ratio of 1.1", runs, 1.1, ratio_of_1_1));
  list.push_back(detection("chi-square, 1 + 0.3 cosθ on a lobe", {300, 20'000},
                           kTilt * std::sqrt(1.0 / 18), tilted_lobe));
  list.push_back(detection("chi-square, 1 % of lobe weight", {40, 2'000}, 0.02, lobe_weight));
  list.push_back(detection("image, 5 % shift", {300, 20'000}, 0.05, shifted_image));
  list.push_back(ten_percent("cv 0.58 (uniform)", Uniform{}, 1));
  list.push_back(ten_percent("cv 1 (exponential)", Exponential{}, 1));
  list.push_back(ten_percent("cv 1.5 (Bernoulli)", Bernoulli{1 / 3.25}, 1 / 3.25));
  // One run in nine meets a sample that is too large for the guard, and waits for another look.
  list.push_back(ten_percent("cv 1.5 (lognormal)", Lognormal{1.0857}, 1, 0.85));
}

}  // namespace plumbline::calibration
