#include <plumbline/renderer/assembly/direct.h>

#include <gtest/gtest.h>

#include <cmath>

#include <plumbline/renderer/assembly/description.h>
#include "scenes.h"

/// One sample of direct light, in a closed sphere that emits 0.5 and reflects half: whatever is
/// drawn, the value is f cosθ L/pdf of it.
namespace plumbline::tests {
namespace {

using namespace renderer;

const Vec2f kDraw{0.3f, 0.6f};

struct Drawn {
  DirectSample sample;
  PathCounters counters;
};

Drawn draw(std::size_t technique) {
  const Scene scene = make_scene(closed_sphere(1, 1));
  Drawn drawn;
  drawn.sample =
      sample_direct_light(scene, {{0, 0, 0}, {0, 0, 1}}, technique, kDraw, drawn.counters);
  return drawn;
}

TEST(DirectSample, HoldsTheEmissionOfWhatTheCameraSees) {
  for (const std::size_t technique : {kBsdfTechnique, kLightTechnique}) {
    const Drawn drawn = draw(technique);
    EXPECT_EQ(drawn.sample.emission.r, 0.5f);
    EXPECT_EQ(drawn.sample.emission.g, 0.5f);
    EXPECT_EQ(drawn.sample.emission.b, 0.5f);
  }
}

TEST(DirectSample, OfTheBsdfIsAlbedoTimesRadiance) {
  const Drawn drawn = draw(kBsdfTechnique);
  EXPECT_NEAR(drawn.sample.value.g, 0.25f, 1e-6f);  // f cosθ/pdf = albedo
  // The cosine of both directions is pdf π; a sphere's area density seen from a point of it:
  // 1/(4π r²) d²/cosθ with d = 2 r cosθ.
  EXPECT_NEAR(drawn.sample.other_pdf, drawn.sample.pdf, 1e-5f);
  EXPECT_EQ(drawn.counters.camera_rays, 1u);
  EXPECT_EQ(drawn.counters.bounce_rays, 1u);
  EXPECT_EQ(drawn.counters.shadow_rays, 0u);
}

TEST(DirectSample, OfTheLightIsTheIntegrandOverItsDensity) {
  const Drawn drawn = draw(kLightTechnique);
  // f cosθ L/pdf = 0.5 · 0.5 · (cosθ/π)/pdf, and cosθ/π is the density of the BSDF.
  EXPECT_NEAR(drawn.sample.value.g, 0.25f * drawn.sample.other_pdf / drawn.sample.pdf, 1e-6f);
  EXPECT_EQ(drawn.counters.camera_rays, 1u);
  EXPECT_EQ(drawn.counters.bounce_rays, 0u);
  EXPECT_EQ(drawn.counters.shadow_rays, 1u);
}

TEST(DirectSample, OfARayThatEscapesIsTheSkyAlone) {
  SceneDescription sky = empty_scene(1, 1);
  sky.environment = Rgbd{1, 2, 3};
  PathCounters counters;
  const DirectSample sample = sample_direct_light(make_scene(sky), {{0, 0, 0}, {0, 0, 1}},
                                                  kLightTechnique, kDraw, counters);
  EXPECT_EQ(sample.emission.b, 3.0f);
  EXPECT_EQ(sample.value.r, 0.0f);
  EXPECT_EQ(counters.camera_rays, 1u);
}

}  // namespace
}  // namespace plumbline::tests
