#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/detail/stopwatch.h>

#include "bsdfs/bsdf_checks.h"
#include "bsdfs/bsdf_result.h"
#include "pairs/batches.h"
#include "pairs/binned_pair.h"
#include "streams.h"
#include "text.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

std::vector<Record> probes(const SamplingPair& pair, Random& random) {
  std::vector<Record> samples(kAtomProbes);
  pair.next(random, samples);
  return samples;
}

/// Part of the albedo that atoms carry, in one channel, freed of η².
double atoms_albedo(const SamplingPair& pair, const ErasedBsdf& bsdf, const Vec3& wo, double eta,
                    std::size_t channel, std::uint64_t seed) {
  Random random = random_for(seed, Stream::atoms_albedo);
  std::vector<Vec3> seen;
  double sum_of_atoms = 0;
  for (const Record& s : probes(pair, random)) {
    if (!s || s->mass == 0 || s->weight.count <= channel) continue;
    const bool known = std::any_of(seen.begin(), seen.end(), [&](const Vec3& x) {
      return length(sum(x, scaled(s->x, -1))) < 1e-5;
    });
    if (known) continue;
    seen.push_back(s->x);
    sum_of_atoms += s->mass * s->weight[channel] * power_factor(bsdf, wo, s->x, eta);
  }
  return sum_of_atoms;
}

/// Channel with the largest mean weight.
std::size_t brightest_channel(const SamplingPair& pair, std::uint64_t seed) {
  Random random = random_for(seed, Stream::channel);
  std::array<double, Channels::kMost> sums{};
  for (const Record& s : probes(pair, random)) {
    for (std::size_t c = 0; s && c < s->weight.count; ++c) sums[c] += s->weight[c];
  }
  return static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
}

}  // namespace

AlbedoAt albedo_seen(const CheckResult& energy, const Vec3& wo, const BsdfOptions& options) {
  AlbedoAt seen;
  seen.wo = wo;
  seen.albedo = energy.estimate.value_or(0);
  if (energy.interval) seen.error = (energy.interval->high - energy.interval->low) / 2;
  if (options.albedo) seen.known = energy.reference;
  return seen;
}

CheckResult check_energy(const std::string& name, const ErasedBsdf& bsdf, const Vec3& wo,
                         const BsdfOptions& options) {
  if (options.albedo_channel >= Channels::kMost) {
    throw std::invalid_argument("albedo_channel must be less than " +
                                std::to_string(Channels::kMost));
  }
  const Stopwatch watch;
  const SamplingPair pair = bsdf_pair(name, bsdf, wo, options);
  const std::uint64_t seed = options.contract.seed;
  const std::size_t channel =
      options.albedo ? options.albedo_channel : brightest_channel(pair, seed);
  const auto value = [&](std::span<const Vec3> wi, std::span<double> out) {
    std::vector<Channels> of(wi.size());
    pair.value(wi, of);
    for (std::size_t i = 0; i < wi.size(); ++i) {
      out[i] = of[i][channel] * power_factor(bsdf, wo, wi[i], options.eta);
    }
  };
  const MassIntegral integral = integrate_over_domain(
      pair, {value, pair.value.batch()}, options.contract, options.energy_tolerance / 4);
  const double atoms = atoms_albedo(pair, bsdf, wo, options.eta, channel, seed);

  const ErrorBudget& budget = options.contract.budget;
  const double known_to = integral.error(budget.pass_level());
  const double sure_to = integral.error(budget.fail_level());
  const double albedo = integral.total + atoms, tolerance = options.energy_tolerance;
  const double reference = options.albedo ? options.albedo(wo) : 1.0;
  const double excess = options.albedo ? std::abs(albedo - reference) : albedo - reference;
  const double bound = std::max(0.0, excess + known_to);
  CheckResult r = bsdf_result(CheckKind::energy, name, options.contract);
  r.estimate = albedo;
  r.reference = reference;
  r.tolerance = tolerance;
  r.bound = bound;
  r.interval = {albedo - known_to, albedo + known_to};
  r.leaned_on = "random nodes, empirical Bernstein bound";
  r.figures = {{Figure::albedo_of_atoms, atoms}, {Figure::integral_error, known_to}};
  if (!(excess - sure_to <= tolerance)) {
    r.verdict = Verdict::fail;
    r.reason = "the albedo is " + number(albedo) +
               (options.albedo ? ", it should be " + number(reference) : ", more than 1");
  } else if (bound <= tolerance) {
    r.verdict = Verdict::pass;
  } else {
    r.reason = "the albedo is known to " + number(known_to) + " only";
    r.advice = "allow more `evaluations`, or state a larger energy_tolerance";
  }
  r.seconds = watch.seconds();
  return r;
}

}  // namespace plumbline::verify
