#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "correct_pairs.h"
#include "seen_ratios.h"

/// Mixtures, sides and constants: what one lobe, one side or the whole lacks is named.
namespace plumbline::verify {
namespace {

using std::numbers::pi;

double diffuse_lobe(const Vec3& wi) { return std::max(0.0, wi[2]) / pi; }
double uniform_lobe(const Vec3& wi) { return wi[2] > 0 ? 1 / (2 * pi) : 0; }

/// A lobe beside others, of both directions.
double lobe(const Vec3& wo, const Vec3& wi) { return 0.6 + 0.3 * wi[0] + 0.2 * wi[1] * wo[0]; }

/// By what is said of mixtures, of samples as dense as that where pdf() is this.
Said said_of_mixture(const OfDirections& pdf, const OfDirections& samples) {
  SeenRatios seen(bsdf_with(pdf), kViews, even_directions(kRatiosPerView, false), 1,
                  RatioKind::density_over_pdf,
                  [&](const Vec3& o, const Vec3& i) { return samples(o, i) / pdf(o, i); });
  const Observations o = Observations::of_density(seen.evidence());
  return simplest(o, mixture_hypotheses(seen.evidence(), of_pdf(), o));
}

struct Beside {
  const char* name;
  double (*density)(const Vec3&);
};
constexpr Beside kBeside[] = {{"diffuse", diffuse_lobe}, {"uniform", uniform_lobe}};

TEST(Mixtures, WrongProbabilitiesAreNamed) {
  struct Row {
    const char* words;
    double own, other;  // what samples have of pdf(), and of the lobe beside it
  };
  const Row rows[] = {
      {"the lobes' probabilities are missing from pdf()", 0.35, 1 - 2 * 0.35},
      {"lobes are chosen with other probabilities than those in pdf()", 1.25, -0.25},
      {"the probability of this lobe is wrong in, or missing from, pdf()", 1, 0.5},
      {"the probability of the other lobe is missing from pdf()", 0.6, 0.16},
      {"the probabilities of the lobes are wrong in pdf()", 0.8, 0.3}};
  for (const Beside& b : kBeside) {
    for (const Row& row : rows) {
      const Said said = said_of_mixture(
          lobe, [&](auto& o, auto& i) { return row.own * lobe(o, i) + row.other * b.density(i); });
      EXPECT_EQ(said.words,
                row.words + std::string(" (a mixture with a lobe that is ") + b.name + ")");
      EXPECT_EQ(said.kind, CauseKind::lobe_probability);
    }
  }
  // A constant is no matter of a mixture.
  EXPECT_EQ(said_of_mixture(lobe, [](auto& o, auto& i) { return 0.8 * lobe(o, i); }).words, "");
}

/// From each direction another probability: as many numbers as views.
TEST(Mixtures, ProbabilitiesThatDependOnTheViewAreNamed) {
  const Said said = said_of_mixture(
      lobe, [](auto& o, auto& i) { return o[2] / 2 * lobe(o, i) + (1 - o[2]) * diffuse_lobe(i); });
  EXPECT_EQ(said.words,
            "the lobes' probabilities are missing from pdf() (a mixture with a lobe that is "
            "diffuse)");
  EXPECT_GT(said.cost, 3 * kPerNumber);
}

TEST(Mixtures, FactorsOfOneLobeAreNamed) {
  const auto woh = [](auto& o, auto& i) { return dot_of(o, half_vector(o, i)); };
  const auto cos_h = [](auto& o, auto& i) { return half_vector(o, i)[2]; };
  struct Row {
    const char* name;
    CauseKind kind;
    OfDirections factor;
  };
  using K = CauseKind;
  const Row rows[] = {
      {"1/(4 wo·h)", K::half_vector_jacobian,
       [&](auto& o, auto& i) { return 1 / (4 * woh(o, i)); }},
      {"cosθh", K::cosine, cos_h},
      {"1/cosθh", K::cosine, [&](auto& o, auto& i) { return 1 / cos_h(o, i); }},
      {"wo·h", K::half_vector_jacobian, woh},
      {"1/(wo·h)", K::half_vector_jacobian, [&](auto& o, auto& i) { return 1 / woh(o, i); }},
      {"1/4", K::half_vector_jacobian, [](auto&, auto&) { return 0.25; }},
      {"4", K::half_vector_jacobian, [](auto&, auto&) { return 4.0; }},
      {"cosθh/(4 wo·h)", K::half_vector_jacobian,
       [&](auto& o, auto& i) { return cos_h(o, i) / (4 * woh(o, i)); }},
      {"cosθi", K::cosine, [](auto&, auto& i) { return i[2]; }},
      {"1/cosθi", K::cosine, [](auto&, auto& i) { return 1 / i[2]; }},
      {"cosθo", K::cosine, [](auto& o, auto&) { return o[2]; }},
      {"1/cosθo", K::cosine, [](auto& o, auto&) { return 1 / o[2]; }}};
  for (const Beside& b : kBeside) {
    const auto mixture_with = [&](const OfDirections& factor) {
      return [&b, factor](const Vec3& o, const Vec3& i) {
        return 0.4 * b.density(i) + 0.6 * lobe(o, i) * factor(o, i);
      };
    };
    const OfDirections pdf = mixture_with([](auto&, auto&) { return 1.0; });
    for (const Row& row : rows) {
      const Said said = said_of_mixture(pdf, mixture_with(row.factor));
      EXPECT_EQ(said.words, "factor " + std::string(row.name) +
                                " missing from pdf() of one lobe (beside one that is " + b.name +
                                ")");
      EXPECT_EQ(said.kind, row.kind) << row.name;
    }
    for (const double power : {1.0, -1.0}) {
      const Said said = said_of_mixture(pdf, mixture_with([power](auto& o, auto&) {
                                          return std::pow(RoughMirror{0.3}.masking(o), power);
                                        }));
      EXPECT_EQ(said.words, "G1(wo) of the visible normals " +
                                std::string(power > 0 ? "missing from" : "too many in") +
                                " pdf() of one lobe (GGX, α = 0.3)");
      EXPECT_EQ(said.kind, CauseKind::masking);
    }
  }
}

TEST(Mixtures, ALobeOfAnotherFormIsNamed) {
  const auto words = [](auto stated, auto sampled) {
    const auto with = [](auto beside) {
      return [beside](const Vec3& o, const Vec3& i) { return 0.4 * beside(i) + 0.6 * lobe(o, i); };
    };
    return said_of_mixture(with(stated), with(sampled)).words;
  };
  EXPECT_EQ(words(uniform_lobe, diffuse_lobe),
            "one lobe is sampled as diffuse, but uniform in pdf()");
  EXPECT_EQ(words(diffuse_lobe, uniform_lobe),
            "one lobe is sampled as uniform, but diffuse in pdf()");
  EXPECT_EQ(words([](const Vec3& i) { return pi * diffuse_lobe(i); }, diffuse_lobe),
            "one lobe is sampled as diffuse, but cosθ without 1/π in pdf()");
}

TEST(Mixtures, DirectionsExchangedInOneLobeAreNamed) {
  const auto with = [](double b, double s) { return 0.4 * b + 0.6 * s; };
  const Said said =
      said_of_mixture([&](auto& o, auto& i) { return with(diffuse_lobe(i), lobe(i, o)); },
                      [&](auto& o, auto& i) { return with(diffuse_lobe(i), lobe(o, i)); });
  EXPECT_EQ(said.words,
            "wo and wi are exchanged in pdf() of one lobe (beside one that is diffuse)");
  EXPECT_EQ(said.kind, CauseKind::directions_swapped);
}

TEST(Mixtures, AnotherDensityIsNamed) {
  const auto words = [](auto density) {
    return said_of_mixture(lobe, [&](auto&, auto& i) { return density(i); }).words;
  };
  EXPECT_EQ(words(diffuse_lobe), "the density of the samples is diffuse, whatever pdf() says");
  EXPECT_EQ(words(uniform_lobe), "the density of the samples is uniform, whatever pdf() says");
  EXPECT_EQ(words([](const Vec3&) { return 1 / (4 * pi); }),
            "the density of the samples is uniform on the whole sphere, whatever pdf() says");
}

/// Lobes that are exposed state their densities themselves.
TEST(Mixtures, ProbabilitiesOfExposedLobesAreNamed) {
  const OfPoint a = [](const Vec3& x) { return 1 + 0.5 * x[0]; };
  const OfPoint b = [](const Vec3& x) { return 1 - 0.4 * x[1]; };
  const auto named = [&](double in_pdf_a, double in_pdf_b, double of_a, double of_b) {
    SeenRatios seen(
        Domain::sphere(), [&](const Vec3& x) { return in_pdf_a * a(x) + in_pdf_b * b(x); },
        even_directions(kRatiosPerView, true),
        [&](const Vec3& x) {
          return (of_a * a(x) + of_b * b(x)) / (in_pdf_a * a(x) + in_pdf_b * b(x));
        });
    seen.pair().lobes = {{"a", 0.3, {}, a}, {"b", 0.7, {}, b}};
    const Observations o = Observations::of_density(seen.evidence());
    const Said said = simplest(o, mixture_hypotheses(seen.evidence(), of_pdf(), o));
    EXPECT_EQ(said.kind, CauseKind::lobe_probability);
    return said.words;
  };
  EXPECT_EQ(named(1, 1, 0.3, 0.7),
            "the probabilities of the lobes are missing from, or wrong in, pdf(): the density of "
            "the samples is Σ probability · lobe pdf");
  EXPECT_EQ(named(0.3, 0.7, 0.5, 0.5),
            "lobes are chosen with equal probabilities, the pdf has others");
  EXPECT_EQ(named(0.3, 0.7, 0.6, 0.4),
            "lobes are chosen with other probabilities than the pdf has: here 0.6, 0.4");
}

// Constants.

Said said_of_constants(const std::vector<Vec3>& wo, bool whole_sphere, const OfDirections& ratio) {
  SeenRatios seen(bsdf_with(lobe), wo, even_directions(kRatiosPerView, whole_sphere), 1,
                  RatioKind::density_over_pdf, ratio);
  const Observations o = Observations::of_density(seen.evidence());
  return simplest(o, constant_hypotheses(seen.evidence(), of_pdf(), o));
}

TEST(Constants, AreNamedByTheNameThatTheyHave) {
  const auto words = [](double c) {
    return said_of_constants(kViews, false, [c](auto&, auto&) { return c; }).words;
  };
  const auto sentence = [](const std::string& c) {
    return "constant factor " + c + " missing from pdf(): the density of the samples is " + c +
           " times as large everywhere";
  };
  EXPECT_EQ(words(2), sentence("2"));
  EXPECT_EQ(words(1 / pi), sentence("1/π"));
  EXPECT_EQ(words(1 / (2 * pi)), sentence("1/(2π)"));
  EXPECT_EQ(words(2 / pi), sentence("2/π"));
  EXPECT_EQ(words(4 * pi), sentence("4π"));
  EXPECT_EQ(words(std::sqrt(2)), sentence("√2"));
  EXPECT_EQ(words(1.237), sentence("1.237"));
  EXPECT_EQ(words(2.0002), sentence("2.0002")) << "close to 2, and known better than that";
}

TEST(Constants, UsualOnesAreKnownWithinTheirError) {
  EXPECT_EQ(usual_constant(2.02, 0.011), "2");
  EXPECT_EQ(usual_constant(2.02, 0.009), "");
  EXPECT_EQ(usual_constant(0.75, 1e-9), "3/4");
  EXPECT_EQ(usual_constant(1 / (pi * pi), 1e-9), "1/(π²)");
  EXPECT_EQ(usual_constant(3.07, 0.025), "") << "3 or π";
  EXPECT_EQ(nearest_usual_constant(2.02), 2);
  EXPECT_EQ(nearest_usual_constant(0.32), 1 / pi);
  EXPECT_EQ(nearest_usual_constant(1.01), 1);
}

TEST(Constants, OfOneSideAreNamed) {
  const std::vector<Vec3> one = {kViews[0], {0.6, 0, 0.8}};
  const auto said = [&](double above, double below) {
    return said_of_constants(one, true, [=](auto&, auto& i) { return i[2] < 0 ? below : above; });
  };
  const Said transmission = said(1, 2);
  EXPECT_EQ(transmission.words,
            "constant factor 2 missing from pdf() in transmission, not in reflection");
  EXPECT_EQ(transmission.kind, CauseKind::constant_per_hemisphere);
  EXPECT_EQ(said(1 / pi, 1).words,
            "constant factor 1/π missing from pdf() in reflection, not in transmission");
  EXPECT_EQ(said(1.7, 1 / 1.7).words,
            "the shares of the two sides are exchanged in pdf(): the density of the samples is 1.7 "
            "times as large in reflection, and 0.588235 times in transmission");
  EXPECT_EQ(said(3, 1.237).words,
            "constant factors missing from pdf(): 3 in reflection, 1.237 in transmission");
  EXPECT_LT(transmission.cost, said(1, 1.237).cost) << "a usual one is simpler";
}

TEST(Constants, ProbabilitiesOfTheSidesAreNamed) {
  const std::vector<Vec3> two = {kViews[0], {0.28, 0, 0.96}};
  const auto said = [&](const OfDirections& ratio) { return said_of_constants(two, true, ratio); };
  const auto f = [](const Vec3& o) { return o[2] > 0.9 ? 0.3 : 0.6; };
  const Said both = said([&](auto& o, auto& i) { return i[2] < 0 ? 1 - f(o) : f(o); });
  EXPECT_EQ(both.words,
            "the probability of reflection (here 0.6) and that of transmission are missing from "
            "pdf()");
  EXPECT_EQ(both.kind, CauseKind::lobe_probability);
  EXPECT_EQ(said([&](auto& o, auto& i) { return i[2] < 0 ? 1 : f(o); }).words,
            "the probability of reflection is wrong in, or missing from, pdf(): by 0.6 here");
  EXPECT_EQ(said([&](auto& o, auto& i) { return i[2] < 0 ? f(o) : 1; }).words,
            "the probability of transmission is wrong in, or missing from, pdf(): by 0.6 here");
}

/// Of which the masses tell: they add up to 1 with the constant that the ratios ask for.
TEST(Constants, OfRejectionAreNamedWhereTheMassesTell) {
  const auto named = [](double integral, double rejected, double ratio) {
    SeenRatios seen(bsdf_with(lobe), {kViews[0]}, even_directions(kRatiosPerView, false), 1,
                    RatioKind::density_over_pdf, [=](auto&, auto&) { return ratio; });
    seen.evidence().views[0].mass = MassSeen{integral, 1e-4, 0, rejected, 1e-4};
    // Ratios alone are judged here, and masses by what a constant is held to.
    const Observations o = Observations::of_density(seen.evidence());
    return simplest(o, constant_hypotheses(seen.evidence(), of_pdf(), o));
  };
  const Said kept = named(1, 0.2, 0.8);
  EXPECT_EQ(kept.words,
            "samples are rejected, up to 20 %, but pdf() is as large as if they were drawn again");
  EXPECT_EQ(kept.kind, CauseKind::not_rejected);
  const Said again = named(0.8, 0, 1.25);
  EXPECT_EQ(again.words,
            "samples that ought to be rejected are drawn again, and pdf() does not know: it lacks "
            "1/(accepted share), here 1.25");
  EXPECT_EQ(again.kind, CauseKind::not_rejected);
  // Twice drawn leaves 0.2² of them.
  EXPECT_EQ(named(0.8, 0.04, 1.2).kind, CauseKind::not_rejected);
  EXPECT_EQ(named(0.8, 0.1, 1.125).kind, CauseKind::constant);
}

// Fresnel's terms, of glass from both sides.

double dielectric(double cosine, double eta) {
  const double t2 = 1 - (1 - cosine * cosine) / (eta * eta);
  if (t2 <= 0) return 1;
  const double c = std::abs(cosine), t = std::sqrt(t2);
  return (std::pow((eta * c - t) / (eta * c + t), 2) + std::pow((c - eta * t) / (c + eta * t), 2)) /
         2;
}

TEST(Fresnel, TermsOfSidesAreNamed) {
  constexpr double kEta = 1.5;
  const auto woh = [](const Vec3& o, const Vec3& i) {
    const double a = o[2] < 0 && o[2] * i[2] < 0 ? kEta : 1;
    const double b = i[2] < 0 && o[2] * i[2] < 0 ? kEta : 1;
    return dot_of(o, unit({a * o[0] + b * i[0], a * o[1] + b * i[1], a * o[2] + b * i[2]}));
  };
  struct Cosine {
    const char* name;
    OfDirections value;
  };
  const Cosine cosines[] = {{"wo·h", woh},
                            {"cosθo", [](auto& o, auto&) { return o[2]; }},
                            {"cosθi", [](auto&, auto& i) { return i[2]; }}};
  struct Form {
    const char* words;
    double (*ratio)(double f, bool through);
  };
  const Form forms[] = {
      {"F of reflection and 1 − F of transmission are missing from pdf()",
       [](double f, bool t) { return t ? 1 - f : f; }},
      {"F and 1 − F choose the side, a half stands for either in pdf()",
       [](double f, bool t) { return t ? 2 * (1 - f) : 2 * f; }},
      {"F of reflection and 1 − F of transmission are exchanged in pdf()",
       [](double f, bool t) { return t ? (1 - f) / f : f / (1 - f); }},
      {"F of reflection is missing from pdf()", [](double f, bool t) { return t ? 1 : f; }},
      {"F of reflection is too many in pdf()", [](double f, bool t) { return t ? 1 : 1 / f; }},
      {"F of reflection stands for 1 − F of transmission in pdf()",
       [](double f, bool t) { return t ? (1 - f) / f : 1; }},
      {"1 − F of transmission is missing from pdf()",
       [](double f, bool t) { return t ? 1 - f : 1; }},
      {"1 − F of transmission is too many in pdf()",
       [](double f, bool t) { return t ? 1 / (1 - f) : 1; }},
      {"1 − F is missing from pdf()", [](double f, bool) { return 1 - f; }},
      {"1 − F is too many in pdf()", [](double f, bool) { return 1 / (1 - f); }}};
  const std::vector<Vec3> views = {{0.48, 0.36, 0.8}, {0.28, 0, -0.96}};
  const auto said = [&](const OfDirections& ratio) {
    SeenRatios seen(bsdf_with(lobe), views, even_directions(kRatiosPerView, true), kEta,
                    RatioKind::density_over_pdf, ratio);
    const Observations o = Observations::of_density(seen.evidence());
    std::vector<Hypothesis> list;
    add_fresnel(list, seen.evidence(), of_pdf());
    return simplest(o, list);
  };
  for (const Cosine& c : cosines) {
    for (const Form& form : forms) {
      const std::string sentence =
          form.words + std::string(" (Fresnel, of the index given, of ") + c.name + ")";
      EXPECT_EQ(said([&](auto& o, auto& i) {
                  const double eta = o[2] < 0 ? 1 / kEta : kEta;
                  return form.ratio(dielectric(c.value(o, i), eta), o[2] * i[2] < 0);
                }).words,
                sentence);
    }
    // Of laws with a number of their own.
    EXPECT_EQ(said([&](auto& o, auto& i) {
                return 1 - (0.1 + 0.9 * std::pow(1 - std::abs(c.value(o, i)), 5));
              }).words,
              "1 − F is missing from pdf() (Fresnel, Schlick, of " + std::string(c.name) + ")");
    EXPECT_EQ(said([&](auto& o, auto& i) { return 1 - dielectric(c.value(o, i), 1.4); }).words,
              "1 − F is missing from pdf() (Fresnel, dielectric, of " + std::string(c.name) + ")");
  }
  const auto of = [&](const Cosine& c, const Vec3& o, const Vec3& i) {
    return dielectric(c.value(o, i), o[2] < 0 ? 1 / kEta : kEta);
  };
  EXPECT_EQ(said([&](auto& o, auto& i) {
              const double f = of(cosines[1], o, i), g = of(cosines[0], o, i);
              return o[2] * i[2] < 0 ? (1 - f) / (1 - g) : f / g;
            }).words,
            "the side is chosen by F of cosθo, but pdf() has F of wo·h");
  EXPECT_EQ(said([&](auto& o, auto& i) {
              const double f = of(cosines[0], o, i), p = o[2] < 0 ? 0.3 : 0.6;
              return o[2] * i[2] < 0 ? (1 - p) / (1 - f) : p / f;
            }).words,
            "reflection is chosen with a probability (here 0.6) that is the same for all normals, "
            "but pdf() has F of wo·h");
}

}  // namespace
}  // namespace plumbline::verify
