#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <plumbline/analytic/bsdf_albedo.h>
#include <plumbline/analytic/fresnel.h>
#include <plumbline/analytic/furnace.h>
#include <plumbline/analytic/known_scene.h>

namespace plumbline::analytic {
namespace {

TEST(ClosedFurnace, UnlimitedDepthSolvesTheBalance) {
  for (const double albedo : {0.0, 0.25, 0.5, 0.9, 0.999}) {
    const double radiance = closed_furnace_radiance(albedo, 2, -1);
    EXPECT_NEAR(radiance, 2 + albedo * radiance, 1e-12 * radiance) << albedo;
  }
}

TEST(ClosedFurnace, DepthIsThePartialSum) {
  EXPECT_EQ(closed_furnace_radiance(0.5, 0.5, 0), 0);
  EXPECT_EQ(closed_furnace_radiance(0.5, 0.5, 1), 0.5);
  EXPECT_EQ(closed_furnace_radiance(0.5, 0.5, 2), 0.75);
  EXPECT_EQ(closed_furnace_radiance(0.5, 0.5, 5), 0.96875);
  EXPECT_EQ(closed_furnace_radiance(0.5, 0.5, -1), 1);
  EXPECT_EQ(closed_furnace_radiance(1, 0.5, 7), 3.5);
}

TEST(ClosedFurnace, PartialSumsAgreeWithTheGeometricFormula) {
  for (const double albedo : {0.1, 0.5, 0.9}) {
    for (const int depth : {1, 2, 3, 10, 100}) {
      const double expected = (1 - std::pow(albedo, depth)) / (1 - albedo);
      EXPECT_NEAR(closed_furnace_radiance(albedo, 1, depth), expected, 1e-13 * expected);
    }
  }
}

TEST(ClosedFurnace, DeepPathsReachTheLimit) {
  EXPECT_NEAR(closed_furnace_radiance(0.9, 1, 1000), closed_furnace_radiance(0.9, 1, -1), 1e-12);
}

TEST(ClosedFurnace, SumsOfBillionsOfTermsAreExactWithoutAddingThem) {
  constexpr int kMost = std::numeric_limits<int>::max();
  EXPECT_EQ(closed_furnace_radiance(1, 0.5, kMost), 0.5 * kMost);
  EXPECT_EQ(closed_furnace_radiance(0, 0.5, kMost), 0.5);
  EXPECT_EQ(closed_furnace_radiance(0.5, 0.5, kMost), 1);
  // Where a sum of 1001 terms begins to be another formula it is the sum of 1000 and one more.
  for (const double albedo : {0.25, 0.999, 1 - 1e-9, 1 - 1e-15, 1.0}) {
    const double sum = closed_furnace_radiance(albedo, 1, 1000) + std::pow(albedo, 1000);
    EXPECT_NEAR(closed_furnace_radiance(albedo, 1, 1001), sum, 1e-12 * sum) << albedo;
  }
}

TEST(ClosedFurnace, RefusesWhatHasNoAnswer) {
  EXPECT_THROW(closed_furnace_radiance(1, 1, -1), std::invalid_argument);
  EXPECT_THROW(closed_furnace_radiance(1.1, 1, 3), std::invalid_argument);
  EXPECT_THROW(closed_furnace_radiance(-0.1, 1, 3), std::invalid_argument);
  EXPECT_THROW(closed_furnace_radiance(std::nan(""), 1, 3), std::invalid_argument);
  EXPECT_THROW(closed_furnace_radiance(0.5, -1, 3), std::invalid_argument);
  EXPECT_THROW(closed_furnace_radiance(0.5, 1, -2), std::invalid_argument);
}

TEST(CubeFurnace, SecondMomentOfAreaSamplingGrowsLikeOneOverDistanceToTheEdgeSquared) {
  // ∫ G² over the adjacent face, for a point at distance h from the middle of an edge of length 2.
  // As h falls, h² times it tends to ∫∫ z²/(1 + z² + t²)⁴ dz dt over the half plane = π/24, so the
  // mean over any patch that reaches the edge, ∫ dh/h², diverges.
  using boost::math::quadrature::gauss_kronrod;
  for (const double h : {1e-1, 1e-2, 1e-3}) {
    // In units of h, on a face that reaches 2/h up and 1/h to either side.
    const auto row = [&](double z) {
      return 2 * gauss_kronrod<double, 31>::integrate(
                     [&](double t) { return z * z * std::pow(1 + z * z + t * t, -4); }, 0.0, 1 / h,
                     20, 1e-10);
    };
    const double second_moment_h2 =
        gauss_kronrod<double, 31>::integrate(row, 0.0, 2 / h, 20, 1e-10);
    EXPECT_NEAR(second_moment_h2, std::numbers::pi / 24, 2 * std::pow(h, 4)) << h;
  }
}

TEST(OpenFurnace, ReflectsTheEnvironmentOnceDirectLightCounts) {
  EXPECT_EQ(open_furnace_radiance(0.75, 2, 0), 0);
  EXPECT_EQ(open_furnace_radiance(0.75, 2, 1), 0);
  EXPECT_EQ(open_furnace_radiance(0.75, 2, 2), 1.5);
  EXPECT_EQ(open_furnace_radiance(0.75, 2, -1), 1.5);
}

TEST(OpenFurnace, ImageShowsSphereAndBackground) {
  const auto oracle = make_oracle(known_scene("furnace_open"));
  EXPECT_DOUBLE_EQ(oracle->pixel_mean(0, 0).value.g, 1);
  // The camera aims right of and above the sphere's centre, which projects left of and below the
  // image's.
  EXPECT_NEAR(oracle->pixel_mean(50, 55).value.g, 0.75, 1e-12);
  EXPECT_NEAR(oracle->pixel_mean(25, 65).value.g, 0.75, 1e-12);
  EXPECT_DOUBLE_EQ(oracle->pixel_mean(102, 30).value.g, 1);
}

TEST(OpenFurnace, PixelsSumToTheImageMean) {
  const auto oracle = make_oracle(known_scene("furnace_open"));
  double sum = 0;
  for (const Colour& value : oracle->image()) sum += value.g;
  EXPECT_NEAR(sum / (128.0 * 96.0), oracle->image_mean().value.g, 1e-13);
}

TEST(OpenFurnace, DepthOneShowsTheEnvironmentAlone) {
  const auto oracle = make_oracle(known_scene("furnace_open"), {}, std::nullopt, 1);
  EXPECT_DOUBLE_EQ(oracle->pixel_mean(0, 0).value.g, 1);
  EXPECT_NEAR(oracle->pixel_mean(50, 55).value.g, 0, 1e-12);
}

TEST(PlaneFurnace, ShowsTheAlbedoAtTheAngleOfEachPixel) {
  const KnownScene& scene = known_scene("furnace_metal");
  const FilmSize fine{64000, 48000};  // pixels so small that the angle does not change in one
  const Camera camera = make_camera(scene.view, fine);
  const auto oracle = make_oracle(scene, {}, fine);
  for (const auto& [x, y] : {std::pair{0, 0}, {32000, 24000}, {60000, 47000}}) {
    const double cosine = -normalize(camera.direction(x + 0.5, y + 0.5)).z;
    const double sine = std::sqrt(1 - cosine * cosine);
    const double albedo = ggx_reflection_albedo({0.5, 0.5}, {sine, 0, cosine}, [](double c) {
      return interface_reflectance(c, 1, {0.2, 3.9});
    });
    const Average seen = oracle->pixel_mean(x, y);
    EXPECT_NEAR(seen.value.g, albedo, 1e-5 * albedo);
    EXPECT_LE(seen.error.g, 1e-5 * albedo);
  }
}

TEST(PlaneFurnace, MirrorAndBlendAreElementary) {
  EXPECT_NEAR(make_oracle(known_scene("furnace_blend"))->image_mean().value.g, 0.7, 1e-12);
  const double mirror = make_oracle(known_scene("furnace_mirror"))->image_mean().value.g;
  EXPECT_GT(mirror, interface_reflectance(1, 1, {0.2, 3.9}) * 0.99);
  EXPECT_LT(mirror, 1);
  EXPECT_EQ(make_oracle(known_scene("furnace_phong"), {}, std::nullopt, 1)->image_mean().value.g,
            0);
}

TEST(GlassInside, IsEtaSquaredAndOnlyWhereNothingIsTrapped) {
  const KnownScene& scene = known_scene("glass_inside");
  EXPECT_DOUBLE_EQ(make_oracle(scene)->image_mean().value.g, 2.25);
  // |eye| = 0.374: from eta = 2.68 on some directions from it are trapped.
  EXPECT_NO_THROW(make_oracle(scene, {{"eta", 2.6}}));
  EXPECT_THROW(make_oracle(scene, {{"eta", 2.7}}), std::invalid_argument);
  EXPECT_THROW(make_oracle(scene, {}, std::nullopt, 8), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::analytic
