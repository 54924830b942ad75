#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cctype>

#include <plumbline/verify/contract.h>
#include <plumbline/verify/jacobian_autodiff.h>

#include "light_examples.h"

/// Every light of the renderer through the contract battery, driven by the variant's type list.
namespace plumbline::tests {
namespace {

using renderer::Vec2;
using renderer::Vec3;
using verify::SamplingPair;

/// The light as a sampling pair of directions at the reference point, in the scalar T.
template <class T>
SamplingPair light_pair(const LightExample& example) {
  const Vec3<T> reference = renderer::vec_cast<T>(example.reference);
  SamplingPair pair;
  pair.name = "light/" + example.name;
  pair.domain = verify::Domain::sphere();
  pair.epsilon = std::is_same_v<T, float> ? 0x1p-24 : 0x1p-53;
  pair.sample = [=](const verify::Uniforms& u) -> std::optional<verify::PairSample> {
    const auto s = renderer::sample(example.light, reference,
                                    Vec2<T>{static_cast<T>(u[0]), static_cast<T>(u[1])});
    if (!s) return std::nullopt;
    verify::PairSample result;
    result.x = verify::to_vec3(s->wi);
    result.pdf = static_cast<double>(s->pdf_w);
    return result;
  };
  pair.pdf = [=](const verify::Vec3& wi) {
    return static_cast<double>(
        renderer::pdf(example.light, reference, verify::from_vec3<Vec3<T>>(wi)));
  };
  return pair;
}

class Lights : public testing::TestWithParam<LightExample> {};

TEST_P(Lights, KeepTheContract) {
  const SamplingPair pair = light_pair<double>(GetParam());
  verify::ContractOptions options;
  options.seed = check_seed(pair.name);
  for (const verify::CheckResult& r : check_pair(pair, options)) expect_verdict(r);
}

TEST_P(Lights, SampleTheirDensityInFloatAsRendered) {
  SamplingPair pair = light_pair<float>(GetParam());
  pair.name += "/float";
  verify::ContractOptions options;
  options.seed = check_seed(pair.name);
  for (const verify::CheckResult& r : check_pointwise(pair, options)) expect_verdict(r);
  expect_verdict(check_chi_square(pair, options));
}

TEST_P(Lights, PdfIsTheInverseJacobianOfSample) {
  const LightExample& example = GetParam();
  const auto sample = [&](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    auto s =
        renderer::sample(example.light, renderer::vec_cast<T>(example.reference), Vec2<T>{u, T(v)});
    return s ? std::optional<Vec3<T>>(s->wi) : std::nullopt;
  };
  const auto pdf = [&](const verify::Vec3& wi) {
    return renderer::pdf(example.light, renderer::vec_cast<double>(example.reference),
                         verify::from_vec3<renderer::Vec3d>(wi));
  };
  verify::AutodiffOptions options;
  options.seed = check_seed(example.name);
  verify::CheckResult r = check_jacobian_autodiff("light/" + example.name, verify::Domain::sphere(),
                                                  sample, pdf, options);
  // Seen from behind a light gives no sample, and has no Jacobian.
  if (r.samples == 0) r.expected = verify::Verdict::inconclusive;
  expect_verdict(r);
}

INSTANTIATE_TEST_SUITE_P(All, Lights, testing::ValuesIn(all_light_examples()),
                         [](const testing::TestParamInfo<LightExample>& example) {
                           std::string name = example.param.name;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

TEST(LightSelection, IsADiscretePairForAnyNumberOfLights) {
  for (const std::uint32_t count : {1u, 2u, 5u, 1000u}) {
    const renderer::UniformLightSelection selection{count};
    const std::string name = "light selection/" + std::to_string(count);
    verify::ContractOptions options;
    options.seed = check_seed(name);
    const auto pair = verify::make_pair<int>(
        name, verify::Domain::discrete(count),
        [=](float u) { return static_cast<int>(selection.sample(u).light); },
        [=](int i) { return selection.pmf<float>(static_cast<std::uint32_t>(i)); });
    for (const verify::CheckResult& r : check_pair(pair, options)) expect_verdict(r);
  }
}

TEST(LightSelection, LeavesAUniformNumberBehind) {
  const renderer::UniformLightSelection selection{3};
  verify::ContractOptions options;
  options.seed = check_seed("light selection/rest");
  auto pair = verify::make_pair<float>(
      "light selection/rest", verify::Domain::interval(0, 1),
      [=](float u) { return selection.sample(u).u; }, [](float) { return 1.0f; });
  // Each light leads to every rest: three numbers for one point.
  pair.many_to_one = true;
  pair.preimages = [](const verify::Vec3& x) {
    return std::vector<verify::Uniforms>{
        {x[0] / 3, 0, 0}, {(1 + x[0]) / 3, 0, 0}, {(2 + x[0]) / 3, 0, 0}};
  };
  for (const verify::CheckResult& r : check_pair(pair, options)) expect_verdict(r);
}

TEST(Lights, TheBatteryFailsAreaInThePlaceOfItsInverse) {
  // Seen by nobody who tests with unit areas: the rectangle has 40 m².
  for (const LightExample& example : LightExamples<renderer::RectangleLight>::all()) {
    if (example.name != "RectangleLight/large") continue;
    SamplingPair pair = light_pair<float>(example);
    const auto right = pair.pdf;
    pair.pdf = [right](const verify::Vec3& wi) { return right(wi) * 40 * 40; };
    bool failed = false;
    for (const verify::CheckResult& r : check_pair(pair)) {
      failed = failed || r.verdict == verify::Verdict::fail;
    }
    EXPECT_TRUE(failed);
  }
}

}  // namespace
}  // namespace plumbline::tests
