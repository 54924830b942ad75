#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/verify/pair.h>

#include "diagnosis/shape.h"
#include "diagnosis/strays.h"
#include "seen_ratios.h"

/// Powers of random numbers, atoms beside a density, and samples where the pdf is 0.
namespace plumbline::verify {
namespace {

double even_density(const Vec3&) { return 1; }

/// Points that the numbers that lead there are known of: themselves.
Said said_of_numbers(const std::function<double(const Uniforms&)>& ratio) {
  std::vector<Vec3> points;
  for (const Point2& p : even_points(kRatiosPerView)) points.push_back({p[0], p[1], 0});
  SeenRatios seen(Domain::unit_square(), even_density, points, [&](const Vec3& x) {
    return ratio({x[0], x[1], 0});
  });
  for (RatioAt& p : seen.evidence().views[0].ratios[0].points) p.u = Uniforms{p.x[0], p.x[1], 0};
  return simplest(Observations::of_density(seen.evidence()),
                  number_hypotheses(seen.evidence(), of_pdf()));
}

TEST(RandomNumbers, OfAnotherPowerAreNamed) {
  // u in place of √u, squared: the density at u² is 1/(2u) of that at u.
  for (const std::size_t which : {std::size_t{0}, std::size_t{1}}) {
    for (const bool from_end : {false, true}) {
      const auto u = [=](const Uniforms& all) { return from_end ? 1 - all[which] : all[which]; };
      const std::string name = (from_end ? "1 − u" : "u") + std::string(which == 0 ? "₁" : "₂");
      const Said squared = said_of_numbers([&](auto& all) { return 1 / (2 * u(all)); });
      EXPECT_EQ(squared.words, "the root of " + name +
                                   " is missing from sample (or the number is squared): the "
                                   "density of the samples is 1/2 · 1/(" +
                                   name + ") times as large");
      EXPECT_EQ(squared.kind, CauseKind::radius);
      const Said root = said_of_numbers([&](auto& all) { return 2 * std::sqrt(u(all)); });
      EXPECT_EQ(root.words, "a root of " + name +
                                " too many in sample (or r missing from pdf()): the density of "
                                "the samples is 2 · (" +
                                name + ")^0.5 times as large");
      EXPECT_LT(squared.cost, root.cost);
      const Said cubed = said_of_numbers([&](auto& all) { return 1 / (3 * u(all) * u(all)); });
      EXPECT_EQ(cubed.words, "the root of " + name +
                                 " is missing from sample (or the number is squared): the density "
                                 "of the samples is 0.333333 · (" +
                                 name + ")^-2 times as large");
      EXPECT_GT(cubed.cost, squared.cost);
    }
  }
  EXPECT_EQ(said_of_numbers([](auto& all) { return std::pow(all[0], -0.25); }).words, "");
}

/// Of atoms with a mass of 0.3, and ratios beside them.
std::string said_of_atoms(double ratio, double atoms = 0.3) {
  SeenRatios seen(Domain::unit_square(), even_density, {kRatiosPerView, Vec3{0.5, 0.5, 0}},
                  [=](const Vec3&) { return ratio; });
  seen.evidence().views[0].mass = MassSeen{1 - atoms, 1e-4, atoms, 0, 0};
  const auto f = explain_atoms(seen.evidence(), Observations::of_density(seen.evidence()));
  return f ? std::string(to_string(f->kind)) + ": " + f->words : "";
}

TEST(Atoms, LeaveTheirProbabilityToTheRest) {
  const std::string kind = std::string(to_string(CauseKind::lobe_probability)) + ": ";
  EXPECT_EQ(
      said_of_atoms(0.7),
      kind + "1 − F, the probability that the atoms leave to the rest, is missing from pdf()");
  EXPECT_EQ(said_of_atoms(1 / 0.7),
            kind +
                "1 − F, the probability that the atoms leave to the rest, is there twice in "
                "pdf()");
  EXPECT_EQ(said_of_atoms(0.7 / 0.3),
            kind +
                "the rest has the probability of the atoms in pdf(), in place of what they "
                "leave to it");
  EXPECT_EQ(said_of_atoms(1), std::string(to_string(CauseKind::atom_as_density)) +
                                  ": the mass that atoms state is not the share of samples that "
                                  "they get");
  EXPECT_EQ(said_of_atoms(0.8), "");
  EXPECT_EQ(said_of_atoms(1, 0), "") << "there are none";
}

/// Samples where the pdf is 0, of all a share; the others have this ratio.
std::string said_of_strays(const Domain& domain, const std::vector<Vec3>& strays, double share,
                           double ratio, std::optional<Vec3> wo = {}) {
  std::vector<Vec3> points;
  for (const Point2& p : even_points(kRatiosPerView))
    points.push_back(domain.chart().from_square(p));
  const auto outside = [&](const Vec3& x) { return domain.directions() ? x[2] < 0 : x[0] > 1; };
  SeenRatios seen(
      domain, [=](const Vec3& x) { return outside(x) ? 0.0 : 1.0; }, points,
      [=](const Vec3&) { return ratio; });
  ViewEvidence& view = seen.evidence().views[0];
  view.strays = strays;
  view.stray_share = share;
  view.wo = wo;
  const auto cause = explain_strays(seen.evidence(), Observations::of_density(seen.evidence()));
  return cause ? std::string(to_string(cause->kind)) + ": " + cause->headline : "";
}

TEST(Strays, AreNamedByWhereTheyLie) {
  const std::vector<Vec3> below(100, Vec3{0.6, 0, -0.8}), beside(100, Vec3{1.5, 0.5, 0}),
      inside(100, Vec3{0.5, 0.5, 0});
  const std::string not_rejected = std::string(to_string(CauseKind::not_rejected)) + ": ",
                    support = std::string(to_string(CauseKind::support)) + ": ";
  const Domain above = Domain::hemisphere(), square = Domain::unit_square();
  EXPECT_EQ(said_of_strays(above, below, 0.25, 1),
            not_rejected +
                "samples below the horizon are not rejected: up to 25 % of the samples "
                "lie where pdf() is 0, and the rest are as dense as it says");
  EXPECT_EQ(said_of_strays(above, below, 0.25, 1, Vec3{0, 0, 1}).substr(0, not_rejected.size()),
            not_rejected);
  // More than ever fall below a horizon, or above it.
  EXPECT_EQ(
      said_of_strays(above, below, 0.65, 1),
      support + "the support of pdf() is too small: up to 65 % of the samples lie outside it");
  EXPECT_EQ(
      said_of_strays(above, {100, Vec3{0.6, 0, 0.8}}, 0.25, 1),
      support + "the support of pdf() is too small: up to 25 % of the samples lie outside it");
  // Beside the domain: those inside are thinner by that share, or by another.
  EXPECT_EQ(said_of_strays(square, beside, 0.25, 0.75),
            not_rejected +
                "25 % of the samples lie outside the domain, and those inside are "
                "thinner by that share: they ought to be folded back or rejected");
  EXPECT_EQ(said_of_strays(square, beside, 0.25, 0.5),
            support + "25 % of the samples lie outside the domain");
  EXPECT_EQ(said_of_strays(square, inside, 0.25, 0.75), "");
  // All of them, or none.
  EXPECT_EQ(said_of_strays(above, below, 0.99, 1), "");
  EXPECT_EQ(said_of_strays(above, {}, 0, 1), "");
}

TEST(Strays, AllRejectedIsAllButOneInTenThousand) {
  const auto rejected = [](double share, bool failed) {
    ReportEvidence evidence;
    evidence.views.emplace_back().mass = MassSeen{0, 0, 0, share, 0};
    evidence.views[0].failed = failed;
    return all_rejected(evidence);
  };
  EXPECT_TRUE(rejected(1, true));
  EXPECT_FALSE(rejected(1, false));
  EXPECT_FALSE(rejected(0.9998, true));
}

/// The likely cause of a choice among five things.
std::string cause_of_choice(const std::function<int(double)>& choose,
                            const std::function<double(int)>& pmf) {
  const Report report = check_pair(sampling_pair<int>(
      "choice", Domain::discrete(5), [choose](double u) { return choose(u); },
      [pmf](int i) { return pmf(i); }));
  EXPECT_FALSE(report.ok());
  const std::string summary = report.summary();
  const std::size_t begin = summary.find("likely cause: ");
  return begin == std::string::npos ? summary
                                    : summary.substr(begin, summary.find('\n', begin) - begin);
}

TEST(Choices, OfWhatIsNotThereOrNeverChosenAreNamed) {
  const auto fifth = [](int) { return 0.2; };
  EXPECT_NE(cause_of_choice([](double u) { return static_cast<int>(5 * u) - 1; }, fifth)
                .find("% of the samples name what is not there, as -1 of 5 from 0 on"),
            std::string::npos);
  EXPECT_NE(cause_of_choice([](double u) { return static_cast<int>(6 * u); }, fifth)
                .find("% of the samples name what is not there, as 5 of 5 from 0 on"),
            std::string::npos);
  EXPECT_EQ(
      cause_of_choice([](double u) { return static_cast<int>(4 * u); }, fifth),
      "likely cause: item 4 of 5 is never chosen, the others in proportion: an index too few?");
  EXPECT_EQ(cause_of_choice([](double u) { return static_cast<int>(5 * u); },
                            [](int i) { return i == 2 ? std::nan("") : 0.2; }),
            "likely cause: pdf() is nan in 20 % of the domain");
}

TEST(Atoms, OfAMassThatIsNoneFail) {
  for (const double mass : {std::nan(""), -1.0}) {
    SamplingPair pair;
    pair.name = "mass";
    pair.domain = Domain::unit_square();
    pair.pdf = even_density;
    pair.sample = [mass](const Uniforms& u) -> std::optional<SampleRecord> {
      SampleRecord record{{u[0], u[1], 0}, {}, {}};
      record.mass = mass;
      return record;
    };
    const Report report = check_pair(pair);
    EXPECT_NE(report.summary().find("an atom has mass "), std::string::npos) << report.summary();
  }
}

TEST(Shifts, OfAnEvenDensityAreNoCause) {
  // Half of the square is rejected: moved samples would explain nothing of it.
  const Report report = check_pair(sampling_pair<Point2>(
      "half", Domain::unit_square(),
      [](double u, double v) -> std::optional<Point2> {
        if (u < 0.5) return std::nullopt;
        return Point2{u, v};
      },
      [](const Point2&) { return 1.0; }));
  EXPECT_EQ(report.verdict(), Verdict::fail);
  EXPECT_EQ(report.summary().find("moved"), std::string::npos) << report.summary();
}

}  // namespace
}  // namespace plumbline::verify
