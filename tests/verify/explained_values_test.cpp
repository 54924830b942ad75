#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "correct_pairs.h"
#include "diagnosis/values.h"
#include "seen_ratios.h"

/// What makes f other one way than the other, or give off another share than it should: from ratios
/// and albedos that are made up.
namespace plumbline::verify {
namespace {

constexpr std::size_t kPairs = 60;

/// f = f₀ X with f₀ reciprocal: f(wo, wi)/f(wi, wo) is X(wo, wi)/X(wi, wo).
struct Asymmetric {
  SamplingPair pair;
  ReportEvidence evidence;

  Asymmetric(double eta, const OfDirections& x) {
    evidence.views.resize(1);
    evidence.views[0].pair = &pair;
    evidence.views[0].eta = eta;
    const std::vector<Vec3> all = even_directions(2 * kPairs, eta != 1);
    for (std::size_t i = 0; i < kPairs; ++i) {
      const Vec3 &wo = all[2 * i], &wi = all[2 * i + 1];
      evidence.reciprocity.push_back({wo, wi, x(wo, wi) / x(wi, wo), 1e-8});
    }
  }
  Asymmetric(const Asymmetric&) = delete;
  Asymmetric& operator=(const Asymmetric&) = delete;
};

Finding cause_of_asymmetry(double eta, const OfDirections& x) {
  return explain_asymmetry(Asymmetric(eta, x).evidence).front();
}

TEST(Asymmetry, OfCosinesIsNamed) {
  const auto words = [](double power) {
    const Finding f =
        cause_of_asymmetry(1, [=](auto&, auto& i) { return std::pow(std::abs(i[2]), power); });
    EXPECT_EQ(f.kind, power == 3 ? CauseKind::asymmetric : CauseKind::value_cosine);
    return f.words;
  };
  EXPECT_EQ(words(1),
            "f holds cosθi once too often: the cosine is applied twice, or is that of the wrong "
            "direction");
  EXPECT_EQ(words(-1), "f is divided by cosθi once too often, or by cosθi instead of cosθo");
  EXPECT_EQ(words(2), "f holds cosθi twice too often");
  EXPECT_EQ(words(-2), "f is divided by cosθi² in place of cosθi cosθo");
  EXPECT_EQ(words(3), "f(wo, wi) and f(wi, wo) differ");
}

TEST(Asymmetry, OfRefractionIsNamed) {
  constexpr double kIndex = 1.5;
  const auto crosses = [](auto& o, auto& i) { return o[2] * i[2] < 0; };
  const auto index2 = [&](double power) {
    return cause_of_asymmetry(kIndex, [=](auto& o, auto& i) {
      if (!crosses(o, i)) return 1.0;
      return std::pow(o[2] > 0 ? kIndex * kIndex : 1 / (kIndex * kIndex), power);
    });
  };
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(index2(sign / 2).words,
              "the factor η_o²/η_i² of radiance across the refraction is missing from f, or one "
              "too many");
    EXPECT_EQ(index2(sign).words,
              "the factor η_o²/η_i² of radiance across the refraction is upside down in f, or "
              "there twice");
    EXPECT_EQ(index2(sign).kind, CauseKind::eta_squared);
    const Finding half = cause_of_asymmetry(kIndex, [&](auto& o, auto& i) {
      if (!crosses(o, i)) return 1.0;
      const double a = o[2] < 0 ? kIndex : 1, b = i[2] < 0 ? kIndex : 1;
      const Vec3 h = unit({a * o[0] + b * i[0], a * o[1] + b * i[1], a * o[2] + b * i[2]});
      return std::pow(std::abs(dot_of(i, h)), sign);
    });
    EXPECT_EQ(half.words, "|wi·h| of the refraction stands in f once too often or not at all");
    EXPECT_EQ(half.kind, CauseKind::refraction_jacobian);
  }
}

TEST(Asymmetry, OfTermsWithANumberIsNamedWithIt) {
  // A masking of wi that is left is one of wo that is lost.
  const Finding of_wo =
      cause_of_asymmetry(1, [](auto&, auto& i) { return RoughMirror{0.3}.masking(i); });
  EXPECT_EQ(of_wo.words, "masking G1 of wo is missing from f (GGX, α = 0.3)");
  EXPECT_EQ(of_wo.kind, CauseKind::masking);
  EXPECT_EQ(
      cause_of_asymmetry(1, [](auto&, auto& i) { return 1 / RoughMirror{0.3}.masking(i); }).words,
      "masking G1 of wi is missing from f (GGX, α = 0.3)");
  // Where a whole step of the fit goes too far: log α between two of its starts.
  EXPECT_EQ(
      cause_of_asymmetry(1, [](auto&, auto& i) { return RoughMirror{std::exp(-4.75)}.masking(i); })
          .words,
      "masking G1 of wo is missing from f (GGX, α = 0.0086517)");
  for (const double f0 : {0.04, 0.35}) {
    const auto schlick = [f0](const Vec3& w) { return f0 + (1 - f0) * std::pow(1 - w[2], 5); };
    const std::string sentence =
        "Fresnel in f is of the cosine of one direction, not of wo·h (Schlick, F0 = " +
        std::string(f0 < 0.1 ? "0.04" : "0.35") + ")";
    const Finding f = cause_of_asymmetry(1, [&](auto& o, auto&) { return schlick(o); });
    EXPECT_EQ(f.words, sentence);
    EXPECT_EQ(f.kind, CauseKind::fresnel);
    EXPECT_EQ(cause_of_asymmetry(1, [&](auto&, auto& i) { return schlick(i); }).words, sentence);
  }
}

/// Two pairs at a clamp, and those without a ratio, are left aside; a third is one too many.
TEST(Asymmetry, AFewPairsMayHaveNoRatioToSpeakOf) {
  Asymmetric seen(1, [](auto&, auto& i) { return i[2]; });
  const auto kind = [&] { return explain_asymmetry(seen.evidence).front().kind; };
  std::vector<ReciprocityAt>& pairs = seen.evidence.reciprocity;
  pairs[0].ratio = 0;
  pairs[1].ratio = std::numeric_limits<double>::infinity();
  pairs[2].ratio *= 3;
  pairs[3].ratio *= 3;
  EXPECT_EQ(kind(), CauseKind::value_cosine);
  pairs[4].ratio *= 3;
  EXPECT_EQ(kind(), CauseKind::asymmetric);
  // Eight are enough, seven are not.
  pairs.erase(pairs.begin(), pairs.begin() + 5);
  pairs.resize(8);
  EXPECT_EQ(kind(), CauseKind::value_cosine);
  pairs.resize(7);
  EXPECT_EQ(kind(), CauseKind::asymmetric);
}

TEST(Asymmetry, IsOneBeyondFourErrors) {
  const auto fails = [](double errors) {
    ReportEvidence evidence;
    evidence.reciprocity = {{{0, 0, 1}, {0.6, 0, 0.8}, 1, 1e-6},
                            {{0, 0, 1}, {0.6, 0, 0.8}, std::exp(errors * 1e-6), 1e-6}};
    return reciprocity_fails(evidence);
  };
  EXPECT_FALSE(fails(3.9));
  EXPECT_TRUE(fails(4.1));
  EXPECT_TRUE(fails(-4.1));
}

/// A factor that f lacks is in it as its inverse.
TEST(Asymmetry, IsExplainedByTheFactorThatIsMissing) {
  const Asymmetric seen(1, [](auto&, auto& i) { return 1 / i[2]; });
  const auto explained = [&](double power) {
    return explains_reciprocity(seen.evidence,
                                [power](const Place& p, std::span<const double>) {
                                  return p.base * std::pow(p.x[2], power);
                                },
                                {});
  };
  EXPECT_TRUE(explained(1));
  EXPECT_FALSE(explained(-1));
  EXPECT_FALSE(explained(0));
}

std::vector<AlbedoAt> albedos(const std::vector<double>& seen, std::optional<double> known,
                              double error) {
  std::vector<AlbedoAt> all;
  for (const double a : seen) all.push_back({{0, 0, 1}, a, error, known});
  return all;
}

TEST(Energy, IsTooMuchBeyondItsErrorAndAThousandth) {
  const auto fails = [](double albedo, std::optional<double> known) {
    return energy_fails({{}, {}, albedos({0.5, albedo}, known, 0.01)});
  };
  EXPECT_FALSE(fails(1.0109, std::nullopt));
  EXPECT_TRUE(fails(1.0111, std::nullopt));
  EXPECT_FALSE(fails(0.2, std::nullopt)) << "less may be right";
  EXPECT_FALSE(fails(0.5109, 0.5));
  EXPECT_TRUE(fails(0.5111, 0.5));
  EXPECT_TRUE(fails(0.4889, 0.5));
}

TEST(Energy, ConstantsAreNamed) {
  const auto first = [](const std::vector<double>& seen, std::optional<double> known) {
    const Finding f = explain_energy({{}, {}, albedos(seen, known, 1e-6)}).front();
    return std::string(to_string(f.kind)) + ": " + f.words;
  };
  const std::string constant = std::string(to_string(CauseKind::value_constant)) + ": ";
  EXPECT_EQ(first({1.0, 1.0, 1.0}, 0.5),
            constant + "f is 2 times what the known albedo asks for, from every direction");
  EXPECT_EQ(first({1.5, 1.5}, 1.0),
            constant + "f is 3/2 times what the known albedo asks for, from every direction");
  EXPECT_EQ(first({1.1, 1.1}, 1.0),
            constant + "f is 1.1 times what the known albedo asks for, from every direction");
  const std::string energy = std::string(to_string(CauseKind::energy)) + ": ";
  EXPECT_EQ(first({1.1, 1.2}, 1.0),
            energy + "f gives off more than arrives: the albedo reaches 1.2");
  EXPECT_EQ(first({3.14, 3.15}, std::nullopt),
            constant +
                "the albedo is 3.15 from every direction: 1/π or another constant is "
                "missing from f");
  EXPECT_EQ(first({3.1, 3.15}, std::nullopt),
            energy + "f gives off more than arrives: the albedo reaches 3.15");
  EXPECT_EQ(first({1.4, 1.4}, std::nullopt),
            energy + "f gives off more than arrives: the albedo reaches 1.4");
}

}  // namespace
}  // namespace plumbline::verify
