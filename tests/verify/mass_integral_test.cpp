#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/pair.h>

#include "pairs/binned_pair.h"
#include "pairs/mass_integral.h"
#include "pairs/rejected_share.h"

namespace plumbline::verify {
namespace {

ContractOptions seeded(const std::string& name) {
  ContractOptions options;
  options.seed = tests::check_seed(name);
  return options;
}

using std::numbers::pi;
// So many tests of one binary may miss the truth; of each less than once in 1e10.
constexpr double kLevel = 1e-10;

using Function = std::function<double(const Point2&)>;

MassIntegral over_square(const Function& f, double target, std::string_view name) {
  MassQuestion question;
  question.integrand = f;
  question.target = target;
  question.own = 0;
  question.seed = tests::check_seed(name);
  return integrate_mass(question, {Cell{}});
}

/// The integral lies where it says, and is known to about `target`.
void expect_known(const Function& f, double truth, double target, const char* name) {
  const MassIntegral r = over_square(f, target, name);
  EXPECT_TRUE(r.finite) << name;
  EXPECT_LE(std::abs(r.total - truth), r.error(kLevel) + 1e-14) << name;
  EXPECT_LE(r.error(1e-3), 2 * target) << name;
}

CellFit fit_of(const Function& f, const Box& box) {
  std::vector<Point2> points;
  CellFit::add_points(box, 2, points);
  std::vector<double> values;
  for (const Point2& p : points) values.push_back(f(p));
  return CellFit(box, 2, values);
}

TEST(MassIntegral, IsExactForTheSeventhDegree) {
  // ∫∫ x³y⁴ = 1/20, ∫∫ x⁷ = 1/8 over the unit square.
  const CellFit fit = fit_of(
      [](const Point2& p) { return std::pow(p[0], 3) * std::pow(p[1], 4) + std::pow(p[0], 7); },
      {});
  EXPECT_NEAR(fit.integral(), 1.0 / 20 + 1.0 / 8, 1e-14);
}

TEST(MassIntegral, FitsWhatIsCubicInEachCoordinate) {
  const auto f = [](const Point2& p) { return 2 + p[0] * p[0] * p[0] * p[1] - 3 * p[1] * p[1]; };
  const CellFit fit = fit_of(f, {{0.2, 0.5}, {0.4, 0.9}});
  EXPECT_NEAR(fit.at({0.21, 0.77}), f({0.21, 0.77}), 1e-14);
  EXPECT_NEAR(fit.at({0.4, 0.5}), f({0.4, 0.5}), 1e-14);
}

TEST(MassIntegral, KeepsItsErrorAlongLinesOfAnyDirection) {
  for (const double slope : {0.0, 1e-3, 0.3, 1.0, 17.0}) {
    // Below the line t = 1/π + slope (s − ½), clipped to the square: by a fine midpoint rule in s.
    const auto line = [=](double s) { return std::clamp(1 / pi + slope * (s - 0.5), 0.0, 1.0); };
    double truth = 0;
    constexpr int kSteps = 1 << 20;
    for (int i = 0; i < kSteps; ++i) truth += line((i + 0.5) / kSteps) / kSteps;
    expect_known([=](const Point2& p) { return p[1] < line(p[0]) ? 1.0 : 0.0; }, truth, 2e-5,
                 ("line of slope " + std::to_string(slope)).c_str());
  }
}

TEST(MassIntegral, KeepsItsErrorOnDisksPolesAndSilhouettes) {
  const auto r2 = [](const Point2& p) {
    return std::pow(p[0] - 0.4, 2) + std::pow(p[1] - 0.55, 2);
  };
  expect_known([&](const Point2& p) { return r2(p) < 0.09 ? 1.0 : 0.0; }, 0.09 * pi, 2e-5, "disk");
  // The silhouette of a sphere: ∫ over r < R of 1/√(R² − r²) = 2π R.
  expect_known([&](const Point2& p) { return r2(p) < 0.09 ? 1 / std::sqrt(0.09 - r2(p)) : 0.0; },
               2 * pi * 0.3, 0.5, "silhouette");
  // A pole as of a map without its sine: ∫ 1/√s = 2.
  expect_known([](const Point2& p) { return 1 / std::sqrt(p[0]); }, 2, 1e-4, "pole");
}

TEST(MassIntegral, IsUnbiasedOnAMapOfPixels) {
  // 37 × 23 pixels whose values are far apart, a quarter of them 0.
  const auto pixel = [](int i, int j) {
    return (i * 7 + j * 13) % 4 == 0 ? 0.0 : (i * j) % 11 + 0.5;
  };
  double truth = 0;
  for (int i = 0; i < 37; ++i) {
    for (int j = 0; j < 23; ++j) truth += pixel(i, j) / (37 * 23);
  }
  const auto f = [&](const Point2& p) {
    return pixel(static_cast<int>(p[0] * 37), static_cast<int>(p[1] * 23));
  };
  const MassIntegral r = over_square(f, 1e-5, "pixels");
  EXPECT_LE(std::abs(r.total - truth), r.error(kLevel));
  // 3 million evaluations find the edges of 851 pixels to 0.8 %, without lines that are stated.
  EXPECT_LE(r.error(1e-3), 1e-2 * truth);
}

/// A needle that no rule on the whole square sees. One that is larger than what is stated to be
/// unseen shows; and of a smaller one nothing is claimed.
TEST(MassIntegral, SeesANeedleAsLargeAsItStates) {
  const MassIntegral none = over_square([](const Point2&) { return 1.0; }, 1e-5, "no needle");
  EXPECT_NEAR(none.total, 1, 1e-14);
  const double side = std::sqrt(4 * none.unseen);
  const auto needle = [&](const Point2& p) {
    const bool inside = std::abs(p[0] - 0.7341) < side / 2 && std::abs(p[1] - 0.2117) < side / 2;
    return inside ? 1 + 0.5 / (side * side) : 1.0;
  };
  const MassIntegral r = over_square(needle, 1e-4, "needle");
  EXPECT_LE(std::abs(r.total - 1.5), r.error(kLevel));
  EXPECT_NEAR(r.total, 1.5, 0.01);
}

TEST(MassIntegral, SaysWhenTheIntegrandIsNotFinite) {
  EXPECT_FALSE(
      over_square([](const Point2& p) { return std::log(p[0] - 0.5); }, 1e-6, "log").finite);
}

/// The error at a level is missed no more often than it says, on a function whose fit is poor.
TEST(MassIntegral, MissesItsErrorNoMoreOftenThanItSays) {
  int missed = 0;
  constexpr int kRuns = 400;
  for (int i = 0; i < kRuns; ++i) {
    MassQuestion question;
    question.integrand = [](const Point2& p) { return p[0] + p[1] < 0.77 ? 1.0 : 0.0; };
    question.own = 0;
    question.spread = 256;
    question.max_evaluations = 2'000;
    question.seed = tests::check_seed("coverage " + std::to_string(i));
    const MassIntegral r = integrate_mass(question, {Cell{}});
    missed += std::abs(r.total - 0.77 * 0.77 / 2) > r.error(0.05) ? 1 : 0;
  }
  // 5 % of 400 are 20; 60 or more come once in 1e12.
  EXPECT_LT(missed, 60);
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
    const double radius = std::sqrt(h * (2 - h)), phi = 2 * pi * u[1];
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
    return k / (2 * pi * -std::expm1(-2 * k)) * std::exp(-k * h);
  };
  return pair;
}

MassIntegral bins_of(const SamplingPair& pair, const char* name) {
  ContractOptions options;
  options.seed = tests::check_seed(name);
  return BinnedPair(pair, options, mass_error(options)).expected();
}

TEST(BinIntegrals, AddUpToOneForASupportWithCurvedEdges) {
  for (const SamplingPair& pair : {rectangle(-0.3, 1, -0.2, 0.7), rectangle(2, 0.01, 3, 0.02),
                                   rectangle(-1e-3, 2e-3, -1e-3, 2e-3), rectangle(-9, 18, 1, 5)}) {
    const MassIntegral r = bins_of(pair, "rectangle");
    EXPECT_LE(r.error(1e-3), 5e-4);  // edges cost the strict promise where the support is wide
    EXPECT_LE(std::abs(r.total - 1), r.error(kLevel));
  }
}

TEST(BinIntegrals, AddUpToOneForLobesFromWideToNarrow) {
  // k = 2/α²: 2e6 is about as narrow as GGX with α = 1e-3.
  for (const double k : {0.1, 10.0, 1e4, 2e6}) {
    for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}, Vec3{-0.28, 0.96, 0}}) {
      const MassIntegral r = bins_of(lobe(k, axis), "lobe");
      EXPECT_LE(r.error(1e-3), 5e-5) << k;
      EXPECT_LE(std::abs(r.total - 1), r.error(kLevel)) << k;
    }
  }
}

TEST(BinIntegrals, GiveEachBinAboutTheSameMass) {
  int far_off = 0;
  for (const double mass : bins_of(lobe(2e6, {0.6, 0, 0.8}), "bins").value) {
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

RejectedShare rejected_of(const SamplingPair& pair, const ContractOptions& options) {
  return measure_rejected(pair, options, mass_error(options));
}

/// What GGX rejects at 89.9°: a band at the end of the second number, and a tongue at one azimuth
/// that is thinner than the steps along a line.
TEST(RejectedShare, KeepsItsErrorForATongueThinnerThanTheStepsOfTheLines) {
  const double width = 2e-3, base = 0.98, tilt = 0.05;
  const SamplingPair pair = rejecting([=](double first, double second) {
    const double along = (second - base) / (1 - base);
    const double middle = 0.6113 + tilt * (second - base);
    return second > 1 - 1e-4 || (along > 0 && std::abs(first - middle) < width / 2 * along);
  });
  // The tongue is a triangle; its last 1e-4 lies in the band.
  const double tongue = width * (1 - base) / 2 - width * 1e-4 * (1 - 1e-4 / (1 - base) / 2);
  const RejectedShare share = rejected_of(pair, seeded("tongue"));
  EXPECT_LE(std::abs(share.value - (1e-4 + tongue)), share.error(kLevel));
  EXPECT_LE(share.error(1e-3), 5e-4);
}

TEST(RejectedShare, IsKnownForBandsCornersAndNothing) {
  const auto expect = [](const char* name, double truth, double known_to,
                         std::function<bool(double, double)> rejects) {
    const RejectedShare share = rejected_of(rejecting(std::move(rejects)), seeded(name));
    EXPECT_LE(std::abs(share.value - truth), share.error(kLevel) + 1e-12) << name;
    EXPECT_LE(share.error(1e-3), known_to) << name;
  };
  expect("nothing", 0, 3e-5, [](double, double) { return false; });
  expect("all", 1, 1e-12, [](double, double) { return true; });
  expect("band", 0.3, 1e-9, [](double first, double) { return first < 0.3; });
  expect("across", 0.3, 3e-5, [](double, double second) { return second < 0.3; });
  expect("corner", 0.02, 3e-5, [](double a, double b) { return a + b > 1.8; });
}

TEST(RejectedShare, OfPartsIsKnownAsWellAsEachOfThem) {
  const RejectedShare nothing{0, 0, 0, 1e5, 1e-5}, known{0.3, 1e-12, 1e-9, 1e6, 0};
  RejectedShare sum = nothing.scaled(0.75);
  EXPECT_NEAR(sum.error(1e-3), 0.75 * std::log(1e3) / 1e5, 1e-12);
  sum.add(known.scaled(0.25));
  EXPECT_DOUBLE_EQ(sum.value, 0.075);
  // Each at half of the level.
  EXPECT_NEAR(sum.error(1e-3), 0.75 * std::log(2e3) / 1e5 + known.scaled(0.25).error(5e-4), 1e-12);
  // Of two that show nothing the less well known one bounds both.
  sum = nothing.scaled(0.5);
  sum.add({0, 0, 0, 1e4, 1e-4 * 0.5});
  EXPECT_NEAR(sum.error(1e-3), 0.5 * std::log(1e3) / 1e4, 1e-12);
}

TEST(RejectedShare, OfThreeNumbersAndOfAGeneratorReachesThePromise) {
  SamplingPair three = rejecting([](double, double) { return false; });
  three.numbers = 3;
  three.sample = [](const Uniforms& u) -> std::optional<SampleRecord> {
    if (u[2] < 0.4 && u[0] + u[1] > 1.5) return std::nullopt;
    return SampleRecord{{0, 0, 1}};
  };
  const RejectedShare share = rejected_of(three, seeded("three numbers"));
  EXPECT_LE(std::abs(share.value - 0.4 * 0.125), share.error(kLevel));
  EXPECT_LE(share.error(1e-3), 5e-4);
  SamplingPair generator;
  generator.draw = [](Random& random) -> std::optional<SampleRecord> {
    if (random.uniform() < 0.125) return std::nullopt;
    return SampleRecord{{0, 0, 1}};
  };
  const RejectedShare drawn = rejected_of(generator, seeded("generator"));
  EXPECT_LE(std::abs(drawn.value - 0.125), drawn.error(kLevel));
  EXPECT_LE(drawn.error(1e-3), 1e-3);
}

}  // namespace
}  // namespace plumbline::verify
