#include "pairs/integral_check.h"

#include <cmath>

#include <plumbline/verify/detail/stopwatch.h>

#include "text.h"

namespace plumbline::verify {

namespace {

// Samples that show atoms where the chi-square check draws none.
constexpr std::uint64_t kProbes = 10'000;
// What a pass promises where quadrature reaches it, and where it does not.
constexpr double kStrictPromise = 5e-5, kLoosePromise = 1e-3;

std::string advice_for(const SamplingPair& pair, const MassBalance& mass, double level) {
  if (mass.rejected.error(level) > mass.integral.error(level)) {
    return "let `sample` take two numbers instead of three or a generator, expose the lobes, or "
           "state a larger mass_tolerance";
  }
  if (pair.domain.directions()) {
    return "state where the density jumps (Domain::equirectangular, Domain::octahedral, "
           "with_breaks), allow more `evaluations`, or state a larger mass_tolerance";
  }
  return "state where the density jumps (Domain::with_breaks), allow more `evaluations`, or state "
         "a "
         "larger mass_tolerance";
}

}  // namespace

MassBalance balance_mass(const BinnedPair& pair, const RejectedShare& rejected) {
  MassBalance balance{pair.expected(), 0, rejected};
  for (const AtomCount& a : pair.counts().atoms) balance.atoms += a.atom.mass;
  return balance;
}

double mass_tolerance(const ContractOptions& options, const BinnedPair& pair) {
  return options.mass_tolerance.value_or(kStrictPromise) + pair.rounding();
}

CheckResult judge_integral(const ContractOptions& options, const BinnedPair& binned,
                           const RejectedShare& rejected) {
  const MassBalance mass = balance_mass(binned, rejected);
  const double pass_level = options.budget.pass_level(), fail_level = options.budget.fail_level();
  const double known_to = mass.error(pass_level);
  const double sum = 1 + mass.excess(), bound = std::abs(mass.excess()) + known_to;
  const double strict = mass_tolerance(options, binned);
  const bool loose = !options.mass_tolerance && !(bound <= strict);
  const double tolerance = loose ? kLoosePromise + binned.rounding() : strict;
  CheckResult r;
  r.kind = CheckKind::integral;
  r.subject = binned.pair().name + "/integral";
  r.seed = options.seed;
  r.estimate = sum;
  r.reference = 1;
  r.bound = bound;
  r.tolerance = tolerance;
  r.detectable = strict + 2 * mass.error(fail_level);
  r.interval = {sum - known_to, sum + known_to};
  r.samples = binned.counts().drawn;
  r.leaned_on = "random nodes, empirical Bernstein bound";
  r.figures = {{Figure::integral_of_pdf, mass.integral.total},
               {Figure::integral_error, mass.integral.error(pass_level)},
               {Figure::atoms, mass.atoms},
               {Figure::rejected_share, mass.rejected.value},
               {Figure::rejected_error, mass.rejected.error(pass_level)},
               {Figure::rounding, binned.rounding()},
               {Figure::unseen_spike, mass.integral.unseen},
               {Figure::evaluations, static_cast<double>(mass.integral.evaluations)}};
  if (!mass.integral.finite || !std::isfinite(sum)) {
    r.verdict = Verdict::fail;
    r.reason = "the pdf is not finite somewhere";
  } else if (!(std::abs(mass.excess()) - mass.error(fail_level) <= strict)) {
    r.verdict = Verdict::fail;
    r.reason = "∫pdf = " + number(mass.integral.total);
    if (mass.atoms > 0) r.reason += ", atoms add " + number(mass.atoms);
    if (mass.rejected.value > 0) {
      r.reason += ", rejected samples add " + number(mass.rejected.value);
    }
  } else if (bound <= tolerance) {
    r.verdict = Verdict::pass;
  } else {
    r.reason = "the sum is known to " + number(known_to) + " only";
    r.advice = advice_for(binned.pair(), mass, pass_level);
  }
  return r;
}

CheckResult check_integral(const SamplingPair& pair, const ContractOptions& options) {
  const Stopwatch watch;
  const double error = promised_mass_error(options);
  BinnedPair binned(pair, options, error);
  binned.draw(kProbes);
  CheckResult result = judge_integral(options, binned, measure_rejected(pair, options, error));
  result.seconds = watch.seconds();
  return result;
}

}  // namespace plumbline::verify
