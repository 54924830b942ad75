#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include <plumbline/verify/bsdf.h>

#include "correct_pairs.h"

namespace plumbline::verify {
namespace {

constexpr double kIndexBelow = 1.5, kRoughness = 0.3;

/// Glass seen from above; half of the normals, D cosθ, reflect and half refract. pdf() lacks the
/// Jacobian of the refraction.
struct GlassWithoutJacobian {
  static std::optional<Vec3> sampled(const Vec3& wo, const Uniforms& u) {
    const bool through = u[1] < 0.5;
    const double phi = 4 * std::numbers::pi * u[1], t = kRoughness * std::sqrt(u[0] / (1 - u[0]));
    const Vec3 h = unit({t * std::cos(phi), t * std::sin(phi), 1});
    const double c = dot_of(wo, h);
    if (!(c > 0)) return std::nullopt;
    const double a =
        through ? c / kIndexBelow - std::sqrt(1 - (1 - c * c) / (kIndexBelow * kIndexBelow))
                : 2 * c;
    const double b = through ? -1 / kIndexBelow : -1;
    const Vec3 wi{a * h[0] + b * wo[0], a * h[1] + b * wo[1], a * h[2] + b * wo[2]};
    if (through ? wi[2] >= 0 : wi[2] <= 0) return std::nullopt;
    return wi;
  }
  static double pdf(const Vec3& wo, const Vec3& wi) {
    const bool through = wi[2] < 0;
    const double n = through ? kIndexBelow : 1;
    Vec3 h = unit({wo[0] + n * wi[0], wo[1] + n * wi[1], wo[2] + n * wi[2]});
    if (h[2] < 0) h = {-h[0], -h[1], -h[2]};
    const double o = dot_of(wo, h), i = dot_of(wi, h);
    if (!(o > 0) || (through ? !(i < 0) : !(i > 0))) return 0;
    const double normals = RoughMirror{kRoughness}.distribution(h) * h[2] / 2;
    return through ? normals : normals / (4 * o);
  }
};

TEST(Bsdfs, TheIndexReachesTheDiagnosis) {
  ErasedBsdf b;
  b.sample = [](const Vec3& wo, const Uniforms& u) -> std::optional<SampleRecord> {
    const auto wi = GlassWithoutJacobian::sampled(wo, u);
    if (!wi) return std::nullopt;
    return SampleRecord{*wi, {}, {}};
  };
  b.pdf = GlassWithoutJacobian::pdf;
  b.eval = [](const Vec3& wo, const Vec3& wi) { return gray(GlassWithoutJacobian::pdf(wo, wi)); };
  BsdfOptions o;
  o.eta = kIndexBelow;
  o.angles = {30};
  o.random_directions = 0;
  o.back = o.reciprocal = o.conserves_energy = false;
  o.contract.points = 200;
  o.contract.jacobian_points = 400;
  o.contract.evaluations = 100'000;
  o.contract.first_look = o.contract.samples = 20'000;
  o.contract.finest_bins = 64;
  const Report report = check_bsdf("glass", b, o);
  EXPECT_EQ(report.cause_kind, CauseKind::refraction_jacobian) << report.summary();
  EXPECT_EQ(report.cause.find("factor dω_h/dω_i of the refraction missing from pdf()"), 0u)
      << report.cause;
}

}  // namespace
}  // namespace plumbline::verify
