#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include <plumbline/verify/pair.h>
#include "pairs/binned_pair.h"

/// Bins against samples that are rounded, and whose masses are not known for nothing.
namespace plumbline::verify {
namespace {

double on_lattice(double u, double step) { return (std::floor(u / step) + 0.5) * step; }

/// Uniform in the unit square, on lines that lie `step` apart: a little askew, as no bins begin and
/// end where floats do.
SamplingPair rounded(double step) {
  SamplingPair pair;
  pair.name = "rounded to " + std::to_string(step);
  pair.domain = Domain::unit_square();
  pair.sample = [step](const Uniforms& u) {
    const double x = on_lattice(u[0], step) + 0.02 * u[1];
    return std::optional(SampleRecord{{x - std::floor(x), u[1], 0}, 1});
  };
  pair.pdf = [](const Vec3&) { return 1.0; };
  return pair;
}

CheckResult check(const SamplingPair& pair, std::uint64_t run) {
  ContractOptions options;
  options.seed = tests::check_seed("rounded samples") + run;
  options.first_look = options.samples = 2'000'000;
  return check_chi_square(pair, options);
}

// A bin is a 64th wide on average, nine steps of 1/600: it holds eight, nine or ten of them.
TEST(RoundedSamples, PassWhereTheirStepIsThatOfTheScalar) {
  for (const std::uint64_t run : {0u, 1u, 2u}) {
    SamplingPair pair = rounded(1.0 / 600);
    pair.epsilon = 1.0 / 2400;  // what is computed from rounded numbers has a few times the step
    const CheckResult r = check(pair, run);
    EXPECT_EQ(r.verdict, Verdict::pass) << describe(r);
  }
}

TEST(RoundedSamples, FailWhereTheScalarIsFiner) {
  const CheckResult r = check(rounded(1.0 / 600), 0);
  EXPECT_EQ(r.verdict, Verdict::fail) << describe(r);
  EXPECT_NE(r.reason.find("bins, the one around"), std::string::npos) << r.reason;
}

TEST(RoundedSamples, OfAWrongDensityFailAllTheSame) {
  SamplingPair pair = rounded(1.0 / 600);
  pair.epsilon = 1.0 / 2400;
  pair.pdf = [](const Vec3& x) { return 0.95 + 0.1 * x[0]; };
  const CheckResult r = check(pair, 0);
  EXPECT_EQ(r.verdict, Verdict::fail) << describe(r);
}

/// Where the nodes of a bin's mass lie follows from the seed: what one night has missed the next
/// one sees. The samples are the same here, whatever the seed.
TEST(MassOfBins, IsMeasuredElsewhereWithAnotherSeed) {
  const auto asked = [](std::uint64_t seed) {
    std::set<std::array<double, 2>> points;
    SamplingPair pair;
    pair.name = "seeds of nodes";
    pair.domain = Domain::unit_square();
    pair.sample = [drawn = std::uint64_t{0}](const Uniforms&) mutable {
      ++drawn;
      const double x = static_cast<double>(drawn) * 0.7548776662466927,
                   y = static_cast<double>(drawn) * 0.5698402909980532;
      return std::optional(SampleRecord{{x - std::floor(x), y - std::floor(y), 0}, 1});
    };
    pair.pdf = [&points](const Vec3& x) {
      points.insert({x[0], x[1]});
      return 1 + 0.5 * std::sin(40 * x[0] + 30 * x[1] * x[1]);
    };
    ContractOptions options;
    options.seed = seed;
    options.evaluations = 60'000;
    options.finest_bins = 256;
    const BinnedPair binned(pair, options, 1e-9);
    return points;
  };
  const auto one = asked(1), other = asked(2);
  std::size_t common = 0;
  for (const auto& point : one) common += other.count(point);
  // The points that show where to cut are the same; half of the rest is at random.
  EXPECT_LT(static_cast<double>(common), 0.7 * static_cast<double>(one.size()));
}

}  // namespace
}  // namespace plumbline::verify
