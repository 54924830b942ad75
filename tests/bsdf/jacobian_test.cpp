#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <boost/math/differentiation/autodiff.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/detail/random.h>
#include "examples.h"

/// pdf = 1/|∂wi/∂u|, with derivatives to machine precision: the sampling code itself runs in an
/// autodiff type. Lobe by lobe, because a map that chooses lobes is not smooth.
namespace plumbline::tests {
namespace {

using namespace renderer;
namespace autodiff = boost::math::differentiation;

using Quad = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                           boost::multiprecision::et_off>;

/// A number with both first derivatives.
template <class S>
using Dual = autodiff::promote<autodiff::autodiff_fvar<S, 1>, autodiff::autodiff_fvar<S, 0, 1>>;

constexpr double kTolerance = 1e-9;

/// Where fewer points than this have a density, nothing has been shown.
constexpr std::uint64_t kFewestPoints = 100;

/// Area of the sphere that the map stretches a unit of the square to.
template <class S>
S stretch(const Vec3<Dual<S>>& wi) {
  const auto tangent = [&](std::size_t x, std::size_t y) {
    return Vec3<S>{wi.x.derivative(x, y), wi.y.derivative(x, y), wi.z.derivative(x, y)};
  };
  return length(cross(tangent(1, 0), tangent(0, 1)));
}

/// A lobe's map at one place: where it leads, and the density there times the stretch, which is 1.
template <class S>
struct Product {
  Vec3<S> wi;
  S value;
};

/// @return nullopt where nothing is sampled, or an atom
template <class S>
std::optional<Product<S>> product_at(const BsdfRef& bsdf, const Vec3<S>& wo, std::uint32_t lobe,
                                     double ux, double uy) {
  const auto [x, y] = autodiff::make_ftuple<S, 1, 1>(S(ux), S(uy));
  using D = Dual<S>;
  const auto sample =
      bsdf.sample_lobe(Vec3<D>{D(wo.x), D(wo.y), D(wo.z)}, lobe, Vec2<D>{D(x), D(y)});
  if (!sample || sample->is_atom()) return std::nullopt;
  const Vec3<S> wi{static_cast<S>(sample->wi.x), static_cast<S>(sample->wi.y),
                   static_cast<S>(sample->wi.z)};
  return Product<S>{wi, bsdf.pdf_lobe(wo, wi, lobe) * stretch<S>(sample->wi)};
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

/// A relative fault to put into the pdf at wi; 0 for the density as it is.
using Fault = std::function<double(const Vec3d& wi)>;

/// How far pdf · stretch is from 1, and where double cannot tell.
struct Worst {
  std::uint64_t points = 0, ill_conditioned = 0;
  double error = 0, error_of_rounding = 0;
  std::string place;

  void add(double off, const std::string& where) {
    if (off <= error) return;
    error = std::isnan(off) ? std::numeric_limits<double>::infinity() : off;
    place = where;
  }
};

/// Points are random, and some may lie where rounding of wo, u or wi changes the product by more
/// than the tolerance. In quad precision the same formulas have 18 digits more: a product that is
/// wrong there is a wrong formula, one that is right was rounding, and is counted. Of seven million
/// points none needs it; a direction refracted by a cosine that is not the scalar product with its
/// normal needed it at 141 of three million next to u.y = 1, where double was 6e-6 off.
void add_point(const BsdfRef& bsdf, const Vec3d& wo, std::uint32_t lobe, double ux, double uy,
               const Fault& fault, Worst& worst) {
  const auto in_double = product_at<double>(bsdf, wo, lobe, ux, uy);
  if (!in_double) return;
  ++worst.points;
  const double factor = fault ? 1 + fault(in_double->wi) : 1;
  const double error = std::abs(in_double->value * factor - 1);
  std::ostringstream place;
  if (!(error <= worst.error)) {
    place << "cosθo " << wo.z << ", lobe " << lobe << ", u " << ux << ' ' << uy;
  }
  if (error <= kTolerance) {
    worst.add(error, place.str());
    return;
  }
  const auto in_quad = product_at<Quad>(bsdf, normalize(vec_cast<Quad>(wo)), lobe, ux, uy);
  const double exact =
      in_quad ? std::abs(static_cast<double>(in_quad->value * Quad(factor) - Quad(1))) : error;
  if (exact <= kTolerance) {
    ++worst.ill_conditioned;
    worst.error_of_rounding = std::max(worst.error_of_rounding, error);
  } else {
    worst.add(exact, place.str());
  }
}

Worst walk(const Example& example, int points_per_direction, const Fault& fault = nullptr) {
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
          add_point(example.bsdf, wo, lobe, x, number(random), fault, worst);
        }
      }
    }
  }
  return worst;
}

verify::CheckResult result_of(const std::string& subject, const Worst& worst) {
  verify::CheckResult result;
  result.kind = verify::CheckKind::jacobian;
  result.subject = subject;
  result.verdict = worst.error <= kTolerance ? verify::Verdict::pass : verify::Verdict::fail;
  result.estimate = 1 + worst.error;
  result.reference = 1;
  result.tolerance = kTolerance;
  result.bound = worst.error;
  result.samples = worst.points;
  result.leaned_on = "automatic differentiation in double, in quad where rounding decides";
  result.figures = {{"ill-conditioned points", static_cast<double>(worst.ill_conditioned)},
                    {"largest error of rounding", worst.error_of_rounding}};
  if (!worst.place.empty()) result.reason = "largest error at " + worst.place;
  if (result.verdict == verify::Verdict::pass && worst.points < kFewestPoints) {
    result.verdict = verify::Verdict::inconclusive;
    result.reason = "only " + std::to_string(worst.points) + " points have a density";
  } else if (result.verdict == verify::Verdict::pass &&
             1000 * worst.ill_conditioned > worst.points) {
    result.verdict = verify::Verdict::inconclusive;
    result.reason = "double cannot tell at more than one point in 1000";
  }
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
    expect_verdict(result_of(example.name + "/jacobian", worst));
  }
}

/// The example that has the most ill-conditioned points, with a fault in its pdf.
verify::CheckResult rough_glass_with(const std::string& name, const Fault& fault) {
  for (const Example& example : examples_of<GgxDielectric>()) {
    if (example.name != "GgxDielectric/eta 1.5 alpha 0.2, 0.6") continue;
    verify::CheckResult result =
        result_of("control/" + example.name + "/" + name, walk(example, 400, fault));
    result.expected = verify::Verdict::fail;
    return result;
  }
  throw std::logic_error("the example is gone");
}

TEST(JacobianControl, AFaultOfTenToTheMinusEightEverywhereFails) {
  expect_verdict(rough_glass_with("constant 1e-8", [](const Vec3d&) { return 1e-8; }));
}

TEST(JacobianControl, AFaultInASmoothPlaceFails) {
  // In a cone of 8 % of the sphere, of which no edge is a fold or the critical angle.
  expect_verdict(rough_glass_with(
      "1e-8 in a cone", [](const Vec3d& wi) { return std::abs(wi.z) > 0.92 ? 1e-8 : 0.0; }));
}

TEST(JacobianControl, NoPointsShowNothing) {
  verify::CheckResult result = result_of("control/no points", Worst{});
  result.expected = verify::Verdict::inconclusive;
  expect_verdict(result);
}

}  // namespace
}  // namespace plumbline::tests
