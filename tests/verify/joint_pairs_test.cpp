#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plumbline/verify/joint.h>

#include "joint_pairs.h"

/// Rays, wavelengths and volumes: right ones pass, and each fault is found by the check that it is
/// a case for.
namespace plumbline::verify {
namespace {

using joint_pairs::Fault;

ContractOptions joint_options(const std::string& name) {
  ContractOptions options = tests::contract_options(name);
  options.mass_tolerance.reset();  // the promises of joint pairs
  if (tests::nightly()) return options;
  options.points = 2'000;
  options.jacobian_points = 500;
  options.evaluations = 2'000'000;
  return options;
}

void expect_pass(const JointPair& pair) {
  const Report report = check_pair(pair, joint_options(pair.name));
  EXPECT_TRUE(report.ok()) << report.summary();
  for (const CheckResult& r : report) EXPECT_EQ(r.verdict, Verdict::pass) << describe(r);
}

/// @param which  the checks that must fail
void expect_fails(const JointPair& pair, std::initializer_list<CheckKind> which) {
  ContractOptions options = joint_options(pair.name + " at fault");
  if (!tests::nightly()) options.evaluations /= 2;
  const Report report = check_pair(pair, options);
  for (const CheckKind kind : which) {
    const auto at = std::find_if(report.begin(), report.end(),
                                 [&](const CheckResult& r) { return r.kind == kind; });
    ASSERT_NE(at, report.end()) << to_string(kind);
    EXPECT_EQ(at->verdict, Verdict::fail) << describe(*at);
    EXPECT_FALSE(at->reason.empty());
  }
}

TEST(JointPairs, PassesAThinLens) {
  expect_pass(joint_pairs::thin_lens());
  expect_pass(joint_pairs::thin_lens<float>());
}

TEST(JointPairs, PassesALensWithASquareField) { expect_pass(joint_pairs::square_field()); }

TEST(JointPairs, FindsWhatIsWrongWithALens) {
  expect_fails(joint_pairs::thin_lens(Fault::jacobian),
               {CheckKind::jacobian, CheckKind::integral, CheckKind::chi_square});
  expect_fails(joint_pairs::thin_lens(Fault::area), {CheckKind::jacobian, CheckKind::integral});
  expect_fails(joint_pairs::thin_lens(Fault::support), {CheckKind::support, CheckKind::chi_square});
  expect_fails(joint_pairs::thin_lens(Fault::independent),
               {CheckKind::jacobian, CheckKind::chi_square});
  expect_fails(joint_pairs::thin_lens(Fault::reused), {CheckKind::jacobian, CheckKind::chi_square});
  expect_fails(joint_pairs::square_field(0.5, Fault::jacobian),
               {CheckKind::jacobian, CheckKind::integral, CheckKind::chi_square});
}

TEST(JointPairs, PassesARayThatLeavesALight) {
  expect_pass(joint_pairs::emitted_ray());
  expect_pass(joint_pairs::emitted_ray<float>());
}

TEST(JointPairs, FindsWhatIsWrongWithARay) {
  expect_fails(joint_pairs::emitted_ray(Fault::area), {CheckKind::jacobian, CheckKind::integral});
  expect_fails(joint_pairs::emitted_ray(Fault::independent),
               {CheckKind::jacobian, CheckKind::chi_square});
  expect_fails(joint_pairs::emitted_ray(Fault::reused),
               {CheckKind::jacobian, CheckKind::chi_square});
  expect_fails(joint_pairs::emitted_ray(Fault::record), {CheckKind::record_pdf});
}

TEST(JointPairs, FindsAWeightThatIsNotValueOverPdf) {
  JointPair pair = joint_pairs::emitted_ray();
  pair.value = [](const JointPoint& x) { return Channels{1, {1.01 * std::max(0.0, x[1][2])}}; };
  expect_fails(pair, {CheckKind::weight});
}

TEST(JointPairs, PassesBoxes) {
  for (const std::size_t dimension : {std::size_t{3}, std::size_t{4}}) {
    expect_pass(joint_pairs::box(dimension, false));
    expect_pass(joint_pairs::box(dimension, true));
  }
}

TEST(JointPairs, FindsWhatIsWrongWithABox) {
  for (const bool tent : {false, true}) {
    const std::size_t dimension = tent ? 4 : 3;
    expect_fails(joint_pairs::box(dimension, tent, Fault::area), {CheckKind::integral});
    expect_fails(joint_pairs::box(dimension, tent, Fault::reused),
                 {CheckKind::jacobian, CheckKind::chi_square});
    expect_fails(joint_pairs::box(dimension, tent, Fault::support),
                 {CheckKind::support, CheckKind::integral, CheckKind::chi_square});
  }
}

TEST(JointPairs, PassesALobeThatDependsOnTheWavelength) {
  expect_pass(joint_pairs::dispersive_lobe());
  expect_pass(joint_pairs::dispersive_lobe<float>());
}

TEST(JointPairs, FindsWhatIsWrongWithIt) {
  for (const Fault fault : {Fault::jacobian, Fault::independent, Fault::reused}) {
    expect_fails(joint_pairs::dispersive_lobe(fault), {CheckKind::jacobian, CheckKind::chi_square});
  }
}

TEST(JointPairs, PassesAFlightAndTheDirectionAfterIt) {
  expect_pass(joint_pairs::flight_and_phase());
}

TEST(JointPairs, FindsWhatIsWrongWithAFlight) {
  // A rate that is 1.4 % off shows in the map; its samples need a million to show it.
  expect_fails(joint_pairs::flight_and_phase(Fault::area), {CheckKind::jacobian});
  expect_fails(joint_pairs::flight_and_phase(Fault::independent),
               {CheckKind::jacobian, CheckKind::chi_square});
}

TEST(JointPairs, PassesWhereLightLeavesASlab) { expect_pass(joint_pairs::subsurface()); }

TEST(JointPairs, FindsARadiusThatIsForgotten) {
  expect_fails(joint_pairs::subsurface(Fault::jacobian),
               {CheckKind::jacobian, CheckKind::integral, CheckKind::chi_square});
}

TEST(JointPairs, PassesARidge) { expect_pass(joint_pairs::ridge(0.1)); }

TEST(JointPairs, FindsARidgeAcross) {
  expect_fails(joint_pairs::ridge(0.1, Fault::independent),
               {CheckKind::jacobian, CheckKind::chi_square});
  expect_fails(joint_pairs::ridge(0.1, Fault::area), {CheckKind::jacobian, CheckKind::integral});
}

TEST(JointPairs, CallsARidgeThatItCannotResolveInconclusive) {
  const JointPair pair = joint_pairs::ridge(0.001);
  for (const CheckResult& r : check_pair(pair, joint_options(pair.name))) {
    const bool needs_masses = r.kind == CheckKind::integral || r.kind == CheckKind::chi_square;
    EXPECT_EQ(r.verdict, needs_masses ? Verdict::inconclusive : Verdict::pass) << describe(r);
    EXPECT_EQ(r.advice.find("`evaluations`") != std::string::npos, needs_masses);
  }
  // It is the masses that are not known: what the map does is.
  expect_fails(joint_pairs::ridge(0.001, Fault::area), {CheckKind::jacobian});
}

TEST(JointPairs, FailsNothingRightThatItMayHardlyLookAt) {
  // Two nodes in a bin: one whose nodes miss its peak has a mass that is too small, and must not be
  // taken for well known.
  for (int run = 0; run < 3; ++run) {
    const JointPair pair = joint_pairs::subsurface();
    ContractOptions options = joint_options("few evaluations " + std::to_string(run));
    options.evaluations = 20'000;
    options.finest_bins = 4096;
    options.samples = 200'000;
    const CheckResult r = check_chi_square(pair, options);
    EXPECT_EQ(r.verdict, Verdict::inconclusive) << describe(r);
    EXPECT_EQ(r.advice, "allow more `evaluations`");
  }
}

TEST(JointPairs, FindsPointsAndDensitiesThatAreNone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-0.5, 2.5, kNan, std::numeric_limits<double>::infinity()}) {
    JointPair pair = joint_pairs::box(3, false);
    pair.sample = [bad, sample = pair.sample](const JointUniforms& u) {
      auto record = sample(u);
      if (u[1] > 0.99) record->x[1][0] = bad;
      return record;
    };
    expect_fails(
        pair, {std::isfinite(bad) ? CheckKind::support : CheckKind::finite, CheckKind::chi_square});
  }
  for (const double bad : {-0.1, kNan}) {
    JointPair pair = joint_pairs::box(3, false);
    pair.pdf = [bad, pdf = pair.pdf](const JointPoint& x) { return x[2][0] > 1.9 ? bad : pdf(x); };
    expect_fails(pair, {CheckKind::finite, CheckKind::chi_square});
  }
}

TEST(JointPairs, KnowsAJumpBetterThatIsStated) {
  // Nine tenths of the points below 0.37 in the first dimension.
  std::vector<double> errors;
  for (const bool stated : {false, true}) {
    const Domain side = Domain::interval();
    JointPair pair{"step", JointDomain({stated ? side.with_breaks({0.37}) : side, side,
                                        Domain::unit_square()})};
    pair.sample = [](const JointUniforms& u) -> std::optional<JointRecord> {
      JointRecord record;
      record.x[0][0] = u[0] < 0.9 ? u[0] / 0.9 * 0.37 : 0.37 + (u[0] - 0.9) / 0.1 * 0.63;
      record.x[1][0] = u[1];
      record.x[2] = {u[2], u[3], 0};
      return record;
    };
    pair.pdf = [](const JointPoint& x) { return x[0][0] < 0.37 ? 0.9 / 0.37 : 0.1 / 0.63; };
    const CheckResult r = check_integral(pair, joint_options("step"));
    EXPECT_EQ(r.verdict, Verdict::pass) << describe(r);
    errors.push_back(*r.figure(Figure::integral_error));
  }
  EXPECT_LT(errors[1], errors[0] / 3);
}

TEST(JointPairs, PassesABallWhoseCornersAreRejected) { expect_pass(joint_pairs::ball()); }

TEST(JointPairs, FindsABallThatForgetsWhatItRejects) {
  expect_fails(joint_pairs::ball(Fault::area),
               {CheckKind::jacobian, CheckKind::integral, CheckKind::chi_square});
}

TEST(JointPairs, PassesJumpsAcrossAllDimensions) { expect_pass(joint_pairs::shifted()); }

TEST(JointPairs, FindsAJointDensityThatIsRightInEachDimensionAlone) {
  const JointPair pair = joint_pairs::shifted(Fault::independent);
  const Report report = check_pair(pair, joint_options("right marginals"));
  for (const CheckResult& r : report) {
    const bool sees_it = r.kind == CheckKind::jacobian || r.kind == CheckKind::chi_square;
    EXPECT_EQ(r.verdict, sees_it ? Verdict::fail : Verdict::pass) << describe(r);
  }
}

TEST(JointPairs, FindsTheSameInAGeneratorWhoseMapNobodyCanFollow) {
  for (const Fault fault : {Fault::none, Fault::independent}) {
    JointPair pair = joint_pairs::shifted(fault);
    pair.draw = [sample = pair.sample](Random& random) {
      JointUniforms u{};
      for (std::size_t i = 0; i < 4; ++i) u[i] = random.uniform();
      return sample(u);
    };
    pair.sample = nullptr;
    const ContractOptions options = joint_options("generator");
    const CheckResult jacobian = check_jacobian(pair, options);
    EXPECT_TRUE(jacobian.as_expected()) << describe(jacobian);
    EXPECT_NE(jacobian.reason.find("generator"), std::string::npos);
    EXPECT_EQ(check_chi_square(pair, options).verdict,
              fault == Fault::none ? Verdict::pass : Verdict::fail);
  }
}

TEST(JointPairs, SkipsTheJacobianOfAMixtureThatIsRight) {
  // One number chooses between two ramps: both lead everywhere.
  JointPair pair = joint_pairs::box(3, false);
  pair.sample = [](const JointUniforms& u) -> std::optional<JointRecord> {
    const bool up = u[0] < 0.5;
    const double root = std::sqrt(up ? 2 * u[0] : 2 * u[0] - 1);
    JointRecord record;
    record.x[0][0] = up ? 2 * root : 2 - 2 * root;
    record.x[1][0] = 2 * u[1];
    record.x[2][0] = 2 * u[2];
    return record;
  };
  const Report report = check_pair(pair, joint_options("mixture"));
  EXPECT_TRUE(report.ok()) << report.summary();
  EXPECT_EQ(report.verdict(), Verdict::pass);
}

TEST(JointPairs, FailsWhereOneCoordinateIsClamped) {
  // The bin that holds 0.9 and all above has the right mass.
  const auto clamped = [](double most) {
    return joint_pair<3, double, double, double>(
        "clamped", JointDomain::box({{0, 1}, {0, 1}, {0, 1}}),
        [most](const std::array<double, 3>& u) {
          return std::tuple(u[0], std::min(u[1], most), u[2]);
        },
        [](double, double, double) { return 1.0; });
  };
  EXPECT_EQ(check_chi_square(clamped(1), joint_options("not clamped")).verdict, Verdict::pass);
  for (const double most : {0.9, 0.998}) {
    EXPECT_EQ(check_chi_square(clamped(most), joint_options("clamped")).verdict, Verdict::fail);
  }
}

TEST(JointPairs, AnswersTheSameInSpans) {
  const JointPair one = joint_pairs::flight_and_phase();
  JointPair many = one;
  many.pdf = [pdf = one.pdf](std::span<const JointPoint> x, std::span<double> out) {
    for (std::size_t i = 0; i < x.size(); ++i) out[i] = pdf(x[i]);
  };
  const ContractOptions options = joint_options("spans");
  const CheckResult a = check_integral(one, options), b = check_integral(many, options);
  EXPECT_EQ(a.verdict, Verdict::pass);
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_NEAR(*a.estimate, *b.estimate, *a.figure(Figure::integral_error));
}

}  // namespace
}  // namespace plumbline::verify
