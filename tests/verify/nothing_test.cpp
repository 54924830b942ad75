#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/pair.h>

#include "correct_pairs.h"

/// Black keeps every contract, and looks at nothing: no pass.
namespace plumbline::verify {
namespace {

const CheckResult* find(const Report& results, CheckKind kind) {
  const auto at = std::find_if(results.begin(), results.end(),
                               [&](const CheckResult& r) { return r.kind == kind; });
  return at == results.end() ? nullptr : &*at;
}

ContractOptions fresh() {
  ContractOptions o;
  o.seed = tests::check_seed("nothing sampled");
  return o;
}

/// Rejects the share of its numbers, and has the pdf that goes with that.
SamplingPair rejecting(double share) {
  return sampling_pair<double>(
      "rejecting", Domain::interval(),
      [share](double u) -> std::optional<double> {
        if (u < share) return std::nullopt;
        return (u - share) / (1 - share);
      },
      [share](double) { return 1 - share; });
}

TEST(NothingSampled, IsInconclusiveForAPair) {
  const auto results = check_pair(rejecting(1), fresh());
  const CheckResult* r = find(results, CheckKind::samples);
  ASSERT_NE(r, nullptr);
  EXPECT_EQ(r->verdict, Verdict::inconclusive);
  EXPECT_FALSE(r->as_expected());
  EXPECT_NE(r->reason.find("rejected every"), std::string::npos) << r->reason;
}

TEST(NothingSampled, IsNotSaidOfASamplerThatGivesLittle) {
  EXPECT_EQ(find(check_pair(rejecting(0.999), fresh()), CheckKind::samples), nullptr);
}

TEST(NothingSampled, IsInconclusiveForABsdfThatIsBlackFromEverywhere) {
  ErasedBsdf black = erased(Diffuse{});
  black.sample = [](const Vec3&, const Uniforms&) { return std::nullopt; };
  black.pdf = [](const Vec3&, const Vec3&) { return 0.0; };
  BsdfOptions o;
  o.angles = {0, 60};
  o.random_directions = 0;
  o.contract = fresh();
  const auto results = check_bsdf("black", black, o);
  const CheckResult* r = find(results, CheckKind::samples);
  ASSERT_NE(r, nullptr);
  EXPECT_EQ(r->verdict, Verdict::inconclusive);
  EXPECT_FALSE(r->reason.empty());
  EXPECT_EQ(find(check_bsdf("diffuse, black from below", erased(Diffuse{}), o), CheckKind::samples),
            nullptr);
}

}  // namespace
}  // namespace plumbline::verify
