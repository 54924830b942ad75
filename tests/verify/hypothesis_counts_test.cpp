#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "correct_pairs.h"
#include "seen_ratios.h"

/// Where there are counts alone, some explanations are looked for and some are not.
namespace plumbline::verify {
namespace {

double beside(const Vec3&, const Vec3& wi) { return 0.6 + 0.3 * wi[0]; }

/// Of bins with so many samples each, a node in the middle.
Said said_of_counts(double each, const OfDirections& samples) {
  SeenRatios seen(bsdf_with(beside), kViews, {}, 1, RatioKind::density_over_pdf, samples);
  for (ViewEvidence& view : seen.evidence().views) {
    for (const Vec3& wi : even_directions(200, false)) {
      BinSeen& bin = view.bins.emplace_back();
      bin.expected = each;
      bin.observed = each * samples(*view.wo, wi) / beside(*view.wo, wi);
      bin.nodes = {wi};
      bin.shares = {1};
    }
    view.samples = 200 * each;
  }
  const Observations o = Observations::of_density(seen.evidence());
  return simplest(o, mixture_hypotheses(seen.evidence(), of_pdf(), o));
}

/// A diffuse lobe beside another is looked for; of a uniform one counts cannot tell enough.
TEST(Counts, AreEnoughForADiffuseLobe) {
  const auto mixed = [](const Vec3& of_diffuse) {
    return [of_diffuse](const Vec3& o, const Vec3& i) {
      return 0.35 * beside(o, i) + 0.3 * (of_diffuse[0] * i[2] + of_diffuse[1]) / std::numbers::pi;
    };
  };
  EXPECT_EQ(said_of_counts(1e6, mixed({1, 0, 0})).words,
            "the lobes' probabilities are missing from pdf() (a mixture with a lobe that is "
            "diffuse)");
  EXPECT_EQ(said_of_counts(1e6, mixed({0, 0.5, 0})).words, "");
}

}  // namespace
}  // namespace plumbline::verify
