#include <cmath>
#include <string>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/detail/stopwatch.h>

#include "bsdfs/bsdf_result.h"
#include "streams.h"
#include "text.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

/// Where an atom may be: the mirror direction, or the refracted one.
double distance_from_law(const Vec3& wo, const Vec3& wi, double eta) {
  if (wo[2] * wi[2] >= 0) return length(sum(wi, {wo[0], wo[1], -wo[2]}));
  const double ratio = wo[2] > 0 ? 1 / eta : eta;
  return std::hypot(wi[0] + wo[0] * ratio, wi[1] + wo[1] * ratio);
}

}  // namespace

CheckResult check_atoms(const std::string& name, const ErasedBsdf& bsdf, const Vec3& wo,
                        const BsdfOptions& options) {
  const Stopwatch watch;
  Random random = random_for(options.contract.seed, Stream::atoms);
  CheckResult r = bsdf_result(CheckKind::atoms, name, options.contract);
  r.reference = 0;
  const double tolerance = 64 * bsdf.epsilon;
  r.tolerance = tolerance;
  r.leaned_on = "laws of reflection and refraction";
  double worst = 0;
  std::vector<std::optional<SampleRecord>> samples(kAtomProbes);
  bsdf_pair(name, bsdf, wo, options).next(random, samples);
  for (const auto& s : samples) {
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
