#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>

/// BSDFs made of others.
namespace plumbline::tests {
namespace {

using namespace renderer;

const Lambertian kGrey{{0.5f, 0.5f, 0.5f}};

TEST(BsdfSet, RefusesANestedOneThatDoesNotFollowItsChildren) {
  EXPECT_NO_THROW(BsdfSet({kGrey, TwoSided{0, 0}}));
  EXPECT_THROW(BsdfSet({kGrey, TwoSided{0, 1}}), std::invalid_argument) << "itself";
  EXPECT_THROW(BsdfSet({TwoSided{0, 0}}), std::invalid_argument) << "itself alone";
  EXPECT_THROW(BsdfSet({TwoSided{1, 1}, kGrey}), std::invalid_argument) << "a later one";
}

/// A blend in front, of two lobes, and one lobe behind.
TEST(TwoSidedLobes, ThatOnlyTheOtherSideHasAreNeverSampled) {
  const BsdfSet set({kGrey, GgxConductor{{0.3f, 0.3f}, ConductorFresnel()}, Mixture{0, 1, 0.25f},
                     TwoSided{2, 0}});
  const BsdfRef bsdf = set[3];
  ASSERT_EQ(bsdf.lobe_count(), 2u);
  const Vec3f front{0, 0, 1}, back{0, 0, -1}, slant{0.6f, 0, 0.8f};
  const Vec2f u{0.25f, 0.5f};
  for (const std::uint32_t lobe : {0u, 1u}) {
    EXPECT_GT(bsdf.lobe_probability(front, lobe), 0.0f);
    EXPECT_GT(bsdf.pdf_lobe(front, slant, lobe), 0.0f);
    EXPECT_TRUE(bsdf.sample_lobe(front, lobe, u));
  }
  EXPECT_GT(bsdf.lobe_probability(Vec3f{1, 0, 0}, 1), 0.0f) << "the horizon counts as the front";
  EXPECT_EQ(bsdf.lobe_probability(back, 0), 1.0f);
  EXPECT_GT(bsdf.pdf_lobe(back, -slant, 0), 0.0f);
  EXPECT_TRUE(bsdf.sample_lobe(back, 0, u));
  EXPECT_EQ(bsdf.lobe_probability(back, 1), 0.0f);
  EXPECT_EQ(bsdf.pdf_lobe(back, -slant, 1), 0.0f);
  EXPECT_FALSE(bsdf.sample_lobe(back, 1, u));
}

}  // namespace
}  // namespace plumbline::tests
