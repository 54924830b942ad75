#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <string>

#include <plumbline/verify/gtest.h>

#include "pair_maps.h"
#include "pair_support.h"

/// Sampling pairs that an earlier version crashed on, or failed though they are right.
namespace plumbline::tests::corpus {
namespace {

using verify::CheckResult;
using verify::Report;
using verify::Verdict;

/// A clamp puts three samples of ten on a circle, z equal but for the last bit: no bin can be cut
/// so that it holds few of them.
TEST(OnceMisjudged, ARingThatIsExactButForTheLastBitIsALine) {
  const auto sample = [](double u, double v) {
    const double on_ring = 0.0232663 * (v < 0.5 ? 1 : 1 + 0x1p-51), z = u < 0.3 ? on_ring : u;
    const double r = std::sqrt(1 - z * z), phi = 2 * pi_v<double> * v;
    return Xyz<double>{r * std::cos(phi), r * std::sin(phi), -z};
  };
  const auto below = [](const Xyz<double>& w) { return w.z < 0 ? 1 / (2 * pi_v<double>) : 0.0; };
  verify::ContractOptions options;
  options.seed = check_seed("ring");
  const Report report = verify::check_pair(
      verify::sampling_pair<Xyz<double>>("ring", Domain::sphere(), sample, below), options);
  EXPECT_EQ(report.verdict(), Verdict::fail);
  EXPECT_EQ(to_string(report.cause_kind), to_string(Kind::on_a_line)) << report.summary();
  EXPECT_NE(report.cause.find("lie on a line, z = -0.0232663"), std::string::npos) << report.cause;
}

/// @param columns  of an equirectangular map
/// @param sun      radiance of one texel among others of about 1
Report map_on_the_plain_sphere(int columns, double sun, verify::ContractOptions options = {}) {
  options.seed = check_seed("map " + std::to_string(columns) + " " + std::to_string(sun));
  return verify::check_pair(map_by_rows<double>(columns, columns / 2, sun, false), options);
}

TEST(OnceMisjudged, SmallMapsWithSunsPassOnThePlainSphere) {
  PLUMBLINE_EXPECT_PASS(repeatable(map_on_the_plain_sphere(8, 500)));
  PLUMBLINE_EXPECT_PASS(repeatable(map_on_the_plain_sphere(32, 500)));
  PLUMBLINE_EXPECT_PASS(repeatable(map_on_the_plain_sphere(32, 50'000)));
}

/// The edges of so many texels are not found one by one.
TEST(OnceMisjudged, LargeMapsOnThePlainSphereAreToldOfTheirDomain) {
  verify::ContractOptions few;
  few.evaluations = 1'000'000;
  for (const double sun : {0.0, 500.0}) {
    const Report report = map_on_the_plain_sphere(128, sun, few);
    EXPECT_EQ(report.verdict(), Verdict::inconclusive) << report.summary();
    for (const CheckResult& r : report) {
      const bool told = r.advice.find("equirectangular") != std::string::npos;
      EXPECT_TRUE(r.as_expected() || told) << describe(r);
    }
  }
}

}  // namespace
}  // namespace plumbline::tests::corpus
