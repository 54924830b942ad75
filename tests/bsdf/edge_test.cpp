#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <variant>

#include <plumbline/verify/detail/random.h>
#include "examples.h"
#include "hard_points.h"

/// Where renderers show NaNs and dark halos: next to the horizon, at normal incidence, at the ends
/// of the random numbers. In float, as rendered.
namespace plumbline::tests {
namespace {

using namespace renderer;

constexpr float kOneMinusUlp = 1 - 0x1p-24f;
constexpr std::array kEnds{0.0f, 0x1p-24f, 0.5f, kOneMinusUlp};

bool is_sane(const Rgbf& c) {
  for (const float x : {c.r, c.g, c.b}) {
    if (!(std::isfinite(x) && x >= 0)) return false;
  }
  return true;
}

template <class B>
class Edge : public testing::Test {};

TYPED_TEST_SUITE(Edge, BsdfTypes, );

TYPED_TEST(Edge, NothingIsNonFiniteAndAtomsReportNoDensity) {
  for (const Example& example : examples_of<TypeParam>()) {
    for (const double cosine : {1.0, 1e-12, std::cos(89.99 * std::acos(-1.0) / 180)}) {
      for (const double side : {1.0, -1.0}) {
        const Vec3f wo = direction(side * cosine, 0.3);
        for (const float x : kEnds) {
          for (const float y : kEnds) {
            const auto s = example.bsdf.sample(wo, Vec2f{x, y});
            if (!s) continue;
            const std::string place = example.name + " u " + std::to_string(x) + ' ' +
                                      std::to_string(y) + " cosθo " + std::to_string(wo.z);
            EXPECT_TRUE(is_sane(s->weight)) << place;
            EXPECT_TRUE(std::isfinite(s->pdf_w)) << place;
            EXPECT_NEAR(length(s->wi), 1, 1e-5f) << place;
            EXPECT_TRUE(s->is_atom() ? s->pdf_w == 0 && s->mass <= 1 : s->pdf_w > 0) << place;
            EXPECT_TRUE(is_sane(example.bsdf.eval(wo, s->wi))) << place;
            EXPECT_TRUE(std::isfinite(example.bsdf.pdf(wo, s->wi))) << place;
          }
        }
      }
    }
  }
}

TYPED_TEST(Edge, SampledDirectionsAreOfUnitLengthWhereTheVisibleNormalCancels) {
  // At the limb of the visible normals, u.y → 1, the normal is the difference of two vectors that
  // are opposite where wo lies along an axis and u.x is 0 or ½: what rounding leaves of it points
  // anywhere, and is reflected and refracted at all the same.
  constexpr double kRoundings = 64;
  const auto check = [&]<class T>(const Example& example, double epsilon, T /*scalar*/) {
    for (const double degrees : {60.0, 80.0, 89.9}) {
      for (const double azimuth : {0.0, 1e-16, -1e-12, 1e-8, std::acos(-1.0), std::acos(0.0)}) {
        for (const double side : {1.0, -1.0}) {
          const double theta = degrees * std::acos(-1.0) / 180;
          const Vec3<T> wo{T(std::sin(theta) * std::cos(azimuth)),
                           T(std::sin(theta) * std::sin(azimuth)), T(side * std::cos(theta))};
          for (std::uint32_t lobe = 0; lobe < example.bsdf.lobe_count(); ++lobe) {
            for (const double x : {0.0, 0.25, 0.5, 1 - 2 * epsilon}) {
              for (const double ulps : {1.0, 2.0, 3.0, 8.0}) {
                const Vec2<T> u{T(x), T(1 - 2 * ulps * epsilon)};
                const auto s = example.bsdf.sample_lobe(wo, lobe, u);
                if (!s) continue;
                const double length_of_wi = length(vec_cast<double>(s->wi));
                EXPECT_NEAR(length_of_wi, 1, kRoundings * epsilon)
                    << example.name << ", " << degrees << "°, azimuth " << azimuth << ", side "
                    << side << ", lobe " << lobe << ", u " << x << ", " << ulps;
              }
            }
          }
        }
      }
    }
  };
  for (const Example& example : examples_of<TypeParam>()) {
    check(example, 0x1p-53, double{});
    check(example, 0x1p-24, float{});
  }
}

TYPED_TEST(Edge, WhatIsAllAtomsHasNoDensityAnywhere) {
  verify::Random random(1);
  for (const Example& example : examples_of<TypeParam>()) {
    if (example.bsdf.parts().density) continue;
    for (const Vec3f& wo : hard_outgoing(random)) {
      for (const Vec3f& wi : hard_incoming(example.bsdf, wo, 16, random)) {
        EXPECT_EQ(example.bsdf.pdf(wo, wi), 0) << example.name;
        EXPECT_TRUE(is_black(example.bsdf.eval(wo, wi))) << example.name;
      }
    }
  }
}

TYPED_TEST(Edge, EvaluateIsEvalAndPdf) {
  verify::Random random(3);
  for (const Example& example : examples_of<TypeParam>()) {
    for (const Vec3f& wo : hard_outgoing(random)) {
      for (const Vec3f& wi : hard_incoming(example.bsdf, wo, 16, random)) {
        const BsdfValue<float> both = example.bsdf.evaluate(wo, wi);
        EXPECT_EQ(both.f, example.bsdf.eval(wo, wi)) << example.name;
        EXPECT_EQ(both.pdf_w, example.bsdf.pdf(wo, wi)) << example.name;
      }
    }
  }
}

TEST(DarkHalo, MetalWithoutLossStaysBrightToTheHorizon) {
  // Single scattering keeps at least half of the power at any angle for α ≤ 0.1.
  const GgxConductor metal{{0.1f, 0.1f}, {}};
  verify::Random random(2);
  for (const double degrees : {85.0, 89.0, 89.9, 89.99}) {
    const Vec3f wo = direction(std::cos(degrees * std::acos(-1.0) / 180), 0.3);
    double sum = 0;
    constexpr int kSamples = 20'000;
    for (int i = 0; i < kSamples; ++i) {
      const float x = random.uniform_float();
      const auto s = metal.sample(wo, Vec2f{x, random.uniform_float()});
      if (s) sum += static_cast<double>(s->weight.g) / kSamples;
    }
    EXPECT_GT(sum, 0.5) << degrees;
  }
}

TEST(TwoSided, BehindItIsTheFrontMirroredAtTheSurface) {
  const BsdfSet set({GgxConductor{{0.1f, 0.3f}, copper()}, TwoSided{0, 0}});
  const BsdfRef metal(set, 0), both(set, 1);
  const auto mirrored = [](const Vec3f& w) { return Vec3f{w.x, w.y, -w.z}; };
  verify::Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const auto anywhere = [&random] {
      const double cosine = random.uniform();
      return direction(cosine, 6.28 * random.uniform());
    };
    const Vec3f wo = anywhere(), wi = anywhere();
    EXPECT_EQ(both.eval(mirrored(wo), mirrored(wi)), metal.eval(wo, wi));
    const Vec2f u{random.uniform_float(), 0.3f};
    const auto front = metal.sample(wo, u), behind = both.sample(mirrored(wo), u);
    ASSERT_EQ(front.has_value(), behind.has_value());
    if (front) {
      EXPECT_EQ(length(mirrored(behind->wi) - front->wi), 0);
    }
  }
}

TEST(SmoothDielectric, OfIndexOneIsInvisible) {
  const SmoothDielectric air{{1}};
  for (const double cosine : {1.0, 0.5, 0.01, -0.01, -1.0}) {
    const Vec3f wo = direction(cosine, 0.3);
    for (const float u : kEnds) {
      const auto s = air.sample(wo, Vec2f{u, 0.5f});
      ASSERT_TRUE(s);
      EXPECT_EQ(s->weight, (Rgbf{1, 1, 1}));
      EXPECT_EQ(s->mass, 1);
      EXPECT_LT(length(s->wi + wo), 1e-6f);
    }
  }
}

TEST(SmoothDielectric, TotalReflectionLosesNothing) {
  const SmoothDielectric glass{{1.5f}};
  const Vec3f wo = direction(-0.5, 0.3);  // beyond the critical angle, |cosθ| = 0.745
  for (const float u : kEnds) {
    const auto s = glass.sample(wo, Vec2f{u, 0.5f});
    ASSERT_TRUE(s);
    EXPECT_EQ(s->weight, (Rgbf{1, 1, 1}));
    EXPECT_EQ(s->mass, 1);
    EXPECT_LT(s->wi.z, 0);
  }
}

TEST(SmoothDielectric, RadianceScalesByTheSquareOfTheIndices) {
  // Into glass radiance grows by η², out of it it shrinks by as much: so weights hold 1/η² and η²
  // for light that is followed backwards.
  const SmoothDielectric glass{{1.5f}};
  const auto in = glass.sample_lobe(Vec3f{0, 0, 1}, 1, Vec2f{});
  const auto out = glass.sample_lobe(Vec3f{0, 0, -1}, 1, Vec2f{});
  ASSERT_TRUE(in && out);
  EXPECT_FLOAT_EQ(in->weight.g, 0.96f / 2.25f);
  EXPECT_FLOAT_EQ(out->weight.g, 0.96f * 2.25f);
}

}  // namespace
}  // namespace plumbline::tests
