#include <gtest/gtest.h>
#include <plumbline_tests/directions.h>
#include <plumbline_tests/support.h>

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
    for (const double cosine : {1.0, 1e-12, std::cos(radians(89.99))}) {
      for (const bool front : {true, false}) {
        const Vec3f wo = direction(front ? cosine : -cosine, 0.3);
        const Gives gives = example.gives.of(front);
        int samples = 0;
        for (const float x : kEnds) {
          for (const float y : kEnds) {
            const auto s = example.bsdf.sample(wo, Vec2f{x, y});
            if (!s) continue;
            ++samples;
            const std::string place = example.name + " u " + std::to_string(x) + ' ' +
                                      std::to_string(y) + " cosθo " + std::to_string(wo.z);
            EXPECT_TRUE(is_sane(s->weight)) << place;
            EXPECT_TRUE(std::isfinite(s->pdf_w)) << place;
            EXPECT_NEAR(length(s->wi), 1, 1e-5f) << place;
            EXPECT_TRUE(s->is_atom() ? s->pdf_w == 0 && s->mass <= 1 : s->pdf_w > 0) << place;
            EXPECT_TRUE(s->is_atom() ? has_atoms(gives) : has_density(gives)) << place;
            EXPECT_TRUE(is_sane(example.bsdf.eval(wo, s->wi))) << place;
            EXPECT_TRUE(std::isfinite(example.bsdf.pdf(wo, s->wi))) << place;
          }
        }
        // Along the normal nothing falls below the horizon but the ends of a rough lobe.
        if (gives == Gives::nothing) {
          EXPECT_EQ(samples, 0) << example.name << " cosθo " << wo.z;
        } else {
          EXPECT_GE(samples, cosine == 1 ? 8 : 1) << example.name << " cosθo " << wo.z;
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
  int samples = 0;
  const auto check = [&]<class T>(const Example& example, double epsilon, T /*scalar*/) {
    for (const double degrees : {60.0, 80.0, 89.9}) {
      for (const double azimuth : {0.0, 1e-16, -1e-12, 1e-8, std::acos(-1.0), std::acos(0.0)}) {
        for (const bool front : {true, false}) {
          const verify::Vec3 exact = direction_at(degrees, azimuth, front);
          const Vec3<T> wo{T(exact[0]), T(exact[1]), T(exact[2])};
          for (std::uint32_t lobe = 0; lobe < example.bsdf.lobe_count(); ++lobe) {
            for (const double x : {0.0, 0.25, 0.5, 1 - 2 * epsilon}) {
              for (const double ulps : {1.0, 2.0, 3.0, 8.0}) {
                const Vec2<T> u{T(x), T(1 - 2 * ulps * epsilon)};
                const auto s = example.bsdf.sample_lobe(wo, lobe, u);
                if (!s) continue;
                ++samples;
                EXPECT_NE(example.gives.of(front), Gives::nothing) << example.name;
                const double length_of_wi = length(vec_cast<double>(s->wi));
                EXPECT_NEAR(length_of_wi, 1, kRoundings * epsilon)
                    << example.name << ", " << degrees << "°, azimuth " << azimuth << ", side "
                    << (front ? 1 : -1) << ", lobe " << lobe << ", u " << x << ", " << ulps;
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
  // Metals reflect nearly all of the limb below the horizon, the narrowest all of it in double.
  EXPECT_GE(samples, 500);
}

TYPED_TEST(Edge, ThereIsADensityWhereTheModelHasOneAndNowhereElse) {
  for (const Example& example : examples_of<TypeParam>()) {
    verify::Random random(check_seed(example.name + "/density"));
    EXPECT_EQ(example.bsdf.parts().density, example.gives.density()) << example.name;
    EXPECT_EQ(example.bsdf.parts().atoms, example.gives.atoms()) << example.name;
    for (const Vec3f& wo : hard_outgoing(random)) {
      int bright = 0;
      for (const Vec3f& wi : hard_incoming(example.bsdf, wo, 16, random)) {
        bright += example.bsdf.pdf(wo, wi) > 0 ? 1 : 0;
        if (has_density(example.gives.of(wo.z > 0))) continue;
        EXPECT_EQ(example.bsdf.pdf(wo, wi), 0) << example.name;
        EXPECT_TRUE(is_black(example.bsdf.eval(wo, wi))) << example.name;
      }
      if (has_density(example.gives.of(wo.z > 0))) {
        EXPECT_GT(bright, 0) << example.name << " cosθo " << wo.z;
      }
    }
  }
}

/// One of the poles exactly: what is divided by may be 0 there.
TYPED_TEST(Edge, NothingGoesThroughWhatOnlyReflects) {
  const Vec3f up{0, 0, 1}, down{0, 0, -1}, slant{0.6f, 0, 0.8f};
  for (const Example& example : examples_of<TypeParam>()) {
    const auto expect_nothing = [&](const Vec3f& wo, const Vec3f& wi) {
      const BsdfValue<float> value = example.bsdf.evaluate(wo, wi);
      EXPECT_TRUE(is_sane(value.f) && value.pdf_w >= 0) << example.name;
      if (example.eta != 1) return;
      EXPECT_TRUE(is_black(value.f) && value.pdf_w == 0) << example.name;
    };
    for (const Vec3f& above : {up, slant}) {
      for (const Vec3f& below : {down, -slant}) {
        expect_nothing(above, below);
        expect_nothing(below, above);
      }
    }
  }
}

TYPED_TEST(Edge, EvaluateIsEvalAndPdf) {
  for (const Example& example : examples_of<TypeParam>()) {
    verify::Random random(check_seed(example.name + "/evaluate"));
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
  verify::Random random(check_seed("dark halo"));
  for (const double degrees : {85.0, 89.0, 89.9, 89.99}) {
    const Vec3f wo = direction(std::cos(radians(degrees)), 0.3);
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
  verify::Random random(check_seed("two-sided, mirrored"));
  int sampled = 0;
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
      ++sampled;
      EXPECT_EQ(length(mirrored(behind->wi) - front->wi), 0);
    }
  }
  EXPECT_GT(sampled, 500);  // few fall below the horizon
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
