#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <boost/math/differentiation/autodiff.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <vector>

#include <plumbline/verify/detail/random.h>
#include "examples.h"

/// pdf = 1/|∂wi/∂u|, with derivatives to machine precision: the sampling code itself runs in an
/// autodiff type. Lobe by lobe, because a map that chooses lobes is not smooth.
namespace plumbline::tests {
namespace {

using namespace renderer;
namespace autodiff = boost::math::differentiation;

/// A number with both first derivatives.
using Dual =
    autodiff::promote<autodiff::autodiff_fvar<double, 1>, autodiff::autodiff_fvar<double, 0, 1>>;

constexpr double kTolerance = 1e-9;

/// Area of the sphere that the map stretches a unit of the square to.
double stretch(const Vec3<Dual>& wi) {
  const auto tangent = [&](std::size_t x, std::size_t y) {
    return Vec3d{wi.x.derivative(x, y), wi.y.derivative(x, y), wi.z.derivative(x, y)};
  };
  return length(cross(tangent(1, 0), tangent(0, 1)));
}

/// In [1e-12, 1 − 1e-12], as often next to an end as anywhere.
double number(verify::Random& random) {
  const double small = std::pow(10.0, -12 * random.uniform());
  switch (random.bits() % 4) {
    case 0:
      return small;
    case 1:
      return std::min(1 - small, 1 - 1e-12);
    default:
      return std::max(random.uniform(), 1e-12);
  }
}

/// How far pdf · stretch is from 1.
struct Worst {
  std::uint64_t points = 0;
  double error = 0;
  std::string place;
};

void add_point(const BsdfRef& bsdf, const Vec3d& wo, std::uint32_t lobe, double ux, double uy,
               Worst& worst) {
  const auto [x, y] = autodiff::make_ftuple<double, 1, 1>(ux, uy);
  const Vec3<Dual> dual_wo{Dual(wo.x), Dual(wo.y), Dual(wo.z)};
  const auto sample = bsdf.sample_lobe(dual_wo, lobe, Vec2<Dual>{Dual(x), Dual(y)});
  if (!sample || sample->is_atom()) return;
  const Vec3d wi{static_cast<double>(sample->wi.x), static_cast<double>(sample->wi.y),
                 static_cast<double>(sample->wi.z)};
  const double error = std::abs(bsdf.pdf_lobe(wo, wi, lobe) * stretch(sample->wi) - 1);
  ++worst.points;
  if (!(error <= worst.error)) {
    std::ostringstream place;
    place << "cosθo " << wo.z << ", lobe " << lobe << ", u " << ux << ' ' << uy;
    worst.error = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
    worst.place = place.str();
  }
}

Worst walk(const Example& example, int points_per_direction) {
  verify::Random random(check_seed(example.name + "/jacobian"));
  Worst worst;
  for (const double degrees : {0.0, 30.0, 60.0, 80.0, 88.0, 89.9}) {
    for (const double side : {1.0, -1.0}) {
      const double theta = degrees * std::numbers::pi / 180;
      const double phi = 2 * std::numbers::pi * random.uniform();
      const Vec3d wo{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                     side * std::cos(theta)};
      for (std::uint32_t lobe = 0; lobe < example.bsdf.lobe_count(); ++lobe) {
        for (int i = 0; i < points_per_direction; ++i) {
          const double x = number(random);
          add_point(example.bsdf, wo, lobe, x, number(random), worst);
        }
      }
    }
  }
  return worst;
}

verify::CheckResult result_of(const Example& example, const Worst& worst) {
  verify::CheckResult result;
  result.kind = verify::CheckKind::jacobian;
  result.subject = example.name + "/jacobian";
  result.verdict = worst.error <= kTolerance ? verify::Verdict::pass : verify::Verdict::fail;
  result.estimate = 1 + worst.error;
  result.reference = 1;
  result.tolerance = kTolerance;
  result.bound = worst.error;
  result.samples = worst.points;
  result.leaned_on = "automatic differentiation in double";
  if (!worst.place.empty()) result.reason = "largest error at " + worst.place;
  return result;
}

template <class B>
class Jacobian : public testing::Test {};

TYPED_TEST_SUITE(Jacobian, BsdfTypes, );

TYPED_TEST(Jacobian, OfEachLobeIsTheInverseOfItsPdf) {
  constexpr int kPointsPerBsdf = 40'000;
  const std::vector<Example> examples = examples_of<TypeParam>();
  for (const Example& example : examples) {
    const Worst worst = walk(example, kPointsPerBsdf / static_cast<int>(12 * examples.size()) + 1);
    if (!example.bsdf.parts().density) {
      EXPECT_EQ(worst.points, 0u) << example.name << ": an atom has no density";
      continue;
    }
    expect_verdict(result_of(example, worst));
  }
}

}  // namespace
}  // namespace plumbline::tests
