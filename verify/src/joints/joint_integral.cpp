#include <cmath>
#include <string>

#include <plumbline/verify/detail/stopwatch.h>

#include "joints/joint_checks.h"
#include "text.h"

namespace plumbline::verify {

namespace {

// What a pass promises where the default is not reached: a density with jumps across all
// dimensions.
constexpr double kLooseJointPromise = 5e-3;
// An excess that is proven to be larger fails, also when it is below the tolerance.
constexpr double kProvenExcess = 5e-5;
// Of the samples that may lie where nothing but own samples shows the density.
constexpr double kMostOnOwn = 0.02;

std::string advice_for_joint(const JointBalance& mass, double level) {
  if (mass.rejected.hits > 0 && mass.rejected.error(level) > mass.integral.error(level)) {
    return "state a larger mass_tolerance, or let `sample` map what it does not reject";
  }
  return "state where the density jumps (Domain::with_breaks of a factor), allow more "
         "`evaluations`, state a larger mass_tolerance, or check one factor at a time, given the "
         "others";
}

}  // namespace

CheckResult judge_joint_integral(const JointBins& bins, const CountedShare& rejected,
                                 const ContractOptions& options) {
  const CubeMass& expected = bins.expected();
  const JointBalance mass{expected.integral, rejected};
  const double pass_level = options.budget.pass_level(), fail_level = options.budget.fail_level();
  const double known_to = mass.error(pass_level), bound = std::abs(mass.excess()) + known_to;
  const double sum = 1 + mass.excess(), least = kProvenExcess + bins.rounding();
  const double strict = joint_mass_tolerance(options) + bins.rounding();
  const bool loose = !options.mass_tolerance && !(bound <= strict);
  CheckResult r;
  r.kind = CheckKind::integral;
  r.subject = bins.pair().name + "/integral";
  r.seed = options.seed;
  r.estimate = sum;
  r.reference = 1;
  r.bound = bound;
  r.tolerance = loose ? kLooseJointPromise + bins.rounding() : strict;
  r.detectable = least + 2 * mass.error(fail_level);
  r.interval = {sum - known_to, sum + known_to};
  r.samples = static_cast<std::uint64_t>(rejected.trials);
  r.leaned_on = "random nodes in all dimensions, empirical Bernstein bound";
  r.figures = {{Figure::integral_of_pdf, mass.integral.total},
               {Figure::integral_error, mass.integral.error(pass_level)},
               {Figure::rejected_share, rejected.value()},
               {Figure::rejected_error, rejected.hits > 0 ? rejected.error(pass_level) : 0},
               {Figure::rounding, bins.rounding()},
               {Figure::unseen_spike, mass.integral.unseen},
               {"mass that rests on own samples", expected.rests_on_own},
               {Figure::evaluations, static_cast<double>(mass.integral.evaluations)}};
  if (!mass.integral.finite || !std::isfinite(sum)) {
    r.verdict = Verdict::fail;
    r.reason = "the pdf is not finite somewhere";
  } else if (!(std::abs(mass.excess()) - mass.error(fail_level) <= least)) {
    r.verdict = Verdict::fail;
    const JointBalance uniform{expected.of_uniform, rejected};
    if (std::abs(uniform.excess()) - uniform.error(fail_level) > least) {
      r.reason = "∫pdf = " + number(uniform.integral.total);
    } else {
      // Where the density is taken from the samples, they contradict it.
      r.reason = "the samples do not follow the pdf: with their help its integral would be " +
                 number(mass.integral.total);
    }
    if (rejected.hits > 0) r.reason += ", rejected samples add " + number(rejected.value());
  } else if (expected.rests_on_own > kMostOnOwn) {
    r.reason = "the density is so narrow that " + number(expected.rests_on_own) +
               " of its mass is shown by its own samples alone";
    r.advice = advice_for_joint({mass.integral, {}}, pass_level);
  } else if (bound <= *r.tolerance) {
    r.verdict = Verdict::pass;
  } else {
    r.reason = "the sum is known to " + number(known_to) + " only";
    r.advice = advice_for_joint(mass, pass_level);
  }
  return r;
}

CheckResult check_integral(const JointPair& pair, const ContractOptions& options) {
  require_usable(pair, options);
  const Stopwatch watch;
  const JointBins bins(pair, options);
  CheckResult result = judge_joint_integral(bins, bins.rejected(), options);
  result.seconds = watch.seconds();
  return result;
}

}  // namespace plumbline::verify
