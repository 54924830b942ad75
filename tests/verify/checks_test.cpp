#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/dependent.h>
#include <plumbline/verify/joint.h>
#include <plumbline/verify/pair.h>
#include <plumbline/verify/stochastic.h>

#include "bsdfs/bsdf_checks.h"
#include "correct_pairs.h"
#include "dependent/point_sets.h"
#include "joint_pairs.h"
#include "judged_pair.h"
#include "lattice.h"
#include "pairs/batches.h"
#include "pairs/jacobian.h"

/// Numbers and sentences of the checks of pairs and BSDFs, of pairs so simple that they are known.
namespace plumbline::verify {
namespace {

using Drawn = std::optional<SampleRecord>;

Drawn on_line(double x) { return SampleRecord{{x, 0, 0}, {}, {}}; }

/// x = √u: density 2x.
SamplingPair ramp() {
  SamplingPair pair;
  pair.name = "ramp";
  pair.domain = Domain::interval(0, 1);
  pair.numbers = 1;
  pair.sample = [](const Uniforms& u) { return on_line(std::sqrt(u[0])); };
  pair.pdf = [](const Vec3& x) { return 2 * x[0]; };
  return pair;
}

ContractOptions quick() {
  ContractOptions o;
  o.points = 500;
  o.jacobian_points = 200;
  o.evaluations = 20'000;
  o.first_look = o.samples = 20'000;
  o.finest_bins = 64;
  o.deviation = 0.2;
  return o;
}

TEST(Battery, LeavesWhatItHasSeen) {
  const SamplingPair pair = ramp();
  const ViewEvidence seen = judge_pair(pair, quick()).view;
  EXPECT_FALSE(seen.failed);
  EXPECT_EQ(seen.samples, 20'000);
  double observed = 0, expected = 0, measure = 0;
  for (const BinSeen& bin : seen.bins) {
    observed += bin.observed;
    expected += bin.expected;
    double shares = 0;
    for (std::size_t i = 0; i < bin.nodes.size(); ++i) {
      shares += bin.shares[i];
      measure += bin.measures[i];
    }
    EXPECT_NEAR(shares, 1, 1e-12);
    // Of √10,000 some seven.
    EXPECT_NEAR(bin.observed, bin.expected, 7 * std::sqrt(bin.expected));
  }
  EXPECT_EQ(observed, 20'000);
  EXPECT_NEAR(expected, 20'000, 1);
  EXPECT_NEAR(measure, 1, 1e-9);
  SamplingPair wrong = pair;
  wrong.pdf = [](const Vec3& x) { return 3 * x[0] * x[0]; };
  EXPECT_TRUE(judge_pair(wrong, quick()).view.failed);
}

TEST(Integral, HasABoundOfItsErrorAndWhatIsUnknown) {
  const CheckResult r = check_integral(ramp(), quick());
  EXPECT_EQ(r.verdict, Verdict::pass);
  EXPECT_NEAR(*r.bound, std::abs(*r.estimate - 1) + (r.interval->high - r.interval->low) / 2,
              1e-15);
  // What rounding does to 2x is about a rounding of x.
  EXPECT_GT(*r.figure(Figure::rounding), 1e-17);
  EXPECT_LT(*r.figure(Figure::rounding), 1e-14);
  EXPECT_EQ(*r.tolerance, 5e-5 + *r.figure(Figure::rounding));
  // In stripes that no cells resolve, three times as dense in every other one.
  constexpr double kStripes = 5000;
  SamplingPair stripes = ramp();
  stripes.sample = [](const Uniforms& u) {
    const double k = std::floor(kStripes * u[0]), v = kStripes * u[0] - k;
    return on_line((k + (v < 0.75 ? v / 1.5 : 0.5 + (v - 0.75) / 0.5)) / kStripes);
  };
  stripes.pdf = [](const Vec3& x) {
    return kStripes * x[0] - std::floor(kStripes * x[0]) < 0.5 ? 1.5 : 0.5;
  };
  ContractOptions strict = quick();
  strict.mass_tolerance = 1e-9;
  const CheckResult unknown = check_integral(stripes, strict);
  EXPECT_EQ(unknown.verdict, Verdict::inconclusive);
  EXPECT_EQ(unknown.reason.find("the sum is known to "), 0u) << unknown.reason;
}

TEST(JointIntegral, IsHeldToTheToleranceThatIsStated) {
  JointPair pair = joint_pairs::roots();
  pair.epsilon = 0x1p-24;
  pair.pdf = [](const JointPoint& x) { return 4.03 * x[0][0] * x[1][0]; };
  ContractOptions o = quick();
  o.mass_tolerance = 0.02;
  const CheckResult r = check_integral(pair, o);
  const double rounding = *r.figure(Figure::rounding);
  EXPECT_GT(rounding, 0x1p-26);
  EXPECT_LT(rounding, 0x1p-20);
  EXPECT_EQ(*r.tolerance, 0.02 + rounding);
}

/// Clamped to a value, or rounded to about one.
TEST(ChiSquare, SaysHowManySamplesLieInAPoint) {
  for (const double about : {0.0, 1e-14}) {
    SamplingPair clamped = ramp();
    clamped.sample = [about](const Uniforms& u) {
      return on_line(u[0] < 0.25 ? 0.5 + about * u[0] : std::sqrt(u[0]));
    };
    const CheckResult r = check_chi_square(clamped, quick());
    EXPECT_EQ(r.verdict, Verdict::fail);
    const std::size_t says = r.reason.find("% of the samples lie on a line or in a point");
    ASSERT_NE(says, std::string::npos) << about << ": " << r.reason;
    // A quarter of them, less the bins at its ends, of 64.
    const double share = std::stod(r.reason.substr(r.reason.rfind("at least ", says) + 9));
    EXPECT_GT(share, 100 * (0.25 - 3 / 64.0));
    EXPECT_LT(share, 100 * (0.25 + 1 / 64.0));
  }
  SamplingPair wrong = ramp();
  wrong.pdf = [](const Vec3& x) { return 3 * x[0] * x[0]; };
  EXPECT_EQ(check_chi_square(wrong, quick()).reason.find("lie on a line"), std::string::npos);
}

const CheckResult& of_kind(const Report& report, CheckKind kind) {
  for (const CheckResult& r : report) {
    if (r.kind == kind) return r;
  }
  throw std::logic_error("no such check");
}

TEST(Pointwise, SamplesOutsideAreNotThoseThatAreNotFinite) {
  const auto judged = [](double beyond) {
    SamplingPair pair = ramp();
    pair.sample = [beyond](const Uniforms& u) {
      return on_line(u[0] > 0.9 ? beyond : std::sqrt(u[0]));
    };
    return check_pointwise(pair, quick());
  };
  const Report outside = judged(1.5), not_finite = judged(std::numeric_limits<double>::infinity());
  EXPECT_EQ(of_kind(outside, CheckKind::finite).verdict, Verdict::pass);
  EXPECT_EQ(of_kind(outside, CheckKind::support).verdict, Verdict::fail);
  EXPECT_NE(of_kind(outside, CheckKind::support).reason.find("sample outside the domain"),
            std::string::npos);
  EXPECT_EQ(of_kind(not_finite, CheckKind::finite).verdict, Verdict::fail);
  EXPECT_NE(of_kind(not_finite, CheckKind::support).verdict, Verdict::fail);
}

/// x = (2u − 1)²: two ways to each point, with 1/(4√x) each.
TEST(Jacobian, AddsUpTheWaysThatItFinds) {
  SamplingPair fold = ramp();
  fold.sample = [](const Uniforms& u) { return on_line(std::pow(2 * u[0] - 1, 2)); };
  fold.pdf = [](const Vec3& x) { return 1 / (2 * std::sqrt(x[0])); };
  const CheckResult r = check_jacobian(fold, quick());
  EXPECT_EQ(r.verdict, Verdict::pass) << r.reason;
  EXPECT_EQ(r.leaned_on, "convergence of the differences, branches found by a search");
  EXPECT_LT(*r.estimate, 1e-4) << "of single ways it would be a half";
}

/// Of a mixture: of each lobe against its own pdf, and of the whole against the sum.
TEST(Jacobian, KeepsRatiosOfLobesAndOfTheWholeApart) {
  SamplingPair pair = ramp();
  const auto flat = [](const Vec3&) { return 1.0; };
  const auto rising = [](const Vec3& x) { return 2 * x[0]; };
  pair.numbers = 2;
  pair.sample = [](const Uniforms& u) { return on_line(u[1] < 0.25 ? u[0] : std::sqrt(u[0])); };
  pair.pdf = [](const Vec3& x) { return 0.25 + 0.75 * 2 * x[0]; };
  pair.lobes = {
      {"flat", 0.25, [](const Uniforms& u) { return on_line(u[0]); }, flat},
      {"rising", 0.75, [](const Uniforms& u) { return on_line(std::sqrt(u[0])); }, rising}};
  const JacobianOutcome outcome = judge_jacobian(pair, quick());
  EXPECT_EQ(outcome.result.verdict, Verdict::pass) << outcome.result.reason;
  std::size_t of_lobes = 0, of_whole = 0;
  for (const RatioSeries& series : outcome.ratios) {
    for (const RatioAt& p : series.points) {
      const bool of_lobe = series.kind == RatioKind::lobe_density_over_pdf;
      EXPECT_EQ(p.lobe >= 0, of_lobe);
      EXPECT_NEAR(p.ratio, 1, 1e-4);
      (of_lobe ? of_lobes : of_whole) += 1;
    }
  }
  EXPECT_GT(of_lobes, 100u);
  EXPECT_GT(of_whole, 100u);
}

/// f·|cosθ| is the same, asked one by one and in spans.
TEST(BsdfPairs, AreWeighedByTheCosine) {
  const SamplingPair pair = bsdf_pair("diffuse", erased(Diffuse{}), {0, 0.6, 0.8}, {});
  const std::vector<Vec3> wi = even_directions(20, false);
  const std::vector<Channels> many = ask(pair.value, wi);
  for (std::size_t i = 0; i < wi.size(); ++i) {
    EXPECT_NEAR(many[i][0], wi[i][2] / std::numbers::pi, 1e-15);
    EXPECT_EQ(many[i], pair.value(wi[i]));
  }
}

/// However dim or bright f is as a whole, what is small beside its peak alone is left aside.
TEST(Reciprocity, DoesNotDependOnTheUnit) {
  for (const double unit : {1e-30, 1.0, 1e30}) {
    const auto judged = [unit](double skew) {
      ErasedBsdf b = erased(Diffuse{});
      b.eval = [=](const Vec3& wo, const Vec3& wi) {
        return gray(Diffuse::eval(wo, wi) * unit * (1 + skew * wi[2]));
      };
      BsdfOptions o;
      o.contract = quick();
      o.back = false;
      return check_reciprocity("skewed", b, o);
    };
    EXPECT_EQ(judged(0).verdict, Verdict::pass) << unit;
    EXPECT_EQ(judged(1e-3).verdict, Verdict::fail) << unit;
  }
}

TEST(PointSets, SayWhichPointIsOutside) {
  PointSets sets{"sets", 2, {}};
  sets.points = [](std::uint64_t, std::size_t n) {
    std::vector<double> x;
    for (std::size_t i = 0; i < n; ++i) {
      x.push_back(0.1 * static_cast<double>(i));
      x.push_back(i == 3 ? 1.0 : 0.25);
    }
    return x;
  };
  const PointSet set(sets, 0, 5);
  EXPECT_EQ(set.outside(), "dimension 1 of point 3 is 1, outside [0, 1)");
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(set.point(i)[0], 0.1 * static_cast<double>(i));
    EXPECT_EQ(set.point(i)[1], set.at(i, 1));
  }
  EXPECT_EQ(PointSet(sets, 0, 3).outside(), "");
}

/// Independent points are right, but so few do not prove a deviation that small.
TEST(Replicates, SayWhatHelps) {
  PointSets sets{"independent", 1, {}};
  sets.points = [](std::uint64_t replicate, std::size_t n) {
    Random random(replicate);
    std::vector<double> x(n);
    for (double& number : x) number = random.uniform();
    return x;
  };
  ReplicateOptions o;
  o.points = 2;
  o.replicates = 2048;
  o.deviation = 1e-3;
  const CheckResult r = check_replicates(sets, o);
  EXPECT_EQ(r.verdict, Verdict::inconclusive) << r.reason;
  EXPECT_EQ(r.advice, "allow more `replicates`");
}

/// What stands in the room of channels that a BSDF does not have is no value of it.
TEST(StochasticBsdfs, ValuesBeyondTheirChannelsAreNone) {
  ErasedBsdf b = erased(Diffuse{});
  b.eval = [](const Vec3& wo, const Vec3& wi) {
    Channels c = gray(Diffuse::eval(wo, wi));
    c.value[1] = 1e6;
    return c;
  };
  StochasticOptions o;
  o.angles = {40};
  o.back = false;
  o.tolerance = 0.1;
  const Report report = check_stochastic_bsdf(stochastic_bsdf("diffuse", b), o);
  EXPECT_TRUE(report.ok()) << report.summary();
}

}  // namespace
}  // namespace plumbline::verify
