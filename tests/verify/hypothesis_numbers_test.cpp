#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "correct_pairs.h"
#include "seen_ratios.h"

/// Terms with a free number are named with the number that they have: roughnesses, exponents,
/// widths; and what lies just outside of what a renderer would have is not named.
namespace plumbline::verify {
namespace {

using std::numbers::pi;

/// By the hypotheses that have a number; `widths`: by those of lobes' widths.
Said said_of(const OfDirections& ratio, bool widths = false) {
  SeenRatios seen(tilted_bsdf(), kViews, even_directions(kRatiosPerView, false), 1,
                  RatioKind::density_over_pdf, ratio);
  const Observations o = Observations::of_density(seen.evidence());
  return simplest(o, widths ? width_hypotheses(seen.evidence(), of_pdf())
                            : parametric_hypotheses(seen.evidence(), of_pdf(), o));
}

double smith(const Vec3& w, double alpha) { return RoughMirror{alpha}.masking(w); }
/// Height-correlated. @source Heitz 2014 (JCGT 3:2), Eq. 99
double correlated(const Vec3& wo, const Vec3& wi, double alpha) {
  return 1 / (1 / smith(wo, alpha) + 1 / smith(wi, alpha) - 1);
}
double normals(const Vec3& wo, const Vec3& wi, double alpha) {
  return RoughMirror{alpha}.distribution(half_vector(wo, wi));
}

TEST(Numbers, OfMaskingAreNamed) {
  struct Row {
    const char* name;
    OfDirections g;
  };
  const Row rows[] = {
      {"G1(wo)", [](auto& o, auto&) { return smith(o, 0.3); }},
      {"G1(wi)", [](auto&, auto& i) { return smith(i, 0.3); }},
      {"G1(wo) G1(wi)", [](auto& o, auto& i) { return smith(o, 0.3) * smith(i, 0.3); }},
      {"G1(wo)/G1(wi)", [](auto& o, auto& i) { return smith(o, 0.3) / smith(i, 0.3); }},
      {"G1 of both directions together", [](auto& o, auto& i) { return correlated(o, i, 0.3); }},
      {"the part of G beyond G1(wo)",
       [](auto& o, auto& i) { return correlated(o, i, 0.3) / smith(o, 0.3); }}};
  for (const Row& row : rows) {
    const Said said = said_of(row.g);
    EXPECT_EQ(said.words,
              "masking " + std::string(row.name) + " missing from pdf() (GGX, α = 0.3)");
    EXPECT_EQ(said.kind, CauseKind::masking);
    EXPECT_EQ(said_of([&](auto& o, auto& i) { return 1 / row.g(o, i); }).words,
              "masking " + std::string(row.name) + " too many in pdf() (GGX, α = 0.3)");
  }
  // Beyond the roughnesses that there are, it is another fault's shape.
  EXPECT_EQ(said_of([](auto& o, auto& i) { return smith(o, 1.5) * smith(i, 1.5); }).words, "");
}

TEST(Numbers, OfMaskingOfAnotherRoughnessAreNamed) {
  const auto words = [](const OfDirections& ratio) { return said_of(ratio).words; };
  const std::string other = "G1(wo) in pdf() is of another roughness, α = 0.5 for α = 0.2";
  EXPECT_EQ(words([](auto& o, auto&) { return smith(o, 0.2) / smith(o, 0.5); }), other);
  EXPECT_EQ(words([](auto&, auto& i) { return smith(i, 0.2) / smith(i, 0.5); }), other);
  EXPECT_EQ(words([](auto& o, auto& i) {
              return smith(o, 0.2) * smith(i, 0.2) / smith(o, 0.5) / smith(i, 0.5);
            }),
            other);
  EXPECT_EQ(words([](auto& o, auto& i) { return correlated(o, i, 0.2) / correlated(o, i, 0.5); }),
            "G of both directions in pdf() is of another roughness, α = 0.5 for α = 0.2");
}

TEST(Numbers, OfVisibleNormalsAreNamed) {
  const OfDirections visible = [](auto& o, auto& i) {
    const Vec3 h = half_vector(o, i);
    return smith(o, 0.3) * dot_of(o, h) / (o[2] * h[2]);
  };
  EXPECT_EQ(said_of(visible).words,
            "visible normals are sampled, but all normals are in pdf() (GGX, α = 0.3)");
  EXPECT_EQ(said_of([&](auto& o, auto& i) { return 1 / visible(o, i); }).words,
            "all normals are sampled, but visible ones are in pdf() (GGX, α = 0.3)");
}

TEST(Numbers, OfRoughnessAreNamed) {
  struct Row {
    const char* name;
    std::function<double(const Vec3& o, const Vec3& i, double alpha)> lobe;
  };
  const Row rows[] = {
      {"GGX", normals},
      {"GGX, visible normals",
       [](auto& o, auto& i, double a) { return normals(o, i, a) * smith(o, a); }},
      {"GGX with masking",
       [](auto& o, auto& i, double a) { return normals(o, i, a) * smith(o, a) * smith(i, a); }},
      {"GGX with correlated masking",
       [](auto& o, auto& i, double a) { return normals(o, i, a) * correlated(o, i, a); }},
      {"Beckmann",
       [](auto& o, auto& i, double a) {
         const double c2 = std::pow(half_vector(o, i)[2], 2);
         return std::exp((1 - 1 / c2) / (a * a)) / (pi * a * a * c2 * c2);
       }},
      // @source Burley 2012, Physically-based shading at Disney, Eq. 4
      {"GTR of exponent 1", [](auto& o, auto& i, double a) {
         const double c2 = std::pow(half_vector(o, i)[2], 2);
         return (a * a - 1) / (pi * std::log(a * a) * (1 + (a * a - 1) * c2));
       }}};
  const auto named = [](const Row& row, double right, double wrong) {
    return said_of([&](auto& o, auto& i) { return row.lobe(o, i, right) / row.lobe(o, i, wrong); });
  };
  const auto sentence = [](const Row& row, const char* wrong, const char* right) {
    return "the roughness in pdf() is another: α = " + std::string(wrong) + " there, α = " + right +
           " elsewhere (" + row.name + ")";
  };
  for (const Row& row : rows) {
    EXPECT_EQ(named(row, 0.3, 0.09).words, sentence(row, "0.09", "0.3"));
    EXPECT_EQ(named(row, 0.09, 0.3).words, sentence(row, "0.3", "0.09"));
    const Said two = named(row, 0.4, 0.5);
    EXPECT_EQ(two.words, sentence(row, "0.5", "0.4"));
    EXPECT_EQ(two.kind, CauseKind::roughness);
    EXPECT_GE(two.cost, 2 * kPerNumber);
    EXPECT_LT(named(row, 0.3, 0.09).cost, 2 * kPerNumber) << "squared is one number";
  }
  // Roughnesses that hardly differ, and one that none has.
  EXPECT_EQ(named(rows[0], 0.3, 0.302).words, "");
  EXPECT_EQ(named(rows[0], 0.3, 0.305).words, sentence(rows[0], "0.305", "0.3"));
  EXPECT_EQ(named(rows[0], 0.5, 1.1).words, "");
}

TEST(Numbers, OfExponentsAreNamed) {
  struct Row {
    const char* name;
    OfDirections cosine;
  };
  const Row rows[] = {{"cosθ", [](auto&, auto& i) { return i[2]; }},
                      {"cosθh", [](auto& o, auto& i) { return half_vector(o, i)[2]; }},
                      {"the cosine to wo", [](auto& o, auto& i) { return dot_of(o, i); }},
                      {"the cosine to the mirror direction",
                       [](auto& o, auto& i) { return o[2] * i[2] - o[0] * i[0] - o[1] * i[1]; }}};
  for (const Row& row : rows) {
    const Said said = said_of(
        [&](auto& o, auto& i) { return 1.5 * std::pow(std::max(0.0, row.cosine(o, i)), 2.25); });
    EXPECT_EQ(said.words, "the exponent of " + std::string(row.name) +
                              " in pdf() is off by -2.25, with a factor of 1.5");
    EXPECT_EQ(said.kind, CauseKind::roughness);
  }
}

TEST(Numbers, OfLobesAroundAnAxisAreNamed) {
  const auto named = [](const OfPoint& ratio) {
    SeenRatios seen(
        Domain::sphere(), [](const Vec3& x) { return 1 + 0.2 * x[0]; },
        even_directions(kRatiosPerView, true), ratio);
    const Observations o = Observations::of_density(seen.evidence());
    return simplest(o, parametric_hypotheses(seen.evidence(), of_pdf(), o));
  };
  // @source Henyey, Greenstein 1941
  const auto hg = [](double c, double g) {
    return (1 - g * g) / std::pow(1 + g * g - 2 * g * c, 1.5) / (4 * pi);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Said sign = named([&](auto& x) { return hg(x[axis], 0.5) / hg(x[axis], -0.5); });
    EXPECT_EQ(sign.words, "g has the other sign in pdf() (Henyey-Greenstein, g = 0.5)");
    EXPECT_EQ(sign.kind, CauseKind::mirrored);
    const Said width = named([&](auto& x) { return hg(x[axis], 0.6) / hg(x[axis], 0.25); });
    EXPECT_EQ(width.words, "g is 0.25 in pdf(), 0.6 in the samples (Henyey-Greenstein)");
    EXPECT_EQ(width.kind, CauseKind::roughness);
    EXPECT_EQ(named([&](auto& x) { return 0.5 * std::exp(1.5 * x[axis]); }).words,
              "the concentration in pdf() is off by -1.5 (exp(κ cosθ), with a factor of 0.5)");
  }
}

TEST(Numbers, AlongALineAreNamed) {
  const auto named = [](const OfPoint& ratio) {
    std::vector<Vec3> points;
    for (const Point2& p : even_points(kRatiosPerView)) points.push_back({1 + 3 * p[0], 0, 0});
    SeenRatios seen(
        Domain::interval(1, 4), [](const Vec3& x) { return 1 + 0.2 * x[0]; }, points, ratio);
    const Observations o = Observations::of_density(seen.evidence());
    return simplest(o, parametric_hypotheses(seen.evidence(), of_pdf(), o));
  };
  const Said rate = named([](auto& x) { return 2 * std::exp(-0.75 * x[0]); });
  EXPECT_EQ(rate.words, "the rate of the exponential in pdf() is off by -0.75, with a factor of 2");
  EXPECT_EQ(rate.kind, CauseKind::constant);
  const Said power = named([](auto& x) { return 2 * std::pow((x[0] - 1) / 3, 1.25); });
  EXPECT_EQ(power.words, "a power of x in pdf() is off by -1.25, with a factor of 2");
  EXPECT_EQ(power.kind, CauseKind::radius);
}

TEST(Widths, OfInclinationsToAFibreAreNamed) {
  struct Row {
    const char* name;
    std::function<double(double t)> shape;
  };
  const Row rows[] = {{"Gaussian", [](double t) { return std::exp(-t * t / 2); }},
                      {"logistic", [](double t) { return 1 / std::pow(std::cosh(t / 2), 2); }}};
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    for (const Row& row : rows) {
      const auto named = [&](double right, double wrong) {
        return said_of(
            [&](auto& o, auto& i) {
              const double t = std::asin(o[axis]) + std::asin(i[axis]);
              return 1.25 * row.shape(t / right) / row.shape(t / wrong);
            },
            true);
      };
      const auto sentence = [&](const char* wrong, const char* right) {
        return "the width of the lobe in the inclination to the fibre (along " +
               std::string(axis == 0 ? "x" : "y") + ") is " + wrong + " in pdf(), " + right +
               " in the samples (" + row.name + ")";
      };
      EXPECT_EQ(named(0.5, 0.25).words, sentence("0.25", "0.5"));
      EXPECT_EQ(named(0.25, 0.5).words, sentence("0.5", "0.25"));
      EXPECT_LT(named(0.25, 0.5).cost, 3 * kPerNumber);
      // Of a Gaussian any two widths with the same difference of 1/w² say the same.
      if (axis == 1 || row.name == std::string("Gaussian")) continue;
      EXPECT_EQ(named(0.3, 0.4).words, sentence("0.4", "0.3"));
    }
  }
}

TEST(Widths, OfConcentrationsAreNamed) {
  const auto tan2 = [](double c) { return (1 - c * c) / (c * c); };
  struct Row {
    const char* name;
    OfDirections exponent;
  };
  const Row rows[] = {
      {"exp(κ c), c the cosine to the mirror direction",
       [](auto& o, auto& i) { return o[2] * i[2] - o[0] * i[0] - o[1] * i[1]; }},
      {"exp(κ c), c the cosine to wo", [](auto& o, auto& i) { return dot_of(o, i); }},
      {"exp(κ c), c the cosine of the half vector",
       [](auto& o, auto& i) { return half_vector(o, i)[2]; }},
      {"exp(−κ tan²), of the half vector's angle",
       [&](auto& o, auto& i) { return -tan2(half_vector(o, i)[2]); }}};
  for (const Row& row : rows) {
    const Said said =
        said_of([&](auto& o, auto& i) { return 0.5 * std::exp(3.5 * row.exponent(o, i)); }, true);
    EXPECT_EQ(said.words, "the concentration in pdf() is off by -3.5 (" + std::string(row.name) +
                              ", with a factor of 0.5)");
    EXPECT_EQ(said.kind, CauseKind::roughness);
  }
}

struct Roughnesses {
  double x, y;
};

/// @source Heitz 2014 (JCGT 3:2), Eqs. 85, 86; Ward 1992 for the exponent of Beckmann's
double stretched_d(const Vec3& h, const Roughnesses& a) {
  const double s = std::pow(h[0] / a.x, 2) + std::pow(h[1] / a.y, 2) + h[2] * h[2];
  return 1 / (pi * a.x * a.y * s * s);
}
double stretched_g1(const Vec3& w, const Roughnesses& a) {
  const double t = (std::pow(a.x * w[0], 2) + std::pow(a.y * w[1], 2)) / (w[2] * w[2]);
  return 1 / (1 + (std::sqrt(1 + t) - 1) / 2);
}

TEST(Widths, OfTwoRoughnessesAreNamed) {
  struct Form {
    const char* name;
    std::function<double(const Vec3& o, const Vec3& i, const Roughnesses& a)> lobe;
  };
  const Form forms[] = {
      {"GGX", [](auto& o, auto& i, auto& a) { return stretched_d(half_vector(o, i), a); }},
      {"GGX, visible normals",
       [](auto& o, auto& i, auto& a) {
         return stretched_d(half_vector(o, i), a) * stretched_g1(o, a);
       }},
      {"GGX with correlated masking",
       [](auto& o, auto& i, auto& a) {
         return stretched_d(half_vector(o, i), a) /
                (1 / stretched_g1(o, a) + 1 / stretched_g1(i, a) - 1);
       }},
      {"Beckmann or Ward", [](auto& o, auto& i, auto& a) {
         const Vec3 h = half_vector(o, i);
         return std::exp(-(std::pow(h[0] / a.x, 2) + std::pow(h[1] / a.y, 2)) / (h[2] * h[2])) /
                (a.x * a.y);
       }}};
  struct Mistake {
    const char* words;
    Roughnesses wrong;
  };
  constexpr Roughnesses kRight{0.25, 0.5};
  const double mean = std::sqrt(0.125);
  const Mistake mistakes[] = {{"exchanged", {0.5, 0.25}},
                              {"squared", {0.0625, 0.25}},
                              {"taken the root of", {0.5, std::sqrt(0.5)}},
                              {"both that along x", {0.25, 0.25}},
                              {"both that along y", {0.5, 0.5}},
                              {"both their mean", {mean, mean}}};
  for (const Form& form : forms) {
    for (const Mistake& m : mistakes) {
      // Beckmann's exponents add up: exchanged, only 1/α_x² − 1/α_y² shows, and with one roughness
      // right the other may as well be squared, the first 1.
      const bool adds_up = form.name == std::string("Beckmann or Ward");
      const bool one_is_right = m.wrong.x == kRight.x || m.wrong.y == kRight.y;
      if (adds_up && (one_is_right || (m.wrong.x == kRight.y && m.wrong.y == kRight.x))) {
        continue;
      }
      const Said said = said_of(
          [&](auto& o, auto& i) { return form.lobe(o, i, kRight) / form.lobe(o, i, m.wrong); },
          true);
      EXPECT_EQ(said.words, "the roughnesses along x and y, 0.25 and 0.5, are " +
                                std::string(m.words) + " in pdf() (" + form.name + ")");
      EXPECT_EQ(said.kind, CauseKind::roughness);
    }
  }
  // As good as round.
  EXPECT_EQ(said_of(
                [&](auto& o, auto& i) {
                  return forms[0].lobe(o, i, {0.3, 0.302}) / forms[0].lobe(o, i, {0.302, 0.3});
                },
                true)
                .words,
            "");
}

}  // namespace
}  // namespace plumbline::verify
