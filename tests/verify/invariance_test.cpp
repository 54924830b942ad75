#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include <plumbline/verify/dependent.h>
#include <plumbline/verify/gtest.h>

namespace plumbline::verify {
namespace {

using tests::repeatable;

/// Of the line [0, 1]: ½ + x, started from by inversion.
double ramp_density(double x) { return x < 0 || x > 1 ? 0 : 0.5 + x; }
double start_of_ramp(Random& random) { return std::sqrt(0.25 + 2 * random.uniform()) - 0.5; }

constexpr double kReach = 0.4;

double proposed(double x, Random& random) { return x + kReach * (2 * random.uniform() - 1); }

/// y with probability min(1, ratio), else x.
///
/// @source Metropolis et al. 1953; with the densities of proposals Hastings 1970, Eq. 6
double accepted_or_not(double x, double y, double ratio, Random& random) {
  return random.uniform() < ratio ? y : x;
}

double metropolis(double x, Random& random) {
  const double y = proposed(x, random);
  return accepted_or_not(x, y, ramp_density(y) / ramp_density(x), random);
}

/// Folded back at the borders, which keeps the proposal symmetric.
double reflecting(double x, Random& random) {
  double y = std::abs(proposed(x, random));
  if (y > 1) y = 2 - y;
  return accepted_or_not(x, y, ramp_density(y) / ramp_density(x), random);
}

double clamping(double x, Random& random) {
  const double y = std::clamp(proposed(x, random), 0.0, 1.0);
  return accepted_or_not(x, y, ramp_density(y) / ramp_density(x), random);
}

double upside_down(double x, Random& random) {
  const double y = proposed(x, random);
  return y < 0 || y > 1 ? x : accepted_or_not(x, y, ramp_density(x) / ramp_density(y), random);
}

/// Tries again until a proposal is accepted: rejections do not repeat the state.
double never_repeating(double x, Random& random) {
  for (;;) {
    const double y = proposed(x, random);
    if (random.uniform() < ramp_density(y) / ramp_density(x)) return y;
  }
}

/// y = x e^s has the density 1/(y · width): Hastings' ratio is y/x.
template <bool with_hastings>
double stretching(double x, Random& random) {
  const double y = x * std::exp(2 * random.uniform() - 1);
  const double ratio = ramp_density(y) / ramp_density(x);
  return accepted_or_not(x, y, with_hastings ? ratio * y / x : ratio, random);
}

double never_moving(double x, Random&) { return x; }

InvarianceOptions quick_look(const std::string& name) {
  InvarianceOptions o;
  o.contract = tests::contract_options("invariance/" + name);
  o.contract.deviation = 0.05;  // the faults are several times that
  o.tolerance = 0.01;
  return o;
}

MarkovChain chain_on_the_line(std::string name, double (*step)(double, Random&),
                              bool with_pdf = true) {
  Many<double(Vec3)> pdf;
  if (with_pdf) pdf = [](const Vec3& x) { return ramp_density(x[0]); };
  return markov_chain(std::move(name), Domain::interval(), start_of_ramp, step, std::identity(),
                      pdf);
}

Report check_chain(const MarkovChain& chain) {
  return check_invariance(chain, quick_look(chain.name));
}

void expect_wrong_step(const std::string& name, double (*step)(double, Random&)) {
  for (const bool with_pdf : {true, false}) {
    const Report report =
        check_chain(chain_on_the_line(name + (with_pdf ? "" : ", no pdf"), step, with_pdf));
    EXPECT_EQ(report.verdict(), Verdict::fail) << report.summary();
    if (with_pdf) {
      EXPECT_TRUE(report.results.front().ok()) << "the start is right";
    }
  }
}

TEST(Invariance, OfCorrectChainsIsProven) {
  for (const bool with_pdf : {true, false}) {
    PLUMBLINE_EXPECT_PASS(
        repeatable(check_chain(chain_on_the_line("metropolis", metropolis, with_pdf))));
    PLUMBLINE_EXPECT_PASS(
        repeatable(check_chain(chain_on_the_line("reflecting", reflecting, with_pdf))));
    PLUMBLINE_EXPECT_PASS(
        repeatable(check_chain(chain_on_the_line("stretching", stretching<true>, with_pdf))));
  }
}

TEST(Invariance, WrongStepsAreFound) {
  expect_wrong_step("clamped", clamping);
  expect_wrong_step("upside down", upside_down);
  expect_wrong_step("never repeating", never_repeating);
  expect_wrong_step("no Hastings ratio", stretching<false>);
}

TEST(Invariance, AWrongStartIsToldFromAWrongStep) {
  const MarkovChain chain = markov_chain(
      "uniform start", Domain::interval(), [](Random& random) { return random.uniform(); },
      metropolis, std::identity(), [](const Vec3& x) { return ramp_density(x[0]); });
  const Report report = check_chain(chain);
  EXPECT_EQ(report.results.front().verdict, Verdict::fail);
  EXPECT_EQ(report.results.front().subject, "uniform start/start/chi_square");
}

TEST(Invariance, OfAChainThatNeverMovesProvesNothing) {
  const Report report = check_chain(chain_on_the_line("never moving", never_moving));
  EXPECT_EQ(report.verdict(), Verdict::inconclusive) << report.summary();
}

/// A state of its own: numbers in [0, 1)², as of Metropolis light transport, of which the direction
/// is a map.
struct PrimarySample {
  double u = 0, v = 0;

  /// Even over the sphere.
  Vec3 direction() const {
    const double z = 1 - 2 * u, r = std::sqrt(std::max(0.0, 1 - z * z));
    const double phi = 2 * std::numbers::pi * v;
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  double contribution() const { return 1.5 + direction()[2]; }
};

/// Exact by rejection: the target is at most 2.5.
PrimarySample exact_primary(Random& random) {
  for (;;) {
    const PrimarySample s{random.uniform(), random.uniform()};
    if (2.5 * random.uniform() < s.contribution()) return s;
  }
}

double wrapped(double u) { return u - std::floor(u); }

/// Large steps draw everything anew, small ones wrap around.
///
/// @source Kelemen et al. 2002, Section 3
PrimarySample mutated(const PrimarySample& s, Random& random) {
  PrimarySample t{random.uniform(), random.uniform()};
  if (random.uniform() > 0.3) {
    t = {wrapped(s.u + 0.1 * (t.u - 0.5)), wrapped(s.v + 0.1 * (t.v - 0.5))};
  }
  return random.uniform() * s.contribution() < t.contribution() ? t : s;
}

TEST(Invariance, OfPrimarySamplesShowsOnTheSphere) {
  const auto direction = [](const PrimarySample& s) { return s.direction(); };
  const auto chain = [&](const std::string& name, auto step) {
    return markov_chain(name, Domain::sphere(), exact_primary, step, direction,
                        [](const Vec3& w) { return (1.5 + w[2]) / (6 * std::numbers::pi); });
  };
  PLUMBLINE_EXPECT_PASS(repeatable(check_chain(chain("primary samples", mutated))));
  // A large step is accepted always.
  const auto too_easily = [](const PrimarySample& s, Random& random) {
    return random.uniform() < 0.3 ? PrimarySample{random.uniform(), random.uniform()}
                                  : mutated(s, random);
  };
  EXPECT_EQ(check_chain(chain("large steps accepted", too_easily)).verdict(), Verdict::fail);
}

TEST(Invariance, RefusesWhatMakesNoSense) {
  EXPECT_THROW(check_invariance({}), std::invalid_argument);
  MarkovChain chain = chain_on_the_line("set", metropolis);
  chain.domain = Domain::discrete(2);
  EXPECT_THROW(check_invariance(chain), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::verify
