#include <gtest/gtest.h>
#include <plumbline_tests/directions.h>
#include <plumbline_tests/support.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/autodiff.h>
#include <plumbline/verify/detail/random.h>
#include "examples.h"

/// pdf = 1/|∂wi/∂u|, with derivatives to machine precision: the sampling code itself runs in an
/// autodiff type. Lobe by lobe, because a map that chooses lobes is not smooth.
namespace plumbline::tests {
namespace {

using namespace renderer;

/// Decides where rounding in double is more than the tolerance. Of seven million points none needs
/// it; a direction refracted by a cosine that is not the scalar product with its normal needed it
/// at 141 of three million next to u.y = 1, where double was 6e-6 off.
using Quad = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                           boost::multiprecision::et_off>;

/// A relative fault to put into the pdf at wi.
using Fault = std::function<double(const Vec3d& wi)>;

verify::CheckResult check_lobe(const std::string& subject, const BsdfRef& bsdf,
                               const verify::Vec3& wo, std::uint32_t lobe, int points,
                               const Fault& fault = nullptr) {
  // Of unit length to the last digit of every scalar.
  const auto outgoing = [&]<class T>(const T& /*scalar*/) {
    return normalize(Vec3<T>{T(wo[0]), T(wo[1]), T(wo[2])});
  };
  const auto sample = [&](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    const auto s = bsdf.sample_lobe(outgoing(u), lobe, Vec2<T>{u, T(v)});
    return s && !s->is_atom() ? std::optional<Vec3<T>>(s->wi) : std::nullopt;
  };
  const auto pdf = [&]<class T>(const std::array<T, 3>& x) -> T {
    const Vec3<T> wi{x[0], x[1], x[2]};
    const T pdf_w = bsdf.pdf_lobe(outgoing(x[0]), wi, lobe);
    return fault ? T(pdf_w * T(1 + fault(vec_cast<double>(wi)))) : pdf_w;
  };
  verify::AutodiffOptions options;
  options.points = points;
  options.seed = check_seed(subject);
  return verify::check_jacobian_autodiff<Quad>(subject, verify::Domain::sphere(), sample, pdf,
                                               options);
}

/// The lobes of a BSDF at one angle together.
struct Seen {
  std::uint64_t points = 0, ill_conditioned = 0;
};

Seen check_lobes(const Example& example, const std::string& name, const verify::Vec3& wo,
                 int points) {
  Seen seen;
  for (std::uint32_t lobe = 0; lobe < example.bsdf.lobe_count(); ++lobe) {
    const std::string subject = example.name + "/" + name + "/lobe " + std::to_string(lobe);
    verify::CheckResult result = check_lobe(subject, example.bsdf, wo, lobe, points);
    seen.points += result.samples;
    seen.ill_conditioned +=
        static_cast<std::uint64_t>(result.figure(verify::Figure::ill_conditioned).value());
    // Which of its lobes give a density from here is the BSDF's own affair; that one does is not.
    if (result.samples == 0) result.expected = verify::Verdict::inconclusive;
    expect_verdict(result);
  }
  return seen;
}

template <class B>
class Jacobian : public testing::Test {};

TYPED_TEST_SUITE(Jacobian, BsdfTypes, );

TYPED_TEST(Jacobian, OfEachLobeIsTheInverseOfItsPdf) {
  constexpr int kPointsPerBsdf = 40'000;
  const std::vector<Example> examples = examples_of<TypeParam>();
  const int points = kPointsPerBsdf / static_cast<int>(12 * examples.size()) + 1;
  for (const Example& example : examples) {
    verify::Random random(check_seed(example.name + "/jacobian"));
    Seen all;
    for (const double degrees : {0.0, 30.0, 60.0, 80.0, 88.0, 89.9}) {
      for (const bool front : {true, false}) {
        std::ostringstream name;
        name << (front ? "front " : "back ") << degrees;
        const double azimuth = 2 * std::numbers::pi * random.uniform();
        const Seen seen =
            check_lobes(example, name.str(), direction_at(degrees, azimuth, front), points);
        if (has_density(example.gives.of(front))) {
          // Half of a lobe can lie below the horizon, and more of it where the surface is rough.
          EXPECT_GE(4 * seen.points, static_cast<std::uint64_t>(points))
              << example.name << '/' << name.str();
        } else {
          EXPECT_EQ(seen.points, 0u) << example.name << '/' << name.str() << ": no density";
        }
        all.points += seen.points;
        all.ill_conditioned += seen.ill_conditioned;
      }
    }
    EXPECT_LE(1000 * all.ill_conditioned, all.points) << example.name << ": double cannot tell";
  }
}

/// A lobe of the example that has the most ill-conditioned points, with a fault in its pdf.
verify::CheckResult rough_glass_with(const std::string& name, const Fault& fault) {
  for (const Example& example : examples_of<GgxDielectric>()) {
    if (example.name != "GgxDielectric/eta 1.5 alpha 0.2, 0.6") continue;
    return check_lobe("control/" + example.name + "/" + name, example.bsdf, direction_at(60, 0.3),
                      0, 4000, fault);
  }
  throw std::logic_error("the example is gone");
}

void expect_it_fails(verify::CheckResult result) {
  result.expected = verify::Verdict::fail;
  expect_verdict(result);
}

TEST(JacobianControl, WithoutAFaultItPasses) {
  expect_verdict(rough_glass_with("no fault", [](const Vec3d&) { return 0.0; }));
}

TEST(JacobianControl, AFaultOfTenToTheMinusEightEverywhereFails) {
  expect_it_fails(rough_glass_with("constant 1e-8", [](const Vec3d&) { return 1e-8; }));
}

TEST(JacobianControl, AFaultInASmoothPlaceFails) {
  // In a cone of 8 % of the sphere, of which no edge is a fold or the critical angle.
  expect_it_fails(rough_glass_with(
      "1e-8 in a cone", [](const Vec3d& wi) { return std::abs(wi.z) > 0.92 ? 1e-8 : 0.0; }));
}

TEST(JacobianControl, NoPointsShowNothing) {
  const Example mirror = examples_of<SmoothConductor>().front();
  verify::CheckResult result = check_lobe("control/atoms", mirror.bsdf, {0, 0, 1}, 0, 400);
  result.expected = verify::Verdict::inconclusive;
  expect_verdict(result);
  EXPECT_EQ(result.samples, 0u);
}

}  // namespace
}  // namespace plumbline::tests
