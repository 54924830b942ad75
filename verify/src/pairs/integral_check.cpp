#include "pairs/integral_check.h"

#include <cmath>

#include <plumbline/verify/detail/stopwatch.h>

#include "text.h"

namespace plumbline::verify {

namespace {

// Samples that show atoms and rejections where the chi-square check draws none.
constexpr std::uint64_t kProbes = 10'000;

}  // namespace

CheckResult judge_integral(const ContractOptions& options, const BinnedPair& binned,
                           const RejectedShare& rejected) {
  const MassBalance mass = balance_mass(binned, rejected, options.budget.fail_level());
  const double tolerance = options.mass_tolerance + binned.rounding();
  CheckResult r;
  r.kind = CheckKind::integral;
  r.subject = binned.pair().name + "/integral";
  r.seed = options.seed;
  const double sum = 1 + mass.excess(), bound = std::abs(mass.excess()) + mass.error();
  r.estimate = sum;
  r.reference = 1;
  r.tolerance = tolerance;
  r.bound = bound;
  r.detectable = tolerance + 2 * mass.error();
  r.interval = {sum - mass.error(), sum + mass.error()};
  r.samples = binned.counts().drawn;
  r.leaned_on = mass.rejected.value == 0 ? "error estimate of the cubature"
                : mass.rejected.measured
                    ? "error estimates of the cubature and of the rejected area"
                    : "error estimate of the cubature, counted rejections";
  r.figures = {{Figure::integral_of_pdf, mass.integral},
               {Figure::integral_error, mass.integral_error},
               {Figure::atoms, mass.atoms},
               {Figure::rejected_share, mass.rejected.value},
               {Figure::rounding, binned.rounding()},
               {Figure::evaluations, static_cast<double>(binned.expected().evaluations)}};
  if (!binned.expected().finite || !std::isfinite(sum)) {
    r.verdict = Verdict::fail;
    r.reason = "the pdf is not finite somewhere";
  } else if (!(std::abs(mass.excess()) - mass.error() <= tolerance)) {
    r.verdict = Verdict::fail;
    r.reason = "∫pdf = " + number(mass.integral);
    if (mass.atoms > 0) r.reason += ", atoms add " + number(mass.atoms);
    if (mass.rejected.value > 0)
      r.reason += ", rejected samples add " + number(mass.rejected.value);
  } else if (bound <= tolerance) {
    r.verdict = Verdict::pass;
  } else {
    r.reason = "the sum is known to " + number(mass.error()) + " only";
  }
  return r;
}

CheckResult check_integral(const SamplingPair& pair, const ContractOptions& options) {
  const Stopwatch watch;
  BinnedPair binned(pair, options.finest_bins, options.mass_tolerance / 2, options.seed);
  binned.draw(kProbes);
  CheckResult result = judge_integral(options, binned, measure_rejected(pair, options.seed));
  result.seconds = watch.seconds();
  return result;
}

}  // namespace plumbline::verify
