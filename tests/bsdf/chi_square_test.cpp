#include <gtest/gtest.h>
#include <plumbline_tests/directions.h>
#include <plumbline_tests/support.h>

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
  options.contract = contract_options(subject);
  // A lobe of 1e-4 next to the horizon is a hundred floats wide: its steps take more to integrate.
  if (nightly()) options.contract.evaluations *= 4;
  return options;
}

std::vector<double> angles() {
  return nightly() ? std::vector<double>{0, 30, 60, 80, 88} : std::vector<double>{60};
}

/// The samples of a BSDF in float against the density that it states for them.
verify::CheckResult check(const std::string& name, const verify::ErasedBsdf& bsdf,
                          const verify::Vec3& wo, const verify::BsdfOptions& options) {
  return verify::check_chi_square(verify::bsdf_pair(name, bsdf, wo, options), options.contract);
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
        verify::Random random(check_seed(name + "/azimuth"));
        const double azimuth = 2 * std::numbers::pi * random.uniform();
        expect_verdict(
            check(name, as_rendered(example.bsdf), direction_at(degrees, azimuth, front), options));
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
  verify::CheckResult result =
      check("without masking", verify::erase_bsdf<Vec3f, Vec2f>(WithoutMasking{}),
            direction_at(80, 0.3), options_for("without masking", 1));
  result.expected = verify::Verdict::fail;
  expect_verdict(result);
  // Masking is a constant of the density: its integral shows it, not its shape.
  EXPECT_NE(result.reason.find("∫pdf = 1.0"), std::string::npos) << result.reason;
}

TEST(ChiSquareOfFloats, OfTheLambertianAlongTheNormalAndNextToTheHorizon) {
  const Example diffuse = examples_of<Lambertian>().front();
  for (const double degrees : {0.0, 84.0}) {
    const std::string name =
        diffuse.name + "/" + std::to_string(static_cast<int>(degrees)) + "/float";
    expect_verdict(
        check(name, as_rendered(diffuse.bsdf), direction_at(degrees, 0.1), options_for(name, 1)));
  }
}

TEST(NegativeControl, ALambertianDensityWithoutOneOverPiFails) {
  const Example diffuse = examples_of<Lambertian>().front();
  verify::ErasedBsdf bsdf = as_rendered(diffuse.bsdf);
  bsdf.pdf = [right = bsdf.pdf](const verify::Vec3& wo, const verify::Vec3& wi) {
    return right(wo, wi) * std::numbers::pi;
  };
  const std::string name = "control/lambertian, density without 1/pi";
  verify::CheckResult result = check(name, bsdf, {0, 0, 1}, options_for(name, 1));
  result.expected = verify::Verdict::fail;
  expect_verdict(result);
  EXPECT_NE(result.reason.find("∫pdf = 3.14"), std::string::npos) << result.reason;
}

}  // namespace
}  // namespace plumbline::tests
