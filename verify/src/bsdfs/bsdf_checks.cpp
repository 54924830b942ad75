#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/detail/stopwatch.h>

#include "diagnosis/asymmetry_diagnosis.h"
#include "pairs/binned_pair.h"
#include "pairs/chi_square_look.h"
#include "text.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

constexpr int kReciprocityPairs = 2'000;
constexpr int kAtomProbes = 1'000;

Vec3 random_direction(Random& random) {
  const double z = 2 * random.uniform() - 1, phi = 2 * std::numbers::pi * random.uniform();
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(phi), radius * std::sin(phi), z};
}

/// η² of the medium that a direction points into.
double eta_squared(const Vec3& w, double eta) { return w[2] < 0 ? eta * eta : 1; }

CheckResult result_of(CheckKind kind, const std::string& name, const ContractOptions& options) {
  CheckResult r;
  r.kind = kind;
  r.subject = name + "/" + std::string(to_string(kind));
  r.seed = options.seed;
  return r;
}

/// Whether a and b are equal up to rounding: of themselves, or of the direction that f is asked
/// with.
template <class F>
bool equal_up_to_rounding(double a, double b, double epsilon, const Vec3& w, const F& f) {
  const double difference = std::abs(a - b);
  const double allowed = 256 * epsilon * std::max(std::abs(a), std::abs(b));
  if (difference <= allowed) return true;
  if (!std::isfinite(difference)) return false;
  const double here = f(w);
  double spread = 0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 moved = Domain::sphere().chart().near(w, 8 * epsilon, k * std::numbers::pi / 2);
    spread = std::max(spread, std::abs(f(moved) - here));
  }
  return difference <= allowed + 16 * spread;
}

class Reciprocity {
 public:
  Reciprocity(const std::string& name, const ErasedBsdf& bsdf, const BsdfOptions& options)
      : bsdf_(bsdf),
        options_(options),
        result_(result_of(CheckKind::reciprocity, name, options.contract)) {}

  CheckResult run() {
    Random random(options_.contract.seed, 5);
    for (int i = 0; i < kReciprocityPairs; ++i) {
      const Vec3 wo = random_direction(random);
      see(wo, random_direction(random));
      const auto sampled = bsdf_pair("", bsdf_, wo, options_).next(random);
      if (sampled && sampled->mass == 0) see(wo, sampled->x);
    }
    result_.samples = static_cast<std::uint64_t>(pairs_);
    result_.reference = 0;
    result_.estimate = result_.bound = worst_;
    result_.leaned_on = "points tested";
    result_.verdict = failed_ == 0 ? Verdict::pass : Verdict::fail;
    if (failed_ > 0) {
      result_.diagnosis = asymmetry_.diagnosis();
      result_.reason += " (" + number(std::uint64_t(failed_)) + " of " +
                        number(std::uint64_t(pairs_)) + " pairs fail)";
    }
    result_.seconds = watch_.seconds();
    return result_;
  }

 private:
  void see(const Vec3& wo, const Vec3& wi) {
    const Channels there = bsdf_.eval(wo, wi), back = bsdf_.eval(wi, wo);
    const double eta_o = eta_squared(wo, options_.eta), eta_i = eta_squared(wi, options_.eta);
    ++pairs_;
    if (there.count > 0) {
      asymmetry_.add({wo, wi, there[0] / eta_o / (back[0] / eta_i), eta_i / eta_o});
    }
    for (std::size_t c = 0; c < there.count; ++c) {
      const double a = there[c] / eta_o, b = back[c] / eta_i;
      const auto moved_i = [&](const Vec3& w) { return bsdf_.eval(wo, w)[c] / eta_o; };
      const auto moved_o = [&](const Vec3& w) { return bsdf_.eval(w, wi)[c] / eta_o; };
      if (equal_up_to_rounding(a, b, bsdf_.epsilon, wi, moved_i) ||
          equal_up_to_rounding(a, b, bsdf_.epsilon, wo, moved_o)) {
        continue;
      }
      worst_ = std::max(worst_, std::abs(a - b) / std::max(std::abs(a), std::abs(b)));
      if (failed_++ == 0) {
        result_.reason = "f(wo, wi)/η² = " + number(a) + ", the other way " + number(b) +
                         ", for wo " + place(wo) + ", wi " + place(wi);
      }
      break;
    }
  }

  const Stopwatch watch_;
  const ErasedBsdf& bsdf_;
  const BsdfOptions& options_;
  CheckResult result_;
  Asymmetry asymmetry_;
  int pairs_ = 0, failed_ = 0;
  double worst_ = 0;
};

/// Part of the albedo that atoms carry, in one channel, freed of η².
double atoms_albedo(const SamplingPair& pair, const Vec3& wo, double eta, std::size_t channel,
                    std::uint64_t seed) {
  Random random(seed, 6);
  std::vector<Vec3> seen;
  double sum_of_atoms = 0;
  for (int i = 0; i < kAtomProbes; ++i) {
    const auto s = pair.next(random);
    if (!s || s->mass == 0 || s->weight.count <= channel) continue;
    const bool known = std::any_of(seen.begin(), seen.end(), [&](const Vec3& x) {
      return length(sum(x, scaled(s->x, -1))) < 1e-5;
    });
    if (known) continue;
    seen.push_back(s->x);
    sum_of_atoms += s->mass * s->weight[channel] * eta_squared(s->x, eta) / eta_squared(wo, eta);
  }
  return sum_of_atoms;
}

/// Channel with the largest mean weight.
std::size_t brightest_channel(const SamplingPair& pair, std::uint64_t seed) {
  Random random(seed, 7);
  std::array<double, Channels::kMost> sums{};
  for (int i = 0; i < kAtomProbes; ++i) {
    const auto s = pair.next(random);
    for (std::size_t c = 0; s && c < s->weight.count; ++c) sums[c] += s->weight[c];
  }
  return static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
}

/// Where an atom may be: the mirror direction, or the refracted one.
double distance_from_law(const Vec3& wo, const Vec3& wi, double eta) {
  if (wo[2] * wi[2] >= 0) return length(sum(wi, {wo[0], wo[1], -wo[2]}));
  const double ratio = wo[2] > 0 ? 1 / eta : eta;
  return std::hypot(wi[0] + wo[0] * ratio, wi[1] + wo[1] * ratio);
}

}  // namespace

CheckResult check_reciprocity(const std::string& name, const ErasedBsdf& bsdf,
                              const BsdfOptions& options) {
  return Reciprocity(name, bsdf, options).run();
}

CheckResult check_energy(const std::string& name, const ErasedBsdf& bsdf, const Vec3& wo,
                         const BsdfOptions& options) {
  const Stopwatch watch;
  const SamplingPair pair = bsdf_pair(name, bsdf, wo, options);
  const std::uint64_t seed = options.contract.seed;
  const std::size_t channel = options.albedo ? 0 : brightest_channel(pair, seed);
  const auto value = [&](const Vec3& wi) {
    const double scale = eta_squared(wi, options.eta) / eta_squared(wo, options.eta);
    return pair.value(wi)[channel] * scale;
  };
  const CubatureResult integral = integrate_over_domain(pair, value, options.contract.finest_bins,
                                                        options.energy_tolerance / 20, seed);
  const double atoms = atoms_albedo(pair, wo, options.eta, channel, seed);

  CheckResult r = result_of(CheckKind::energy, name, options.contract);
  const double albedo = integral.total + atoms;
  const double reference = options.albedo ? options.albedo(wo) : 1.0;
  const double tolerance = options.energy_tolerance;
  r.estimate = albedo;
  r.reference = reference;
  r.tolerance = tolerance;
  r.interval = {albedo - integral.total_error, albedo + integral.total_error};
  r.leaned_on = "error estimate of the cubature";
  r.figures = {{Figure::albedo_of_atoms, atoms}, {Figure::integral_error, integral.total_error}};
  const double excess = options.albedo ? std::abs(albedo - reference) : albedo - reference;
  const double bound = std::max(0.0, excess + integral.total_error);
  r.bound = bound;
  if (!(excess - integral.total_error <= tolerance)) {
    r.verdict = Verdict::fail;
    r.reason = "the albedo is " + number(albedo) +
               (options.albedo ? ", it should be " + number(reference) : ", more than 1");
  } else if (bound <= tolerance) {
    r.verdict = Verdict::pass;
  } else {
    r.reason = "the albedo is known to " + number(integral.total_error) + " only";
  }
  r.seconds = watch.seconds();
  return r;
}

CheckResult check_atoms(const std::string& name, const ErasedBsdf& bsdf, const Vec3& wo,
                        const BsdfOptions& options) {
  const Stopwatch watch;
  const SamplingPair pair = bsdf_pair(name, bsdf, wo, options);
  Random random(options.contract.seed, 8);
  CheckResult r = result_of(CheckKind::atoms, name, options.contract);
  r.reference = 0;
  const double tolerance = 64 * bsdf.epsilon;
  r.tolerance = tolerance;
  r.leaned_on = "laws of reflection and refraction";
  double worst = 0;
  for (int i = 0; i < kAtomProbes; ++i) {
    const auto s = pair.next(random);
    if (!s || s->mass == 0) continue;
    ++r.samples;
    const double distance = distance_from_law(wo, s->x, options.eta);
    if (distance <= worst) continue;
    worst = distance;
    if (!(distance <= tolerance)) {
      r.reason = "an atom at " + place(s->x) + " is " + number(distance) +
                 " from where the laws of reflection and refraction put it";
    }
  }
  r.estimate = r.bound = worst;
  r.verdict = worst <= tolerance ? Verdict::pass : Verdict::fail;
  r.seconds = watch.seconds();
  return r;
}

}  // namespace plumbline::verify
