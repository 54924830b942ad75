#include <gtest/gtest.h>
#include <plumbline_tests/directions.h>
#include <plumbline_tests/support.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <plumbline/analytic/bsdf_albedo.h>
#include <plumbline/analytic/fresnel.h>
#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/mean.h>
#include "examples.h"
#include "hard_points.h"
#include "known_albedo.h"

/// What BSDFs give back, against answers that share nothing with the renderer.
namespace plumbline::tests {
namespace {

using namespace renderer;

using std::numbers::pi;

TEST(Fresnel, DielectricsAgreeWithComplexAmplitudes) {
  for (const float eta : {0.4f, 1 / 1.5f, 0.99f, 1.01f, 1.5f, 2.5f}) {
    for (int i = 0; i <= 1000; ++i) {
      const double cosine = i / 1000.0;
      const PowerSplit<double> split = BareInterface{eta}.split<double>(cosine * cosine, true);
      const double truth = analytic::interface_reflectance(cosine, 1, double{eta});
      EXPECT_NEAR(split.reflected, truth, 1e-13) << eta << ' ' << cosine;
      EXPECT_NEAR(split.reflected + split.transmitted, 1, 1e-14) << eta << ' ' << cosine;
      EXPECT_GE(split.transmitted, 0);
    }
  }
}

TEST(Fresnel, ConductorsAgreeWithComplexAmplitudes) {
  for (const analytic::Index index : {analytic::Index(0.05, 4), analytic::Index(1.37, 1.77),
                                      analytic::Index(3, 1e-3), analytic::Index(0.5, 0)}) {
    for (int i = 0; i <= 1000; ++i) {
      const double cosine = i / 1000.0;
      EXPECT_NEAR(fresnel_conductor(cosine, index.real(), index.imag()),
                  analytic::interface_reflectance(cosine, 1, index), 1e-13)
          << index << ' ' << cosine;
    }
  }
}

TEST(Fresnel, NothingPassesBeyondTheCriticalAngleAndTheLastBitDecides) {
  const float critical = std::sqrt(1 - 1 / (1.5f * 1.5f));
  const BareInterface glass{1.5f};
  const auto transmitted = [&](double cosine) {
    return glass.split<float>(cosine * cosine, false).transmitted;
  };
  EXPECT_EQ(transmitted(static_cast<double>(critical) - 1e-7), 0);
  const float just_inside = transmitted(static_cast<double>(critical) + 1e-7);
  EXPECT_GT(just_inside, 1e-4f);
  EXPECT_LT(just_inside, 1e-2f);
}

TEST(ThinFilm, BandMeansAgreeWithQuadratureOverAirysFormula) {
  // From outside on metal and glass, and from inside the glass; thin to 2 µm.
  constexpr std::array<double, 4> kEdges{700, 590, 490, 400};
  for (const float thickness : {0.0f, 1.0f, 100.0f, 550.0f, 2000.0f}) {
    for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.9}) {
      const double cosine = std::cos(radians(degrees));
      const FilmOnConductor metal{{thickness, 1.5f}, {{0.2f, 0.2f, 0.2f}, {3, 3, 3}}};
      const FilmOnDielectric glass{{thickness, 1.375f}, 1.5f};
      const Rgbd on_metal = metal(cosine * cosine);
      const Rgbd outside = glass.split<double>(cosine * cosine, true).reflected;
      const Rgbd inside = glass.split<double>(cosine * cosine, false).reflected;
      const std::array<std::array<double, 3>, 3> channels{{{on_metal.r, outside.r, inside.r},
                                                           {on_metal.g, outside.g, inside.g},
                                                           {on_metal.b, outside.b, inside.b}}};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto truth = [&](double from, double film, analytic::Index base) {
          return analytic::film_band_reflectance(cosine, from, film, base, thickness, kEdges[c + 1],
                                                 kEdges[c]);
        };
        const analytic::Index index(0.2f, 3);
        EXPECT_NEAR(channels[c][0], truth(1, 1.5, index), 1e-9) << thickness << ' ' << degrees;
        EXPECT_NEAR(channels[c][1], truth(1, 1.375, 1.5), 1e-9) << thickness << ' ' << degrees;
        EXPECT_NEAR(channels[c][2], truth(1.5, 1.375, 1), 1e-9) << thickness << ' ' << degrees;
      }
    }
  }
}

TEST(ThinFilm, WithoutThicknessItIsTheBareInterface) {
  const FilmOnConductor on_metal{{0, 1.7f}, copper()};
  const FilmOnDielectric on_glass{{0, 1.7f}, 1.5f};
  for (int i = 0; i <= 100; ++i) {
    const double cosine = i / 100.0;
    const Rgbd bare = copper()(cosine * cosine), filmed = on_metal(cosine * cosine);
    EXPECT_NEAR(filmed.r, bare.r, 1e-13) << cosine;
    EXPECT_NEAR(filmed.g, bare.g, 1e-13) << cosine;
    EXPECT_NEAR(filmed.b, bare.b, 1e-13) << cosine;
    for (const bool outside : {true, false}) {
      EXPECT_NEAR(on_glass.split<double>(cosine * cosine, outside).reflected.g,
                  BareInterface{1.5f}.split<double>(cosine * cosine, outside).reflected, 1e-13)
          << cosine;
    }
  }
}

TEST(AnalyticAlbedo, WhiteGgxOfRoughnessOneAtNormalIncidenceKeepsOneMinusLn2) {
  // wi = (2θ): G1(wi) = 1 − r² with slope r, so ∫₀¹ 2r (1 − r²)/(1 + r²)² dr = 1 − ln 2.
  EXPECT_NEAR(analytic::ggx_reflection_albedo({1, 1}, {0, 0, 1}, [](double) { return 1.0; }),
              1 - std::numbers::ln2, 1e-6);
}

TEST(AnalyticAlbedo, PhongAtNormalIncidenceKeepsAll) {
  for (const double exponent : {1.0, 10.0, 1e3, 1e6}) {
    EXPECT_NEAR(analytic::phong_albedo(exponent, 1), 1, 1e-9) << exponent;
  }
}

TEST(AnalyticAlbedo, PhongOfExponentOneHasAClosedFormAtGrazing) {
  // n = 1, wo along the surface: f = 3/(2π) cosα with cosα = sinθ cosφ, so the albedo is
  // 3/(2π) · ∫ sin²θ cosθ dθ · ∫ cosφ dφ over |φ| < π/2 = 3/(2π) · 1/3 · 2 = 1/π.
  EXPECT_NEAR(analytic::phong_albedo(1, 0), 1 / pi, 1e-9);
}

constexpr std::array kWeightChannels{&Rgbf::r, &Rgbf::g, &Rgbf::b};

/// Directions at which albedos are checked, on both faces.
std::vector<Vec3f> albedo_directions() {
  std::vector<Vec3f> directions;
  const std::vector<double> angles =
      nightly() ? std::vector<double>{0, 60, 80, 88, 89.9} : std::vector<double>{60, 89.9};
  for (const double degrees : angles) {
    const double cosine = std::cos(radians(degrees));
    directions.push_back(direction(cosine, 0.3 + degrees));
    directions.push_back(direction(-cosine, 0.3 + degrees));
  }
  return directions;
}

/// Mean of the weights of float samples as rendered, in power, in one channel.
verify::CheckResult check_albedo(const Example& example, const Vec3f& wo, std::size_t channel,
                                 double reference, double allowance, const std::string& subject) {
  verify::Random random(check_seed(subject));
  verify::MeanOptions options;
  options.subject = subject;
  options.reference = reference;
  options.tolerance = 0.005;
  options.rounding_allowance = allowance;
  return verify::check_mean(options, [&](std::uint64_t, std::uint64_t count) {
    verify::Moments moments;
    for (std::uint64_t i = 0; i < count; ++i) {
      const float x = random.uniform_float();
      const auto s = example.bsdf.sample(wo, Vec2f{x, random.uniform_float()});
      if (s) {
        moments.add(static_cast<double>(s->weight.*kWeightChannels[channel] / s->radiance_scale));
      } else {
        moments.add_rejected();
      }
    }
    return moments;
  });
}

/// Rounding, or what a model's own table is off by.
double allowance(const Example& example) {
  const double tolerance = albedo_tolerance(example);
  return tolerance > 1e-3 ? tolerance : 1e-5;
}

template <class B>
class Albedo : public testing::Test {};

TYPED_TEST_SUITE(Albedo, BsdfTypes, );

TYPED_TEST(Albedo, MeanWeightIsTheAlbedoByQuadratureAndAtMostOne) {
  std::size_t turn = 0;
  for (const Example& example : examples_of<TypeParam>()) {
    ++turn;
    for (const Vec3f& wo : albedo_directions()) {
      const std::size_t channel = turn++ % 3;
      const double reference = known_albedo(example, vec_cast<double>(wo), channel);
      if (reference == 0) {
        EXPECT_FALSE(example.bsdf.sample(wo, Vec2f{0.4f, 0.6f})) << example.name << " from behind";
        continue;
      }
      EXPECT_LE(reference, 1 + 1e-6) << example.name;
      const double degrees = std::acos(static_cast<double>(wo.z)) * 180 / pi;
      expect_verdict(check_albedo(example, wo, channel, reference, allowance(example),
                                  example.name + "/albedo at " + std::to_string(degrees)));
    }
  }
}

TEST(NegativeControl, AnAlbedoOffByOnePercentFails) {
  const Example rough = examples_of<GgxConductor>()[2];
  const Vec3f wo = direction(0.5, 0.3);
  const double reference = known_albedo(rough, vec_cast<double>(wo), 1);
  verify::CheckResult result =
      check_albedo(rough, wo, 1, 1.01 * reference, 1e-5, "albedo, 1 % off");
  result.expected = verify::Verdict::fail;
  expect_verdict(result);
}

}  // namespace
}  // namespace plumbline::tests
