#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include "examples.h"
#include "known_albedo.h"

/// The battery of plumbline::verify on every BSDF: what is deterministic, in double.
namespace plumbline::tests {
namespace {

using namespace renderer;

verify::ErasedBsdf in_double(const Example& example) {
  return verify::erase_bsdf<Vec3<double>, Vec2<double>>(example.bsdf);
}

verify::BsdfOptions options_for(const Example& example, const std::string& subject) {
  verify::BsdfOptions options;
  options.eta = example.eta;
  options.contract.seed = check_seed(subject);
  options.contract.points = nightly() ? 10'000 : 1'000;
  // A ridge ten thousand times as long as it is wide, curved across the chart of directions.
  if (example.name == "GgxConductor/alpha 1e-4, 1") options.contract.finest_bins = 16384;
  return options;
}

/// A direction with its name: "front 60".
struct View {
  std::string name;
  verify::Vec3 wo;
};

/// Both faces at random azimuths: at night at all of the angles.
std::vector<View> views(const std::string& subject) {
  verify::Random random(check_seed(subject));
  std::vector<View> all;
  const std::vector<double> angles =
      nightly() ? std::vector<double>{0, 60, 80, 88, 89.9} : std::vector<double>{60, 88};
  for (const double degrees : angles) {
    const double theta = degrees * std::numbers::pi / 180;
    for (const bool front : {true, false}) {
      const double phi = 2 * std::numbers::pi * random.uniform();
      const std::string angle =
          degrees == 89.9 ? "89.9" : std::to_string(static_cast<int>(degrees));
      all.push_back({(front ? "/front " : "/back ") + angle,
                     {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                      front ? std::cos(theta) : -std::cos(theta)}});
    }
  }
  return all;
}

template <class B>
class Battery : public testing::Test {};

TYPED_TEST_SUITE(Battery, BsdfTypes, );

TYPED_TEST(Battery, SamplePdfAndEvalAgreePointByPoint) {
  for (const Example& example : examples_of<TypeParam>()) {
    const verify::ErasedBsdf bsdf = in_double(example);
    for (const View& view : views(example.name)) {
      const std::string name = example.name + view.name;
      const verify::BsdfOptions options = options_for(example, name + "/pointwise");
      const verify::SamplingPair pair = verify::bsdf_pair(name, bsdf, view.wo, options);
      for (const verify::CheckResult& result : verify::check_pointwise(pair, options.contract)) {
        expect_verdict(result);
      }
      if (example.bsdf.parts().atoms) {
        expect_verdict(verify::check_atoms(name, bsdf, view.wo, options));
      }
    }
  }
}

TYPED_TEST(Battery, PdfAtomsAndRejectedSamplesSumToOne) {
  for (const Example& example : examples_of<TypeParam>()) {
    const verify::ErasedBsdf bsdf = in_double(example);
    for (const View& view : views(example.name)) {
      const std::string name = example.name + view.name;
      const verify::BsdfOptions options = options_for(example, name + "/integral");
      expect_verdict(verify::check_integral(verify::bsdf_pair(name, bsdf, view.wo, options),
                                            options.contract));
    }
  }
}

TYPED_TEST(Battery, IsReciprocal) {
  for (const Example& example : examples_of<TypeParam>()) {
    expect_verdict(verify::check_reciprocity(example.name, in_double(example),
                                             options_for(example, example.name + "/reciprocity")));
  }
}

TYPED_TEST(Battery, EvalHasTheAlbedoByQuadrature) {
  for (const Example& example : examples_of<TypeParam>()) {
    for (const View& view : views(example.name)) {
      const std::string name = example.name + view.name;
      verify::BsdfOptions options = options_for(example, name + "/energy");
      const double albedo = known_albedo(example, {view.wo[0], view.wo[1], view.wo[2]}, 0);
      EXPECT_LE(albedo, 1 + 1e-6) << name;
      options.albedo = [&](const verify::Vec3&) { return albedo; };
      options.energy_tolerance = albedo_tolerance(example);
      expect_verdict(verify::check_energy(name, in_double(example), view.wo, options));
    }
  }
}

}  // namespace
}  // namespace plumbline::tests
