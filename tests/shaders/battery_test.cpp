#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <plumbline/exchange/answerer.h>
#include <plumbline/exchange/self_test.h>
#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/gtest.h>

#include "shaders.h"

namespace plumbline::tests {
namespace {

using verify::CheckResult;

verify::BsdfOptions options_for(const std::string& module) {
  verify::BsdfOptions options;
  options.angles = {50};
  options.random_directions = 0;
  if (module.rfind("rough_glass", 0) == 0) options.eta = 1.5;
  options.contract = contract_options("shader " + module);
  return options;
}

class EachShader : public testing::TestWithParam<const char*> {};

TEST_P(EachShader, Passes) {
  const auto host = start_host(GetParam());
  PLUMBLINE_EXPECT_PASS(
      repeatable(verify::check_bsdf(GetParam(), exchange::as_bsdf(host), options_for(GetParam()))));
  EXPECT_EQ(host->finish(), "");
}

/// With two random numbers, and with three.
TEST(ShaderProtocol, IsKept) {
  for (const char* module : {"ggx", "rough_glass"}) {
    const exchange::AnswererOptions options{host_command(module), {}};
    const auto tell = [](const exchange::SelfTestStep& step) {
      EXPECT_TRUE(step.ok) << step.what << step.detail;
    };
    EXPECT_TRUE(exchange::self_test(
        options, [](const auto&) { return std::nullopt; }, tell));
  }
}

INSTANTIATE_TEST_SUITE_P(Shaders, EachShader, testing::Values("lambertian", "ggx", "rough_glass"),
                         [](const auto& shader) { return std::string(shader.param); });

/// A faulty twin, and a check that is to find it.
struct Fault {
  const char* module;
  const char* check;
  CheckResult (*run)(const verify::ErasedBsdf& bsdf, const verify::BsdfOptions& options);
};

verify::SamplingPair from_60_degrees(const verify::ErasedBsdf& bsdf,
                                     const verify::BsdfOptions& options) {
  constexpr double kAngle = std::numbers::pi / 3;
  return verify::bsdf_pair("front 60°", bsdf, {std::sin(kAngle), 0, std::cos(kAngle)}, options);
}

CheckResult integral(const verify::ErasedBsdf& bsdf, const verify::BsdfOptions& options) {
  return verify::check_integral(from_60_degrees(bsdf, options), options.contract);
}

CheckResult chi_square(const verify::ErasedBsdf& bsdf, const verify::BsdfOptions& options) {
  return verify::check_chi_square(from_60_degrees(bsdf, options), options.contract);
}

CheckResult reciprocity(const verify::ErasedBsdf& bsdf, const verify::BsdfOptions& options) {
  return verify::check_reciprocity("faulty", bsdf, options);
}

class ShaderFault : public testing::TestWithParam<Fault> {};

TEST_P(ShaderFault, IsFound) {
  const Fault& fault = GetParam();
  const verify::BsdfOptions options = options_for(fault.module);
  CheckResult result = fault.run(exchange::as_bsdf(start_host(fault.module)), options);
  result.subject = std::string(fault.module) + "/" + fault.check;
  result.expected = verify::Verdict::fail;
  expect_verdict(result);
}

// Each passes without the fault: that is in the battery above.
INSTANTIATE_TEST_SUITE_P(Shaders, ShaderFault,
                         testing::Values(Fault{"lambertian_1", "integral", integral},
                                         Fault{"lambertian_2", "chi_square", chi_square},
                                         Fault{"ggx_1", "integral", integral},
                                         Fault{"ggx_1", "chi_square", chi_square},
                                         Fault{"ggx_2", "reciprocity", reciprocity},
                                         Fault{"rough_glass_1", "integral", integral},
                                         Fault{"rough_glass_1", "chi_square", chi_square},
                                         Fault{"rough_glass_2", "reciprocity", reciprocity}),
                         [](const auto& fault) {
                           return std::string(fault.param.module) + "_" + fault.param.check;
                         });

}  // namespace
}  // namespace plumbline::tests
