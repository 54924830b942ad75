#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <plumbline/verify/joint.h>

#include "joint_pairs.h"
#include "joints/cube.h"

/// Products of domains, and what is no pair on one.
namespace plumbline::verify {
namespace {

template <class F>
std::string refusal(const F& f) {
  try {
    f();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "not refused";
}

TEST(JointDomain, AddsDimensionsAndNames) {
  const JointDomain ray({Domain::disk(2), Domain::hemisphere()});
  EXPECT_EQ(ray.dimension(), 4);
  EXPECT_EQ(ray.name(), "disk × upper hemisphere");
  EXPECT_EQ(JointDomain::box({{0, 1}, {2, 3}, {-1, 1}}).dimension(), 3);
}

TEST(JointDomain, RefusesWhatItCannotHoldAndSaysWhatToDo) {
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_PRED2(says, refusal([] { JointDomain({}); }), "at least one factor");
  EXPECT_PRED2(says, refusal([] {
                 JointDomain({Domain::discrete(3), Domain::disk()});
               }),
               "one pair for each of its items");
  EXPECT_PRED2(says, refusal([] {
                 JointDomain({Domain::disk(), Domain::sphere(), Domain::interval()});
               }),
               "hold some of them fixed");
  EXPECT_PRED2(says, refusal([] { JointDomain::box({{0, 1}, {1, 1}}); }), "low < high");
}

TEST(JointDomain, MapsTheCubeThereAndBackWithTheProductOfTheirMeasures) {
  const JointDomain domain({Domain::interval(380, 780), Domain::disk(2), Domain::half_line(3)});
  const Cube cube(domain);
  ASSERT_EQ(cube.dimension(), 4u);
  const CubePoint p{0.25, 0.3, 0.7, 0.6};
  const JointPoint x = cube.from_cube(p);
  EXPECT_DOUBLE_EQ(x[0][0], 480);
  for (std::size_t d = 0; d < 4; ++d) EXPECT_NEAR(cube.to_cube(x)[d], p[d], 1e-14) << d;
  // 400 · π 2² · 3/(1 − 0.6)².
  EXPECT_NEAR(cube.element(p), 400 * 4 * joint_pairs::pi * 3 / 0.16, 1e-8);
  EXPECT_EQ(cube.distance(x), 0);
  JointPoint outside = x;
  outside[0][0] = 781;
  EXPECT_NEAR(cube.distance(outside), 1.0 / 780, 1e-12);
}

TEST(JointDomain, ReachesTheInsideFromEveryCorner) {
  const JointDomain domain = JointDomain::box({{0, 1}, {0, 1}, {0, 1}, {0, 1}});
  const Cube cube(domain);
  for (unsigned corner = 0; corner < 16; ++corner) {
    JointPoint x{};
    for (std::size_t d = 0; d < 4; ++d) x[d][0] = corner >> d & 1;
    std::size_t inside = 0;
    for (std::size_t way = 0; way < cube.ways(); ++way) {
      if (cube.distance(cube.near(x, 1e-6, way)) == 0) ++inside;
    }
    EXPECT_EQ(inside, 1u) << corner;
  }
}

TEST(JointPair, IsMadeOfTheUsersOwnTypes) {
  const JointPair pair = joint_pair<3, float, std::array<float, 3>>(
      "own types", JointDomain({Domain::interval(0, 2), Domain::sphere()}),
      [](const std::array<float, 3>& u) {
        return std::optional(std::tuple(2 * u[0], std::array<float, 3>{u[1], 0, u[2]}));
      },
      [](float a, const std::array<float, 3>& w) { return a * w[2]; });
  EXPECT_EQ(pair.epsilon, 0x1p-24);
  EXPECT_EQ(pair.numbers, 3);
  const auto sample = pair.sample({0.5, 0.25, 0.75});
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->x[0][0], 1);
  EXPECT_EQ(sample->x[1], (Vec3{0.25, 0, 0.75}));
  EXPECT_EQ(pair.pdf(sample->x), 0.75);
}

TEST(JointPair, IsRefusedWhereNothingCanBeChecked) {
  const auto refused = [](JointPair pair, const ContractOptions& options = {}) {
    return refusal([&] { check_pair(pair, options); });
  };
  JointPair pair = joint_pairs::box(4, false);
  pair.pdf = nullptr;
  EXPECT_NE(refused(pair).find("give its `pdf`"), std::string::npos);
  pair = joint_pairs::box(4, false);
  pair.sample = nullptr;
  EXPECT_NE(refused(pair).find("one of `sample` and `draw`"), std::string::npos);
  pair = joint_pairs::box(4, false);
  pair.numbers = 9;
  EXPECT_NE(refused(pair).find("1 to 8"), std::string::npos);
  ContractOptions options;
  options.finest_bins = 1;
  EXPECT_NE(refused(joint_pairs::box(4, false), options).find("2 bins"), std::string::npos);
}

TEST(JointPair, ThatRejectsEverythingIsNotOk) {
  JointPair pair = joint_pairs::box(3, false);
  pair.sample = [](const JointUniforms&) { return std::optional<JointRecord>(); };
  ContractOptions options;
  options.evaluations = 200'000;
  options.samples = 100'000;
  const Report report = check_pair(pair, options);
  EXPECT_FALSE(report.ok());
  EXPECT_EQ(report.results.back().kind, CheckKind::samples);
}

}  // namespace
}  // namespace plumbline::verify
