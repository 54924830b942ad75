#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/pair.h>

#include "correct_pairs.h"

/// Bugs of real renderers put on correct pairs: the battery passes the correct one, fails the wrong
/// one, and what it names first is the cause.
namespace plumbline::verify {
namespace {

using Results = Report;

BsdfOptions looked_at(std::vector<double> angles) {
  BsdfOptions o;
  o.angles = std::move(angles);
  o.random_directions = 0;
  o.back = false;
  return o;
}

/// For a BSDF that is black from below.
BsdfOptions one_way() {
  BsdfOptions o = looked_at({60});
  o.reciprocal = false;
  return o;
}

/// @param run  the battery on the pair, correct or with the bug
struct KnownBug {
  std::string id;  ///< as in the literature of bugs that the checks were written for
  std::string title;
  std::string cause;  ///< that the first diagnosis must contain
  std::function<Results(bool wrong, std::uint64_t seed)> run;
};

/// The battery on a BSDF, with the bug or without.
KnownBug of_bsdf(std::string id, std::string title, std::string cause, ErasedBsdf correct,
                 std::function<void(ErasedBsdf&)> spoil, BsdfOptions options) {
  const auto run = [=](bool wrong, std::uint64_t seed) {
    ErasedBsdf bsdf = correct;
    if (wrong) spoil(bsdf);
    BsdfOptions o = options;
    o.contract.seed = seed;
    return check_bsdf(id, bsdf, o);
  };
  return {std::move(id), std::move(title), std::move(cause), run};
}

KnownBug of_pair(std::string id, std::string title, std::string cause, SamplingPair correct,
                 std::function<void(SamplingPair&)> spoil) {
  const auto run = [=](bool wrong, std::uint64_t seed) {
    SamplingPair pair = correct;
    if (wrong) spoil(pair);
    ContractOptions o;
    o.seed = seed;
    return check_pair(pair, o);
  };
  return {std::move(id), std::move(title), std::move(cause), run};
}

ErasedBsdf coated_mirror() {
  return mixture(erased(Diffuse{}), erased(RoughMirror{0.3}), 0.4, [](const Vec3&) { return 0.4; });
}

/// Diffuse reflection and transmission; reflection is chosen with Schlick's reflectance.
double schlick(const Vec3& wo) { return 0.04 + 0.96 * std::pow(1 - std::abs(wo[2]), 5); }

ErasedBsdf translucent() {
  return mixture(erased(Diffuse{}), transmitted(erased(Diffuse{})), 0.5, schlick);
}

/// A map with luminance 1 + 0.8 cosθ, sampled in proportion.
SamplingPair environment_map() {
  constexpr double kTilt = 0.8;
  return sampling_pair<Vec3>(
      "L12", Domain::sphere(),
      [](double u, double v) {
        // (1 + c)/2 + kTilt (c² − 1)/4 = u, solved for c = cosθ.
        const double c = (std::sqrt((1 - kTilt) * (1 - kTilt) + 4 * kTilt * u) - 1) / kTilt;
        const double s = std::sqrt(std::max(0.0, 1 - c * c)), phi = 2 * std::numbers::pi * v;
        return Vec3{s * std::cos(phi), s * std::sin(phi), c};
      },
      [](const Vec3& w) { return (1 + kTilt * w[2]) / (4 * std::numbers::pi); });
}

void without_half_vector_jacobian(ErasedBsdf& b) {
  const auto pdf = b.pdf;
  b.pdf = [pdf](const Vec3& wo, const Vec3& wi) {
    return pdf(wo, wi) * 4 * dot_of(wo, half_vector(wo, wi));
  };
  const auto sample = b.sample;
  b.sample = [pdf = b.pdf, sample](const Vec3& wo, const Uniforms& u) {
    auto record = sample(wo, u);
    if (record) {
      const double right = *record->pdf;
      record->pdf = pdf(wo, record->x);
      record->weight.value[0] *= right / *record->pdf;
    }
    return record;
  };
}

void pdf_of_the_chosen_lobe(ErasedBsdf& b) {
  b.sample = [a = b.lobes, sample = b.sample](const Vec3& wo, const Uniforms& u) {
    auto record = sample(wo, u);
    if (record) record->pdf = a[u[0] < a[0].probability(wo) ? 0 : 1].pdf(wo, record->x);
    return record;
  };
}

void weight_of_the_chosen_lobe(ErasedBsdf& b) {
  // f of the chosen lobe with its share, over the density of the whole.
  b.sample = [sample = b.sample](const Vec3& wo, const Uniforms& u) {
    auto record = sample(wo, u);
    if (!record) return record;
    const double f = u[0] < 0.4 ? 0.4 * Diffuse::eval(wo, record->x)
                                : 0.6 * RoughMirror{0.3}.eval(wo, record->x);
    record->weight = gray(f * record->x[2] / *record->pdf);
    return record;
  };
}

void swapped(ErasedBsdf& b) {
  const auto pdf = b.pdf;
  const auto eval = b.eval;
  b.pdf = [pdf](const Vec3& wo, const Vec3& wi) { return pdf(wi, wo); };
  b.eval = [eval](const Vec3& wo, const Vec3& wi) { return eval(wi, wo); };
  b.sample = [pdf = b.pdf, sample = b.sample](const Vec3& wo, const Uniforms& u) {
    auto record = sample(wo, u);
    if (record) record->pdf = pdf(wo, record->x);
    return record;
  };
}

void cosine_twice(ErasedBsdf& b) {
  const auto eval = b.eval;
  b.eval = [eval](const Vec3& wo, const Vec3& wi) { return gray(eval(wo, wi)[0] * wi[2]); };
  b.sample = [sample = b.sample](const Vec3& wo, const Uniforms& u) {
    auto record = sample(wo, u);
    if (record) record->weight.value[0] *= record->x[2];
    return record;
  };
}

void negated_on_the_way(ErasedBsdf& b) {
  b.sample = [sample = b.sample](const Vec3& wo, const Uniforms& u) {
    auto record = sample({-wo[0], -wo[1], wo[2]}, u);
    return record;
  };
}

void without_lobe_probability(ErasedBsdf& b) {
  b.pdf = [lobes = b.lobes](const Vec3& wo, const Vec3& wi) {
    return lobes[0].pdf(wo, wi) + lobes[1].pdf(wo, wi);
  };
}

void without_masking(ErasedBsdf& b) {
  b.pdf = [pdf = b.pdf](const Vec3& wo, const Vec3& wi) {
    return pdf(wo, wi) / RoughMirror{0.3}.masking(wo);
  };
}

std::vector<KnownBug> known_bugs() {
  const ErasedBsdf mirror = erased(RoughMirror{0.3});
  return {of_bsdf("B2", "visible normals' pdf without G1", "G1(wo)", mirror, without_masking,
                  looked_at({40, 60, 75, 85})),
          of_bsdf("B3", "half-vector pdf without 1/(4 wo·h)", "half-vector Jacobian", mirror,
                  without_half_vector_jacobian, looked_at({30, 60})),
          of_bsdf("B7", "sample() returns the chosen lobe's pdf", "pdf of the chosen lobe",
                  coated_mirror(), pdf_of_the_chosen_lobe, looked_at({60})),
          of_bsdf("B8", "weight of one lobe over the mixture's pdf", "chosen lobe", coated_mirror(),
                  weight_of_the_chosen_lobe, looked_at({60})),
          of_bsdf("B13", "wo and wi swapped in eval and pdf", "exchanged", mirror, swapped,
                  looked_at({30, 60})),
          of_bsdf("B21", "the whole of wo negated, not its z", "mirrored", mirror,
                  negated_on_the_way, looked_at({60})),
          of_bsdf("B28", "cosine applied twice", "cosθ", mirror, cosine_twice, looked_at({60})),
          of_bsdf("B31", "lobe chosen with probability F, pdf without",
                  "probabilities of the lobes are missing", translucent(), without_lobe_probability,
                  one_way()),
          of_pair("L2", "area instead of 1/area as the pdf", "area", rectangle(),
                  [](SamplingPair& p) { p.pdf = [](const Vec3&) { return kLightArea; }; }),
          of_pair("L12", "environment map pdf with a wrong sinθ", "sinθ", environment_map(),
                  [](SamplingPair& p) {
                    p.pdf = [pdf = p.pdf](const Vec3& w) {
                      return pdf(w) * std::hypot(w[0], w[1]);
                    };
                  })};
}

struct Row {
  std::string failing, diagnosis;
  std::uint64_t samples = 0;  ///< of the first check that fails, per direction
};

/// Kinds of checks that fail, in their order.
Row summary_of(const Results& results) {
  Row row;
  for (const CheckResult& r : results) {
    if (r.verdict != Verdict::fail) continue;
    if (row.samples == 0) row.samples = r.samples;
    if (row.diagnosis.empty()) row.diagnosis = r.diagnosis;
    const std::string kind(to_string(r.kind));
    if ((" " + row.failing + " ").find(" " + kind + " ") == std::string::npos) {
      row.failing += (row.failing.empty() ? "" : " ") + kind;
    }
  }
  return row;
}

TEST(KnownBugs, AreFailedAndNamedOnCorrectPairsThatPass) {
  int named = 0;
  std::string table;
  for (const KnownBug& bug : known_bugs()) {
    for (CheckResult r : bug.run(false, tests::check_seed("correct/" + bug.id))) {
      r.subject = "correct/" + r.subject;
      tests::expect_verdict(r);
    }
    const Row row = summary_of(bug.run(true, tests::check_seed("bug/" + bug.id)));
    EXPECT_FALSE(row.failing.empty()) << bug.id << ": nothing fails";
    const bool first = row.diagnosis.find(bug.cause) != std::string::npos;
    EXPECT_TRUE(first) << bug.id << ": " << row.diagnosis;
    named += first ? 1 : 0;
    table += bug.id + "  " + bug.title + "\n    fails      " + row.failing + "\n    diagnosis  " +
             (row.diagnosis.empty() ? "none" : row.diagnosis) +
             (first ? "" : "   (not the cause)") + "\n    seen after " +
             std::to_string(row.samples) + " points\n";
  }
  std::printf("%s%d of %zu causes named first\n", table.c_str(), named, known_bugs().size());
}

/// What the battery says of a wrong BSDF that no usual suspect explains.
Results on(const std::string& name, const ErasedBsdf& bsdf) {
  BsdfOptions o = looked_at({30, 60});
  o.contract.seed = tests::check_seed(name);
  return check_bsdf(name, bsdf, o);
}

TEST(KnownBugs, NothingIsGuessedWhereNothingFits) {
  const ErasedBsdf mirror = erased(RoughMirror{0.3});
  ErasedBsdf rippled = mirror;
  rippled.pdf = [pdf = mirror.pdf](const Vec3& wo, const Vec3& wi) {
    return pdf(wo, wi) * (1 + 0.3 * std::sin(9 * wi[0]) * std::cos(7 * wi[1]));
  };
  const Row row = summary_of(on("rippled pdf", rippled));
  EXPECT_FALSE(row.failing.empty());
  EXPECT_EQ(row.diagnosis, "");
}

TEST(KnownBugs, RoughnessClampedInSampleOnlyIsNamed) {
  ErasedBsdf other_roughness = erased(RoughMirror{0.2});
  other_roughness.sample = erased(RoughMirror{0.3}).sample;  // B29
  const Row row = summary_of(on("other roughness", other_roughness));
  EXPECT_NE(row.diagnosis.find("the roughness in pdf() is another"), std::string::npos)
      << row.diagnosis;
}

}  // namespace
}  // namespace plumbline::verify
