#include <plumbline/calibration/samplers.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include <plumbline/verify/mean.h>
#include <plumbline/verify/pair.h>
#include <plumbline/verify/ratio.h>

#include "batches.h"
#include "examples.h"
#include "tables.h"

/// p-values of checks of correct code: uniform, or the level of a check is not what it says.
namespace plumbline::calibration {

namespace {

using verify::MeanOptions;

/// p-values of one run; most checks give one.
using PValues = std::function<std::vector<double>(std::uint64_t seed)>;

struct NullRuns {
  std::uint64_t gate, full;  ///< p-values to collect
};

Experiment uniform_experiment(std::string name, NullRuns runs, const PValues& p_values,
                              verify::Verdict expected = verify::Verdict::pass) {
  const auto run = [=](const Effort& effort) {
    std::vector<double> all;
    const std::uint64_t wanted = effort.full ? runs.full : runs.gate;
    for (std::uint64_t i = 0; all.size() < wanted; ++i) {
      for (const double p : p_values(run_seed(effort, i))) all.push_back(p);
    }
    return judge_uniform(all, expected);
  };
  return {kTableNull, std::move(name), run};
}

/// One look at so many samples.
MeanOptions one_look(std::uint64_t samples, double reference) {
  MeanOptions o;
  o.reference = reference;
  o.n0 = o.max_samples = samples;
  return o;
}

std::vector<double> mean_p(std::uint64_t seed) {
  return {check_mean(one_look(1250, 1), sampler(seed, Uniform{})).p_value.value()};
}

std::vector<double> exact_variance_p(std::uint64_t seed) {
  MeanOptions o = one_look(1250, 1);
  o.exact_variance = 1.0 / 3;
  return {check_mean(o, sampler(seed, Uniform{})).p_value.value()};
}

std::vector<double> agreement_p(std::uint64_t seed) {
  const MeanOptions o = one_look(1250, 0);
  return {check_agreement(o, sampler(seed, Uniform{}), sampler(seed + 1, Uniform{0.3}))
              .p_value.value()};
}

std::vector<double> ratio_p(std::uint64_t seed) {
  verify::VarianceRatioOptions o;
  o.at_least = o.at_most = 4;
  return {check_variance_ratio(o, batches(seed, Uniform{1.0}, 64, 40),
                               batches(seed + 1, Uniform{0.5}, 64, 40))
              .p_value.value()};
}

std::vector<double> chi_square_p(std::uint64_t seed) {
  verify::ContractOptions o;
  o.seed = seed;
  o.finest_bins = 64;  // one level of bins: the p-value of the worst of several is not uniform
  o.first_look = o.samples = 6400;
  return {check_chi_square(tilted_cosine(0), o).p_value.value()};
}

std::vector<double> image_p(std::uint64_t seed) {
  return {check_image({}, noisy_image(8, 128, 1, seed), grey_image(8)).check.p_value.value()};
}

std::vector<double> tiles_p(std::uint64_t seed) {
  std::vector<double> p = check_image({}, noisy_image(64, 64, 1, seed), grey_image(64)).p_map;
  std::erase_if(p, [](double x) { return std::isnan(x); });
  return p;
}

double normal_p(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

/// Nori's hypothesis.h floors the variance at 1e-5: nothing small is ever wrong.
std::vector<double> floored_z(std::uint64_t seed) {
  const verify::Moments m =
      sampler(seed, [](verify::Random& r) { return 1e-6 * Exponential{}(r); })(0, 1250);
  const double error = std::sqrt(std::max(m.variance(), 1e-5) / static_cast<double>(m.count()));
  return {normal_p((m.mean() - 1e-6) / error)};
}

/// A z-test without a guard, on an event that ten samples of 20,000 see.
std::vector<double> rare_event_z(std::uint64_t seed) {
  const verify::Moments m = bernoulli_moments(5e-4, 20'000, seed);
  return {normal_p((m.mean() - 5e-4) / m.standard_error())};
}

}  // namespace

void add_null_experiments(std::vector<Experiment>& list) {
  const NullRuns cheap{30'000, 300'000}, costly{2'000, 100'000};
  list.push_back(uniform_experiment("mean, 1,250 uniform samples", cheap, mean_p));
  list.push_back(uniform_experiment("mean, exact variance", cheap, exact_variance_p));
  list.push_back(uniform_experiment("agreement (Welch), spreads 1 and 0.3", cheap, agreement_p));
  list.push_back(uniform_experiment("variance ratio, 64 batches", {5'000, 100'000}, ratio_p));
  list.push_back(uniform_experiment("chi-square, 64 bins", {1'500, 100'000}, chi_square_p));
  list.push_back(uniform_experiment("image, global mean", costly, image_p));
  list.push_back(uniform_experiment("image, tiles of 4 pixels", {10'000, 300'000}, tiles_p));
  list.push_back(uniform_experiment("control: z-test, variance floored at 1e-5", costly, floored_z,
                                    verify::Verdict::fail));
  list.push_back(uniform_experiment("control: z-test of a rare event", cheap, rare_event_z,
                                    verify::Verdict::fail));
}

}  // namespace plumbline::calibration
