#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include "examples.h"

/// Chi-square of every BSDF's samples in float, as rendered, against the integral of its density:
/// every example, from both faces; at the gate from one angle, at night from five.
namespace plumbline::tests {
namespace {

using namespace renderer;

verify::ErasedBsdf as_rendered(const BsdfRef& bsdf) {
  return verify::erase_bsdf<Vec3f, Vec2f>(bsdf);
}

verify::BsdfOptions options_for(const std::string& subject, double eta) {
  verify::BsdfOptions options;
  options.eta = eta;
  options.contract.seed = check_seed(subject);
  return options;
}

std::vector<double> angles() {
  return nightly() ? std::vector<double>{0, 30, 60, 80, 88} : std::vector<double>{60};
}

verify::Vec3 direction_of(double degrees, bool front, double azimuth) {
  const double theta = degrees * std::numbers::pi / 180;
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
          front ? std::cos(theta) : -std::cos(theta)};
}

template <class B>
class ChiSquareInFloat : public testing::Test {};

TYPED_TEST_SUITE(ChiSquareInFloat, BsdfTypes, );

TYPED_TEST(ChiSquareInFloat, SamplesFollowTheDensityFromBothFaces) {
  for (const Example& example : examples_of<TypeParam>()) {
    for (const double degrees : angles()) {
      for (const bool front : {true, false}) {
        const std::string name = example.name + (front ? "/front " : "/back ") +
                                 std::to_string(static_cast<int>(degrees)) + "/float";
        const verify::BsdfOptions options = options_for(name, example.eta);
        verify::Random random(options.contract.seed, 20);
        const double azimuth = 2 * std::numbers::pi * random.uniform();
        const verify::Vec3 wo = direction_of(degrees, front, azimuth);
        expect_verdict(verify::check_chi_square(
            verify::bsdf_pair(name, as_rendered(example.bsdf), wo, options), options.contract));
      }
    }
  }
}

/// Visible normals whose stated density forgets the masking of wo: B2, 0.7 % at α 0.1.
struct WithoutMasking {
  GgxConductor metal{{0.1f, 0.1f}, {}};

  Rgbf eval(const Vec3f& wo, const Vec3f& wi) const { return metal.eval(wo, wi); }
  std::optional<BsdfSample<float>> sample(const Vec3f& wo, const Vec2f& u) const {
    return metal.sample(wo, u);
  }
  float pdf(const Vec3f& wo, const Vec3f& wi) const {
    return metal.pdf(wo, wi) / metal.ggx.masking(wo);
  }
};

TEST(NegativeControl, ADensityWithoutMaskingFailsTheChiSquareCheck) {
  const verify::BsdfOptions options = options_for("without masking", 1);
  verify::CheckResult result = verify::check_chi_square(
      verify::bsdf_pair("without masking", verify::erase_bsdf<Vec3f, Vec2f>(WithoutMasking{}),
                        direction_of(80, true, 0.3), options),
      options.contract);
  result.expected = verify::Verdict::fail;
  expect_verdict(result);
}

}  // namespace
}  // namespace plumbline::tests
