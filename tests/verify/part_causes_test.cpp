#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "correct_pairs.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/part_explanations.h"
#include "seen_ratios.h"

/// Causes that are seen once a sampler is taken apart: of two lobes that do not show, a third
/// number chooses.
namespace plumbline::verify {
namespace {

constexpr double kAlpha = 0.5, kFirstShare = 0.4;

/// The densities of two lobes, whichever is chosen first, and what pdf() makes of them.
struct TwoLobes {
  bool mirror_first = false;
  OfDirections stated;
  std::deque<SamplingPair> pairs = {};
  ErasedBsdf bsdf = {};
  ReportEvidence evidence = {};

  static double of_mirror(const Vec3& wo, const Vec3& wi) {
    return RoughMirror{kAlpha}.pdf(wo, wi);
  }

  double of_samples(const Vec3& wo, const Vec3& wi) const {
    const double mirror = mirror_first ? kFirstShare : 1 - kFirstShare;
    return mirror * of_mirror(wo, wi) + (1 - mirror) * Diffuse::pdf(wo, wi);
  }

  std::optional<SampleRecord> sample(const Vec3& wo, const Uniforms& u) const {
    const bool mirror = (u[2] < kFirstShare) == mirror_first;
    auto s = mirror ? RoughMirror{kAlpha}.sample(wo, u[0], u[1]) : Diffuse::sample(wo, u[0], u[1]);
    if (s) s->pdf.reset();
    return s;
  }

  /// Seen from these directions, with the ratio of both at a few points.
  void look_from(const std::vector<Vec3>& directions) {
    bsdf.numbers = 3;
    bsdf.pdf = stated;
    bsdf.sample = [this](const Vec3& wo, const Uniforms& u) { return sample(wo, u); };
    for (const Vec3& wo : directions) {
      SamplingPair& pair = pairs.emplace_back();
      pair.numbers = 3;
      pair.sample = [this, wo](const Uniforms& u) { return sample(wo, u); };
      pair.pdf = [this, wo](const Vec3& wi) { return wi[2] > 0 ? stated(wo, wi) : 0; };
      ViewEvidence& view = evidence.views.emplace_back();
      view.pair = &pair;
      view.wo = wo;
      view.bsdf = &bsdf;
      view.failed = true;
      view.mass = MassSeen{1, 0.5, 0, 0, 0.5};  // not known
      RatioSeries& series = view.ratios.emplace_back();
      series.kind = RatioKind::density_over_pdf;
      for (const Vec3& wi : even_directions(kRatiosPerView, false)) {
        series.points.push_back({wi, of_samples(wo, wi) / stated(wo, wi), kKnownTo, -1, {}});
      }
    }
  }
};

TEST(CausesOfParts, FresnelForAProbabilityIsNamed) {
  for (const bool mirror_first : {true, false}) {
    TwoLobes lobes{mirror_first, [](const Vec3& wo, const Vec3& wi) {
                     const double c = dot_of(wo, half_vector(wo, wi));
                     const double f = 0.04 + 0.96 * std::pow(1 - c, 5);
                     return f * TwoLobes::of_mirror(wo, wi) + (1 - f) * Diffuse::pdf(wo, wi);
                   }};
    lobes.look_from({{0.8, 0, 0.6}});
    const auto f = PartExplanations(lobes.evidence).by_fresnel();
    ASSERT_TRUE(f) << mirror_first;
    EXPECT_EQ(f->kind, CauseKind::fresnel);
    EXPECT_EQ(f->words,
              "pdf() weighs its two parts by F and 1 − F of wo·h (Schlick), but they are chosen by "
              "a number that knows wo alone");
  }
  TwoLobes constant{true, [](const Vec3& wo, const Vec3& wi) {
                      return 0.7 * TwoLobes::of_mirror(wo, wi) + 0.3 * Diffuse::pdf(wo, wi);
                    }};
  constant.look_from({{0.8, 0, 0.6}});
  EXPECT_FALSE(PartExplanations(constant.evidence).by_fresnel());
}

TEST(CausesOfParts, AFactorOfOnePartIsNamedWithThePart) {
  // A cosine of the half vector and a power that is none of a mixture beside it.
  TwoLobes lobes{false, [](const Vec3& wo, const Vec3& wi) {
                   const double c = half_vector(wo, wi)[2];
                   return kFirstShare * Diffuse::pdf(wo, wi) +
                          (1 - kFirstShare) * TwoLobes::of_mirror(wo, wi) * c * c;
                 }};
  lobes.look_from({{0.8, 0, 0.6}, {0.36, 0.48, 0.8}});
  const Cause cause = diagnose(lobes.evidence);
  EXPECT_EQ(cause.kind, CauseKind::cosine) << cause.headline;
  EXPECT_EQ(cause.headline.find("factor 1/cosθh² "), std::string::npos) << cause.headline;
  EXPECT_NE(cause.headline.find("the part that is chosen with probability 0.6"), std::string::npos)
      << cause.headline;
}

}  // namespace
}  // namespace plumbline::verify
