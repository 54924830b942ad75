#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "correct_pairs.h"
#include "seen_ratios.h"

/// Each factor that may be lost is named for what it is, with its power; one that is not of the
/// list is not named.
namespace plumbline::verify {
namespace {

using std::numbers::pi;

double o_dot_h(const Vec3& wo, const Vec3& wi) { return dot_of(wo, half_vector(wo, wi)); }
double cos_of_half(const Vec3& wo, const Vec3& wi) { return half_vector(wo, wi)[2]; }

Said said_of_reflection(const OfDirections& ratio) {
  SeenRatios seen(tilted_bsdf(), kViews, even_directions(kRatiosPerView, false), 1,
                  RatioKind::density_over_pdf, ratio);
  const Observations observations = Observations::of_density(seen.evidence());
  return simplest(observations, factor_hypotheses(seen.evidence(), of_pdf(), observations));
}

std::string lacks(const std::string& factor, const std::string& times) {
  return "factor " + factor + " missing from pdf(): the density of the samples is " + times +
         " times as large";
}
std::string has_too_many(const std::string& factor, const std::string& times) {
  return "factor " + factor + " too many in pdf(): the density of the samples is " + times +
         " times as large";
}

struct NamedFactor {
  const char* name;
  CauseKind kind;
  OfDirections value;
};

std::vector<NamedFactor> of_reflection() {
  using K = CauseKind;
  const auto sin_h = [](auto& o, auto& i) { return std::sqrt(1 - std::pow(cos_of_half(o, i), 2)); };
  return {{"cosθi", K::cosine, [](auto&, auto& i) { return i[2]; }},
          {"sinθ", K::sine, [](auto&, auto& i) { return std::sqrt(1 - i[2] * i[2]); }},
          {"cosine of the inclination to the fibre (sinθ from the y axis)", K::cosine,
           [](auto&, auto& i) { return std::sqrt(1 - i[1] * i[1]); }},
          {"cosine of the inclination to the fibre (sinθ from the x axis)", K::cosine,
           [](auto&, auto& i) { return std::sqrt(1 - i[0] * i[0]); }},
          {"cosθo", K::cosine, [](auto& o, auto&) { return o[2]; }},
          {"4 (wo·h)", K::half_vector_jacobian, [](auto& o, auto& i) { return 4 * o_dot_h(o, i); }},
          {"(wo·h)", K::half_vector_jacobian, [](auto& o, auto& i) { return o_dot_h(o, i); }},
          {"cosθh", K::cosine, [](auto& o, auto& i) { return cos_of_half(o, i); }},
          {"cos³θh", K::cosine, [](auto& o, auto& i) { return std::pow(cos_of_half(o, i), 3); }},
          {"cos⁴θh", K::cosine, [](auto& o, auto& i) { return std::pow(cos_of_half(o, i), 4); }},
          {"sinθh", K::sine, sin_h}};
}

TEST(Factors, OfReflectionAreNamed) {
  for (const NamedFactor& f : of_reflection()) {
    const Said said = said_of_reflection(f.value);
    EXPECT_EQ(said.kind, f.kind) << f.name;
    EXPECT_EQ(said.words, lacks(f.name, f.name));
  }
}

TEST(Factors, AreNamedWithTheirPower) {
  const auto power = [](double p) {
    return said_of_reflection([p](auto&, auto& i) { return std::pow(i[2], p); }).words;
  };
  EXPECT_EQ(power(-1), has_too_many("cosθi", "1/cosθi"));
  EXPECT_EQ(power(2), lacks("cosθi²", "cosθi²"));
  EXPECT_EQ(power(-2), has_too_many("cosθi²", "1/cosθi²"));
  EXPECT_EQ(power(0.5), lacks("√cosθi", "√cosθi"));
  EXPECT_EQ(power(-0.5), has_too_many("√cosθi", "1/√cosθi"));
  EXPECT_EQ(power(1.5), "");
  // A name of several words is put into brackets.
  const auto of_fibre = [](double p) {
    return said_of_reflection([p](auto&, auto& i) { return std::pow(1 - i[1] * i[1], p / 2); })
        .words;
  };
  const std::string fibre = "cosine of the inclination to the fibre (sinθ from the y axis)";
  EXPECT_EQ(of_fibre(-1), has_too_many(fibre, "1/(" + fibre + ")"));
  EXPECT_EQ(of_fibre(2), lacks("(" + fibre + ")²", "(" + fibre + ")²"));
  EXPECT_EQ(said_of_reflection([](auto& o, auto& i) { return 1 / (4 * o_dot_h(o, i)); }).words,
            "the half-vector Jacobian 1/(4 wo·h) is missing from pdf(): the density of the samples "
            "is 1/(4 (wo·h)) times as large");
}

TEST(Factors, StandBesideAConstant) {
  const auto times = [](double c) {
    return said_of_reflection([c](auto&, auto& i) { return c * i[2]; }).words;
  };
  EXPECT_EQ(times(1 / pi), lacks("cosθi", "1/π · cosθi"));
  EXPECT_EQ(times(1.237), lacks("cosθi", "1.237 · cosθi"));
  // Of a usual constant's price, one is simpler than two factors; any other is not.
  EXPECT_LT(said_of_reflection([](auto&, auto& i) { return 2 * i[2]; }).cost, 10);
  EXPECT_GT(said_of_reflection([](auto&, auto& i) { return 1.237 * i[2]; }).cost, kPerNumber);
}

TEST(Factors, TwoAreNamedTogether) {
  const Said said = said_of_reflection([](auto& o, auto& i) { return i[2] / cos_of_half(o, i); });
  EXPECT_EQ(said.words,
            "factor cosθi missing from pdf(), and factor cosθh too many in pdf(): the density of "
            "the samples is cosθi · 1/cosθh times as large");
  EXPECT_EQ(said.kind, CauseKind::cosine);
  // With the half vector's Jacobian it is that which was forgotten, and the cosine with it.
  const Said jacobian =
      said_of_reflection([](auto& o, auto& i) { return cos_of_half(o, i) / (4 * o_dot_h(o, i)); });
  EXPECT_EQ(jacobian.kind, CauseKind::half_vector_jacobian) << jacobian.words;
  EXPECT_EQ(said_of_reflection([](auto& o, auto& i) { return 1 + 0.1 * o[2] * i[1]; }).words, "");
}

// Of glass, seen from both sides.

constexpr double kGlass = 1.5;

struct Refraction {
  double oh, ih, eta_o, eta_i;

  /// @source Walter et al. 2007, Eq. 17
  double jacobian() const {
    return eta_i * eta_i * std::abs(ih) / std::pow(eta_o * oh + eta_i * ih, 2);
  }
};

Refraction refraction_of(const Vec3& wo, const Vec3& wi) {
  const double o = wo[2] < 0 ? kGlass : 1, i = wi[2] < 0 ? kGlass : 1;
  const Vec3 h{o * wo[0] + i * wi[0], o * wo[1] + i * wi[1], o * wo[2] + i * wi[2]};
  const double l = std::sqrt(dot_of(h, h));
  return {dot_of(wo, h) / l, dot_of(wi, h) / l, o, i};
}

Said said_of_glass(const OfDirections& ratio) {
  SeenRatios seen(tilted_bsdf(), {kViews[0], {0.6, 0, -0.8}}, even_directions(kRatiosPerView, true),
                  kGlass, RatioKind::density_over_pdf, ratio);
  const Observations observations = Observations::of_density(seen.evidence());
  return simplest(observations, factor_hypotheses(seen.evidence(), of_pdf(), observations));
}

bool goes_through(const Vec3& wo, const Vec3& wi) { return wo[2] * wi[2] < 0; }

TEST(Factors, OfOneSideAreNamed) {
  EXPECT_EQ(
      said_of_glass([](auto& o, auto& i) { return goes_through(o, i) ? 1 : std::abs(i[2]); }).words,
      lacks("cosθi in reflection", "cosθi in reflection"));
  EXPECT_EQ(
      said_of_glass([](auto& o, auto& i) { return goes_through(o, i) ? std::abs(i[2]) : 1; }).words,
      lacks("cosθi in transmission", "cosθi in transmission"));
  EXPECT_EQ(said_of_glass([](auto&, auto& i) { return std::abs(i[2]); }).words,
            lacks("cosθi", "cosθi"));
}

TEST(Factors, OfARefractionAreNamed) {
  struct Row {
    const char* name;
    std::function<double(const Refraction&, const Vec3& wi)> value;  // beside reflection's 1
  };
  const Row rows[] = {
      {"dω_h/dω_i of the refraction", [](auto& r, auto&) { return r.jacobian(); }},
      {"dω_h/dω_i with η the right way up (η_i² and η_o² exchanged)",
       [](auto& r, auto&) {
         return r.jacobian() / Refraction{r.oh, r.ih, r.eta_i, r.eta_o}.jacobian();
       }},
      {"η_i²/η_o²", [](auto& r, auto&) { return std::pow(r.eta_i / r.eta_o, 2); }},
      {"η_i² of dω_h/dω_i", [](auto& r, auto&) { return r.eta_i * r.eta_i; }},
      {"|wi·h| of dω_h/dω_i in place of |wo·h|",
       [](auto& r, auto&) { return std::abs(r.ih / r.oh); }},
      {"|wi·h| of dω_h/dω_i", [](auto& r, auto&) { return std::abs(r.ih); }},
      {"|wi·h|/|cosθi| of dω_h/dω_i", [](auto& r, auto& wi) { return std::abs(r.ih / wi[2]); }},
      {"dω_h/dω_i of a refraction in place of the 1/(4 wo·h) of a reflection",
       [](auto& r, auto&) { return r.jacobian() * 4 * std::abs(r.oh); }}};
  for (const Row& row : rows) {
    const Said said = said_of_glass([&](auto& o, auto& i) {
      return goes_through(o, i) ? row.value(refraction_of(o, i), i) : 1.0;
    });
    EXPECT_EQ(said.words, lacks(row.name, row.name));
    EXPECT_EQ(said.kind, row.name == std::string("η_i²/η_o²") ? CauseKind::eta_squared
                                                              : CauseKind::refraction_jacobian);
  }
}

// Of points.

Said said_of_points_times(const Domain& domain, const OfPoint& ratio) {
  std::vector<Vec3> points;
  for (const Point2& p : even_points(kRatiosPerView))
    points.push_back(domain.chart().from_square(p));
  SeenRatios seen(
      domain, [](const Vec3& x) { return 1 + 0.2 * x[0]; }, points, ratio);
  const Observations observations = Observations::of_density(seen.evidence());
  return simplest(observations, factor_hypotheses(seen.evidence(), of_pdf(), observations));
}

TEST(Factors, OfPointsAreNamed) {
  struct Row {
    Domain domain;
    CauseKind kind;
    const char* words;
    OfPoint ratio;
  };
  using K = CauseKind;
  const Domain disk = Domain::disk(2), triangle = Domain::triangle(), line = Domain::interval(1, 4),
               square = Domain::unit_square();
  const Row rows[] = {
      {disk, K::radius, "factor r (a root of a random number) missing from pdf()",
       [](auto& x) { return std::hypot(x[0], x[1]) / 2; }},
      {triangle, K::radius, "factor x + y (the root of a random number) missing from pdf()",
       [](auto& x) { return x[0] + x[1]; }},
      {triangle, K::radius, "factor x missing from pdf()", [](auto& x) { return x[0]; }},
      {triangle, K::radius, "factor y missing from pdf()", [](auto& x) { return x[1]; }},
      {triangle, K::radius, "factor 1 − x missing from pdf()", [](auto& x) { return 1 - x[0]; }},
      {triangle, K::radius, "factor 1 − y missing from pdf()", [](auto& x) { return 1 - x[1]; }},
      {triangle, K::radius, "factor 1 − x − y missing from pdf()",
       [](auto& x) { return 1 - x[0] - x[1]; }},
      {line, K::radius, "factor x missing from pdf()", [](auto& x) { return (x[0] - 1) / 3; }},
      {line, K::radius, "factor 1 − x missing from pdf()", [](auto& x) { return (4 - x[0]) / 3; }},
      {line, K::constant, "1/length is missing from pdf()", [](auto&) { return 1 / 3.0; }},
      {line, K::constant, "factor length missing from pdf()", [](auto&) { return 3; }},
      {line, K::distance_or_area,
       "the length is divided by where it should be multiplied by, in "
       "pdf()",
       [](auto&) { return 9; }},
      {line, K::distance_or_area,
       "the length is multiplied by where it should be divided by, in "
       "pdf()",
       [](auto&) { return 1 / 9.0; }},
      {disk, K::constant, "1/area is missing from pdf()", [](auto&) { return 1 / (4 * pi); }},
      {square, K::radius, "factor the first coordinate missing from pdf()",
       [](auto& x) { return x[0]; }},
      {square, K::radius, "factor the second coordinate missing from pdf()",
       [](auto& x) { return x[1]; }},
      {square, K::radius, "factor 1 − the first coordinate missing from pdf()",
       [](auto& x) { return 1 - x[0]; }},
      {square, K::radius, "factor 1 − the second coordinate missing from pdf()",
       [](auto& x) { return 1 - x[1]; }},
      {square, K::none, "", [](auto&) { return 2; }}};
  for (const Row& row : rows) {
    const Said said = said_of_points_times(row.domain, row.ratio);
    EXPECT_EQ(said.words.substr(0, said.words.find(':')), row.words);
    EXPECT_EQ(said.kind, row.kind) << row.words;
  }
}

TEST(Factors, OfDirectionsWithoutASurfaceAreNamed) {
  const auto name = [](const OfPoint& ratio) {
    SeenRatios seen(
        Domain::sphere(), [](const Vec3& x) { return 1 + 0.2 * x[0]; },
        even_directions(kRatiosPerView, true), ratio);
    const Observations o = Observations::of_density(seen.evidence());
    const Said said = simplest(o, factor_hypotheses(seen.evidence(), of_pdf(), o));
    return std::string(to_string(said.kind)) + ": " + said.words;
  };
  EXPECT_EQ(name([](auto& x) { return std::abs(x[2]); }), "cosine: " + lacks("cosθ", "cosθ"));
  EXPECT_EQ(name([](auto& x) { return std::abs(x[0]); }),
            "cosine: " + lacks("cosθ from the x axis", "cosθ from the x axis"));
  EXPECT_EQ(name([](auto& x) { return std::abs(x[1]); }),
            "cosine: " + lacks("cosθ from the y axis", "cosθ from the y axis"));
  EXPECT_EQ(name([](auto& x) { return std::sqrt(1 - x[1] * x[1]); }),
            "sine: " + lacks("sinθ from the y axis", "sinθ from the y axis"));
  EXPECT_EQ(name([](auto& x) { return std::sqrt(1 - x[0] * x[0]); }),
            "sine: " + lacks("sinθ from the x axis", "sinθ from the x axis"));
}

TEST(Factors, ThatAUserSuspectsAreNamedFirst) {
  SeenRatios seen(
      Domain::sphere(), [](const Vec3& x) { return 1 + 0.2 * x[0]; },
      even_directions(kRatiosPerView, true), [](const Vec3& x) { return std::abs(x[2]); });
  seen.pair().suspects = {{"my cosine", [](const Vec3& x) { return std::abs(x[2]); }}};
  const Observations o = Observations::of_density(seen.evidence());
  EXPECT_EQ(simplest(o, factor_hypotheses(seen.evidence(), of_pdf(), o)).words,
            lacks("my cosine", "my cosine"));
}

}  // namespace
}  // namespace plumbline::verify
