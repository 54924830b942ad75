#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <plumbline/renderer/assembly/names.h>
#include "both_backends.h"
#include "scenes.h"

/// Two backends, one image: what the batched one answers is held against the plain loop.
namespace plumbline::tests {
namespace {

using namespace renderer;

RenderOptions options_of(const SceneDescription& scene, Strategy strategy, SamplerType sampler) {
  RenderOptions options;
  options.path.strategy = strategy;
  options.path.max_depth = scene.integrator.max_depth < 0 ? 12 : scene.integrator.max_depth;
  options.path.rr_depth = scene.integrator.rr_depth;
  options.samples_per_pixel = kSmallSamples;
  options.sampler = sampler;
  return options;
}

/// Relative to the scalar one, plus a thousandth.
void expect_equal_to_rounding(const Pair& pair, double tolerance) {
  const auto& a = pair.scalar.film.pixels();
  const auto& b = pair.batched.film.pixels();
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_LE(std::abs(a[i].mean.g - b[i].mean.g), tolerance * (std::abs(a[i].mean.g) + 1e-3))
        << "pixel " << i;
  }
}

template <class Check>
void for_each_way(const std::string& file, Accelerator accelerator, const Check& check) {
  SceneDescription description = small(file);
  description.accelerator = accelerator;
  const Scene scene = make_scene(description);
  for (const Strategy strategy : {Strategy::bsdf, Strategy::light, Strategy::mis}) {
    for (const SamplerType sampler : kSamplers) {
      SCOPED_TRACE(file + ", " + std::string(name(strategy)) + ", " + std::string(name(sampler)) +
                   ", " + std::string(name(accelerator)));
      check(render_both(scene, options_of(description, strategy, sampler)));
    }
  }
}

TEST(Backends, GiveTheSameBitsOnFlatSurfaces) {
  // Diffuse, metal, glass, clear coat, mixtures and Phong; rectangles, triangles, a point and the
  // sky; one light and a thousand.
  for (const char* file :
       {"bench/scenes/cornell", "analytic/scenes/lights_1000", "analytic/scenes/furnace_cube",
        "analytic/scenes/triangle_light", "analytic/scenes/point_glossy",
        "analytic/scenes/sidewalk", "analytic/scenes/phong_polygon", "analytic/scenes/thin_gap"}) {
    for (const Accelerator accelerator : {Accelerator::automatic, Accelerator::embree}) {
      for_each_way(file, accelerator, expect_same_bits);
    }
  }
}

TEST(Backends, GiveTheSameBitsOnAMeshOfManyTriangles) {
  // More than small scenes have, which are traced by another kind of packet.
  constexpr std::uint32_t kSide = 64;
  SceneDescription description = empty_scene(kSmallWidth, kSmallHeight);
  description.camera.origin = {0, 0, -2};
  description.environment = Rgbd{1, 1, 1};
  MeshShape hills;
  for (std::uint32_t j = 0; j <= kSide; ++j) {
    for (std::uint32_t i = 0; i <= kSide; ++i) {
      const double x = 4.0 * i / kSide - 2, y = 4.0 * j / kSide - 2;
      hills.vertices.push_back({x, y, 0.2 * std::sin(9 * x) * std::sin(7 * y)});
    }
  }
  for (std::uint32_t j = 0; j < kSide; ++j) {
    for (std::uint32_t i = 0; i < kSide; ++i) {
      const std::uint32_t a = j * (kSide + 1) + i, b = a + kSide + 1;
      hills.triangles.push_back({a, b, a + 1});
      hills.triangles.push_back({a + 1, b, b + 1});
    }
  }
  description.shapes.push_back({hills, 0, std::nullopt});
  description.integrator.max_depth = 5;
  const Scene scene = make_scene(description);
  const Pair pair =
      render_both(scene, options_of(description, Strategy::mis, SamplerType::independent));
  EXPECT_GT(pair.scalar.counters.bounce_rays, 1000u);
  EXPECT_EQ(differing_pixels(pair), 0u);
}

TEST(Backends, GiveTheSameBitsOfASkyAlone) {
  SceneDescription description = empty_scene(kSmallWidth, kSmallHeight);
  description.bsdfs = make_bsdfs({});
  description.environment = Rgbd{1, 2, 3};
  const Scene scene = make_scene(description);
  const Pair pair = render_both(scene, options_of(description, Strategy::mis, SamplerType::sobol));
  EXPECT_EQ(differing_pixels(pair), 0u);
  EXPECT_EQ(pair.batched.film.at(3, 5).mean.b, 3);
  EXPECT_EQ(pair.batched.counters.shadow_rays, 0u);
}

TEST(Backends, AgreeToRoundingOnSpheresAndToTheBitByBruteForce) {
  // Embree rounds the distance to a sphere differently for one ray and for sixteen: positions
  // differ by 2^-24 of the sphere's size and of the distance. Paths between spheres multiply it by
  // distance over radius at every bounce; of 16 bounces or fewer in these scenes 1e-4 is left.
  for (const char* file :
       {"analytic/scenes/furnace_rough_glass", "analytic/scenes/furnace_blend",
        "analytic/scenes/furnace_coat", "analytic/scenes/furnace_two_sided",
        "analytic/scenes/glass_film", "analytic/scenes/integrating_sphere", "bench/scenes/veach"}) {
    for_each_way(file, Accelerator::embree,
                 [](const Pair& pair) { expect_equal_to_rounding(pair, 1e-4); });
    for_each_way(file, Accelerator::brute_force, expect_same_bits);
  }
}

TEST(Backends, OtherStrategiesAreLeftToThePlainLoop) {
  const SceneDescription description = small("bench/scenes/cornell");
  const Scene scene = make_scene(description);
  for (const Strategy strategy : {Strategy::uniform, Strategy::one_sample, Strategy::average}) {
    const RenderOptions options = options_of(description, strategy, SamplerType::independent);
    EXPECT_EQ(differing_pixels(render_both(scene, options)), 0u) << name(strategy);
  }
  RenderOptions counts = options_of(description, Strategy::mis, SamplerType::independent);
  counts.path.light_samples = 3;
  EXPECT_EQ(differing_pixels(render_both(scene, counts)), 0u);
}

TEST(Backends, ACounterOfDifferencesSeesOtherRandomNumbers) {
  const SceneDescription description = small("bench/scenes/cornell");
  const Scene scene = make_scene(description);
  RenderOptions options = options_of(description, Strategy::mis, SamplerType::independent);
  Pair pair = render_both(scene, options);
  options.seed = 1;
  pair.batched = render(scene, options);
  EXPECT_GT(differing_pixels(pair), pair.scalar.film.pixels().size() / 2);
}

/// As many rays may meet the diagonal of a rectangle so closely that Embree takes the one half for
/// one ray and the other for sixteen: the same point, rounded otherwise.
///
/// On which side of an edge a ray passes is told by a sum of products that each kernel rounds, to
/// about 2⁻²⁴ of the rectangle's size: they may disagree on a band of that width on both sides of
/// the diagonal, √2 long, which is 2√2·2⁻²⁴ < 2⁻²² of the rectangle. Rare and independent events:
/// of a Poisson distribution with that mean, the number that is exceeded less than once in 1e6,
/// by Chernoff's bound e^−m (e m/k)^k.
std::size_t most_on_diagonals(const PathCounters& counters) {
  const double mean = static_cast<double>(counters.camera_rays + counters.bounce_rays) * 0x1p-22;
  double k = mean;
  do {
    ++k;
  } while (k - mean + k * std::log(mean / k) > std::log(1e-6));
  return static_cast<std::size_t>(k);
}

TEST(Backends, EveryNumberOfPathsFillsItsBatches) {
  // One path, one short of a batch, and passes that leave the last batch part full.
  const SceneDescription description = small("bench/scenes/cornell");
  const Scene scene = make_scene(description);
  for (const std::uint32_t samples : {1u, 7u, 333u}) {
    RenderOptions options = options_of(description, Strategy::mis, SamplerType::sobol);
    options.samples_per_pixel = samples;
    options.replicates = 3;
    const Pair pair = render_both(scene, options);
    EXPECT_LE(differing_pixels(pair), most_on_diagonals(pair.scalar.counters)) << samples;
    expect_equal_to_rounding(pair, 1e-7);
  }
}

TEST(Backends, ARayDoesNotMeetThePlaneThatItStartsOn) {
  // The middle of the scene is the camera's place exactly, on a plane that emits nothing; what
  // emits is ahead of it.
  SceneDescription description = empty_scene(kSmallWidth, kSmallHeight);
  for (const double z : {-1.0, 0.0, 1.0}) {
    description.shapes.push_back(
        {RectangleShape{{-4, -4, z}, {8, 0, 0}, {0, 8, 0}, z > 0}, 0, Rgbd{z > 0 ? 1.0 : 0, 0, 0}});
  }
  RenderOptions options;
  options.path.max_depth = 1;
  const Pair pair = render_both(make_scene(description), options);
  expect_same_bits(pair);
  EXPECT_EQ(pair.batched.film.mean().r, 1.0);
}

TEST(Backends, AreFoundByName) {
  for (const Backend backend : kBackends) EXPECT_EQ(from_name(kBackends, name(backend)), backend);
  EXPECT_EQ(from_name(kBackends, "gpu"), std::nullopt);
}

}  // namespace
}  // namespace plumbline::tests
