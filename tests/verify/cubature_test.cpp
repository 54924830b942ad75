#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include <plumbline/verify/pair.h>

#include "pairs/binned_pair.h"
#include "pairs/cubature.h"
#include "pairs/mass_balance.h"

namespace plumbline::verify {
namespace {

constexpr double kPi = std::numbers::pi;

CubatureResult over_square(const std::function<double(const Point2&)>& f, double target) {
  std::vector<Point2> no_points;
  return integrate(f, {Cell{}}, no_points, 1, target, 1'000'000);
}

TEST(Cubature, IsExactForDegreeSeven) {
  // ∫∫ x³y⁴ = 1/20, ∫∫ x⁷ = 1/8 over the unit square, at the first try.
  const auto f = [](const Point2& p) {
    return std::pow(p[0], 3) * std::pow(p[1], 4) + std::pow(p[0], 7);
  };
  std::vector<Point2> no_points;
  const CubatureResult r = integrate(f, {Cell{}}, no_points, 1, 1, 17);
  EXPECT_NEAR(r.total, 1.0 / 20 + 1.0 / 8, 1e-14);
  EXPECT_EQ(r.evaluations, 17u);
}

TEST(Cubature, FindsAPeakByItsPointsAndKeepsItsErrorEstimate) {
  const auto peak = [](const Point2& p) {
    return std::exp(-1e4 * (std::pow(p[0] - 0.31, 2) + std::pow(p[1] - 0.57, 2)));
  };
  // The peak lies 30 widths from every border: ∫ = π/1e4.
  std::vector<Point2> points = {{0.31, 0.57}};
  const CubatureResult r = integrate(peak, {{{}, 0, 0, 1}}, points, 1, 1e-9, 1'000'000);
  EXPECT_LE(std::abs(r.total - kPi / 1e4), r.total_error);
  EXPECT_LE(r.total_error, 1e-9);
}

TEST(Cubature, KeepsItsErrorEstimateAcrossEdges) {
  const auto disk = [](const Point2& p) {
    return std::pow(p[0] - 0.4, 2) + std::pow(p[1] - 0.5, 2) < 0.09 ? 1.0 : 0.0;
  };
  const CubatureResult r = over_square(disk, 1e-4);
  EXPECT_LE(std::abs(r.total - 0.09 * kPi), r.total_error);
  const auto half = [](const Point2& p) { return p[0] < 1 / kPi ? 1.0 : 0.0; };
  const CubatureResult h = over_square(half, 1e-6);
  EXPECT_LE(std::abs(h.total - 1 / kPi), h.total_error);
}

TEST(Cubature, KeepsItsErrorEstimateWhereTheDensityGrowsWithoutBoundTowardsAnEdge) {
  // The silhouette of a sphere: ∫ over r < R of 1/√(R² − r²) = 2π R.
  const auto silhouette = [](const Point2& p) {
    const double gap = 0.09 - std::pow(p[0] - 0.4, 2) - std::pow(p[1] - 0.55, 2);
    return gap > 0 ? 1 / std::sqrt(gap) : 0.0;
  };
  const CubatureResult r = over_square(silhouette, 1e-5);
  EXPECT_LE(r.total_error, 1e-5);
  EXPECT_LE(std::abs(r.total - 2 * kPi * 0.3), r.total_error);
}

TEST(Cubature, SaysWhenTheIntegrandIsNotFinite) {
  EXPECT_FALSE(over_square([](const Point2& p) { return 1 / (p[0] - 0.5); }, 1e-6).finite);
}

SampleRecord at(const Vec3& x) {
  SampleRecord s;
  s.x = x;
  return s;
}

/// Density and sampler of a rectangle seen from the origin: its edges are curves on the chart.
SamplingPair rectangle(double x0, double width, double y0, double height) {
  SamplingPair pair;
  pair.domain = Domain::sphere();
  pair.sample = [=](const Uniforms& u) -> std::optional<SampleRecord> {
    const double x = x0 + width * u[0], y = y0 + height * u[1];
    const double d = std::sqrt(x * x + y * y + 1);
    return at({x / d, y / d, 1 / d});
  };
  pair.pdf = [=](const Vec3& w) {
    if (!(w[2] > 0)) return 0.0;
    const double s = (w[0] / w[2] - x0) / width, t = (w[1] / w[2] - y0) / height;
    return s >= 0 && s <= 1 && t >= 0 && t <= 1 ? 1 / (w[2] * w[2] * w[2] * width * height) : 0.0;
  };
  return pair;
}

TEST(BinIntegrals, AddUpToOneForASupportWithCurvedEdges) {
  for (const SamplingPair& pair : {rectangle(-0.3, 1, -0.2, 0.7), rectangle(2, 0.01, 3, 0.02),
                                   rectangle(-1e-3, 2e-3, -1e-3, 2e-3), rectangle(-9, 18, 1, 5)}) {
    const BinnedPair binned(pair, 4096, 2.5e-5, 1);
    EXPECT_LE(binned.expected().total_error, 5e-5);
    EXPECT_NEAR(binned.expected().total, 1, 5e-5);
  }
}

/// Density ∝ exp(k cosθ) around an axis, sampled by inversion.
SamplingPair lobe(double k, const Vec3& axis) {
  const Vec3 s = std::abs(axis[2]) < 0.9 ? Vec3{axis[1], -axis[0], 0} : Vec3{0, axis[2], -axis[1]};
  const double length = std::hypot(s[0], s[1], s[2]);
  const Vec3 a{s[0] / length, s[1] / length, s[2] / length};
  const Vec3 b{axis[1] * a[2] - axis[2] * a[1], axis[2] * a[0] - axis[0] * a[2],
               axis[0] * a[1] - axis[1] * a[0]};
  SamplingPair pair;
  pair.domain = Domain::sphere();
  pair.sample = [=](const Uniforms& u) -> std::optional<SampleRecord> {
    // 1 − cosθ, written so that nothing cancels for narrow lobes.
    const double h = -std::log1p(-u[0] * -std::expm1(-2 * k)) / k;
    const double radius = std::sqrt(h * (2 - h)), phi = 2 * kPi * u[1];
    Vec3 w;
    for (std::size_t i = 0; i < 3; ++i) {
      w[i] = axis[i] * (1 - h) + radius * (std::cos(phi) * a[i] + std::sin(phi) * b[i]);
    }
    return at(w);
  };
  pair.pdf = [=](const Vec3& w) {
    // 1 − cosθ = |w − axis|²/2 for unit vectors.
    const double h =
        (std::pow(w[0] - axis[0], 2) + std::pow(w[1] - axis[1], 2) + std::pow(w[2] - axis[2], 2)) /
        2;
    return k / (2 * kPi * -std::expm1(-2 * k)) * std::exp(-k * h);
  };
  return pair;
}

TEST(BinIntegrals, AddUpToOneForLobesFromWideToNarrow) {
  // k = 2/α²: 2e6 is about as narrow as GGX with α = 1e-3.
  for (const double k : {0.1, 10.0, 1e4, 2e6}) {
    for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}, Vec3{-0.28, 0.96, 0}}) {
      const SamplingPair pair = lobe(k, axis);
      const BinnedPair binned(pair, 4096, 2.5e-5, 1);
      EXPECT_LE(binned.expected().total_error, 5e-5) << k;
      EXPECT_NEAR(binned.expected().total, 1, 5e-5) << k;
    }
  }
}

TEST(BinIntegrals, GiveEachBinAboutTheSameMass) {
  const SamplingPair pair = lobe(2e6, {0.6, 0, 0.8});
  const BinnedPair binned(pair, 4096, 2.5e-5, 1);
  int far_off = 0;
  for (const double mass : binned.expected().value) {
    far_off += mass * 4096 < 0.2 || mass * 4096 > 5 ? 1 : 0;
  }
  EXPECT_LT(far_off, 41) << "more than 1 % of the bins";
}

/// A pair of which only the rejected set matters.
SamplingPair rejecting(std::function<bool(double, double)> rejects) {
  SamplingPair pair;
  pair.name = "rejecting";
  pair.domain = Domain::sphere();
  pair.sample = [rejects = std::move(rejects)](const Uniforms& u) -> std::optional<SampleRecord> {
    if (rejects(u[0], u[1])) return std::nullopt;
    return SampleRecord{{0, 0, 1}};
  };
  return pair;
}

/// What GGX rejects at 89.9°: a band at the end of the second number, and a tongue at one azimuth
/// that is thinner than the steps along a line.
TEST(RejectedShare, CountsATongueThinnerThanTheStepsOfTheLines) {
  const double width = 2e-3, base = 0.98, tilt = 0.05;
  const SamplingPair pair = rejecting([=](double first, double second) {
    const double along = (second - base) / (1 - base);
    const double middle = 0.6113 + tilt * (second - base);
    return second > 1 - 1e-4 || (along > 0 && std::abs(first - middle) < width / 2 * along);
  });
  // The tongue is a triangle; its last 1e-4 lies in the band.
  const double tongue = width * (1 - base) / 2 - width * 1e-4 * (1 - 1e-4 / (1 - base) / 2);
  const RejectedShare share = measure_rejected(pair, 1);
  EXPECT_TRUE(share.measured);
  EXPECT_NEAR(share.value, 1e-4 + tongue, 2e-6);
}

TEST(RejectedShare, IsExactForBandsAndNothing) {
  const auto value = [](const SamplingPair& pair) { return measure_rejected(pair, 1).value; };
  EXPECT_EQ(value(rejecting([](double, double) { return false; })), 0);
  EXPECT_NEAR(value(rejecting([](double, double) { return true; })), 1, 1e-12);
  EXPECT_NEAR(value(rejecting([](double first, double) { return first < 0.3; })), 0.3, 1e-12);
}

}  // namespace
}  // namespace plumbline::verify
