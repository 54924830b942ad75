#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <plumbline/verify/pair.h>

#include "diagnosis/part_explanations.h"
#include "diagnosis/parts.h"
#include "diagnosis/two_ways.h"
#include "lattice.h"
#include "pairs/branches.h"
#include "pairs/differences.h"

/// What is found out of a map of uniform numbers by asking it: densities, ways to a point, the
/// number that chooses.
namespace plumbline::verify {
namespace {

using std::numbers::pi;
using Sample = std::optional<SampleRecord>;

Sample at_point(double x, double y = 0) { return SampleRecord{{x, y, 0}, {}, {}}; }

std::vector<Uniforms> even_numbers(int count) {
  std::vector<Uniforms> u;
  for (const Point2& p : even_points(count)) u.push_back({p[0], p[1], 0});
  return u;
}

/// x = u², y = v³: 1/(6 u v²).
Sample powers(const Uniforms& u) { return at_point(u[0] * u[0], std::pow(u[1], 3)); }
double density_of_powers(const Uniforms& u) { return 1 / (6 * u[0] * u[1] * u[1]); }

TEST(Differences, GiveTheDensityWithinTheErrorThatTheyState) {
  const Map map = powers;
  const std::vector<Uniforms> u = even_numbers(200);
  const auto densities = densities_by_differences(map, u, 2, 0x1p-53);
  ASSERT_EQ(densities.size(), u.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    ASSERT_TRUE(densities[i]);
    EXPECT_LT(densities[i]->relative_error, 1e-6);
    EXPECT_NEAR(densities[i]->value / density_of_powers(u[i]), 1, densities[i]->relative_error);
  }
}

/// In float a smooth map is known to a few thousandths, and one that rounds to 2⁻¹⁶ to far less.
TEST(Differences, KnowWhatRoundingDoes) {
  const auto worst_error = [](double step) {
    const Map map = [step](const Uniforms& u) {
      return at_point(step * std::round((u[0] + u[0] * u[0] / 4) / step));
    };
    double worst = 0;
    for (int i = 200; i < 800; i += 7) {
      const double u = i / 1024.0;
      const auto density = density_by_differences(map, {u, 0, 0}, 1, 0x1p-24);
      worst = std::max(worst, density->relative_error);
      EXPECT_NEAR(density->value * (1 + u / 2), 1, density->relative_error) << u;
    }
    return worst;
  };
  EXPECT_LT(worst_error(0x1p-24), 2e-4);
  EXPECT_GT(worst_error(0x1p-16), 2e-4);
}

TEST(Differences, AreNoneOfWhatIsFlatOrRejected) {
  const auto density = [](const Map& map) {
    return density_by_differences(map, {0.5, 0.5, 0}, 2, 0x1p-53);
  };
  EXPECT_TRUE(density([](const Uniforms& u) { return at_point(u[0], u[1]); }));
  EXPECT_FALSE(density([](const Uniforms& u) { return at_point(u[0], u[0]); }));
  EXPECT_FALSE(density([](const Uniforms&) -> Sample { return std::nullopt; }));
  EXPECT_FALSE(density([](const Uniforms& u) -> Sample {
    if (u[0] > 0.5) return std::nullopt;
    return at_point(u[0], u[1]);
  }));
}

/// Beside a seam, from the side that is smooth.
TEST(Differences, OnOneSideDoNotSeeTheOther) {
  const Map map = [](const Uniforms& u) { return at_point(u[0] < 0.5 ? u[0] : 3 * u[0]); };
  const double just_below = 0.5 - 0x1p-30, just_above = 0.5 + 0x1p-30;
  const Uniforms u[] = {{just_below, 0, 0}, {just_above, 0, 0}};
  const auto densities = densities_on_one_side(map, u, 1, 0x1p-53);
  ASSERT_EQ(densities.size(), 2u);
  const auto knows = [](const std::vector<DensityAt>& of, double value) {
    for (const DensityAt& d : of) {
      if (std::abs(d.value / value - 1) < 1e-6 && d.relative_error < 1e-6) return true;
    }
    return false;
  };
  EXPECT_TRUE(knows(densities[0], 1));
  EXPECT_FALSE(knows(densities[0], 1 / 3.0));
  EXPECT_TRUE(knows(densities[1], 1 / 3.0));
  EXPECT_FALSE(knows(densities[1], 1));
}

/// Next to an end of a number, steps are as short as they have to be.
TEST(Differences, OnOneSideStayInside) {
  const Map map = [](const Uniforms& u) {
    EXPECT_TRUE(u[0] > 0 && u[0] < 1 && u[1] > 0 && u[1] < 1);
    return at_point(u[0] * u[0], u[1]);
  };
  const Uniforms u[] = {{0.5, 0.5, 0}, {0x1p-12, 0.5, 0}, {1 - 0x1p-12, 1 - 0x1p-12, 0}};
  const auto densities = densities_on_one_side(map, u, 2, 0x1p-53);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(densities[i].size(), 4u) << "of both sides of both numbers";
    for (const DensityAt& d : densities[i]) EXPECT_NEAR(d.value * 2 * u[i][0], 1, 1e-6) << i;
  }
}

/// All that is needed around some points is asked for at once, as much as a call may hold.
TEST(Differences, AskInAsFewCallsAsTheMapTakes) {
  int calls = 0;
  const auto spans = [&calls](std::span<const Uniforms> u, std::span<Sample> out) {
    ++calls;
    for (std::size_t i = 0; i < u.size(); ++i) out[i] = powers(u[i]);
  };
  densities_by_differences(Map(spans, 1 << 16), even_numbers(100), 2, 0x1p-53);
  EXPECT_EQ(calls, 1);
}

/// Where x = (u − c)², two numbers lead to each point, here within one cell of the search's grid.
TEST(Branches, AreFoundWhereAMapFolds) {
  for (const double apart : {1e-4, 1e-2, 0.2}) {
    constexpr double kFold = 0.4003;
    const Map map = [](const Uniforms& u) { return at_point(std::pow(u[0] - kFold, 2)); };
    const BranchSearch search(map, 1, 0x1p-53);
    const BranchSearch::Target target{{apart * apart, 0, 0}, {}};
    auto found = search.preimages({&target, 1}).front();
    ASSERT_EQ(found.size(), 2u) << apart;
    if (found[0][0] > found[1][0]) std::swap(found[0], found[1]);
    EXPECT_NEAR(found[0][0], kFold - apart, 1e-9);
    EXPECT_NEAR(found[1][0], kFold + apart, 1e-9);
  }
}

TEST(Branches, OfTwoNumbersAreFound) {
  const Map map = [](const Uniforms& u) {
    return at_point(std::pow(u[0] - 0.3, 2), std::pow(u[1] - 0.55, 2));
  };
  const BranchSearch search(map, 2, 0x1p-53);
  const BranchSearch::Target target{{0.01, 0.04, 0}, {}};
  const auto found = search.preimages({&target, 1}).front();
  EXPECT_EQ(found.size(), 4u);
  for (const Uniforms& u : found) {
    EXPECT_NEAR(std::abs(u[0] - 0.3), 0.1, 1e-9);
    EXPECT_NEAR(std::abs(u[1] - 0.55), 0.2, 1e-9);
  }
}

/// Where a map is flat no step leads on, and none is tried.
TEST(Branches, AreNotSoughtWhereAMapIsFlat) {
  const Map map = [](const Uniforms& u) {
    EXPECT_TRUE(std::isfinite(u[0]));
    return at_point(std::max(u[0], 0.5));
  };
  const BranchSearch search(map, 1, 0x1p-53);
  const BranchSearch::Target targets[] = {{{0.4, 0, 0}, {}}, {{0.75, 0, 0}, {}}};
  const auto found = search.preimages(targets);
  EXPECT_TRUE(found[0].empty());
  ASSERT_EQ(found[1].size(), 1u);
  EXPECT_NEAR(found[1][0][0], 0.75, 1e-9);
}

/// A way that is known counts once, also where no search would find it.
TEST(Branches, ThatAreKnownAreAmongThem) {
  const Map map = [](const Uniforms& u) {
    return at_point(u[0] > 0.5 && u[0] < 0.5 + 1e-7 ? 5 + u[0] : u[0]);
  };
  const BranchSearch search(map, 1, 0x1p-53);
  const Uniforms hidden{0.5 + 5e-8, 0, 0}, plain{0.25, 0, 0};
  const BranchSearch::Target targets[] = {{{5.5 + 5e-8, 0, 0}, hidden}, {{0.25, 0, 0}, plain}};
  const auto found = search.preimages(targets);
  ASSERT_EQ(found.size(), 2u);
  ASSERT_EQ(found[0].size(), 1u);
  EXPECT_EQ(found[0][0], hidden);
  EXPECT_EQ(found[1].size(), 1u);
}

/// Reflected with probability F of the first number, or else let through; F = 1 beyond 0.75.
double share_of_first(double u) { return u < 0.75 ? 0.2 + 0.8 * u : 1; }

SamplingPair two_ways_pair(double reused) {
  SamplingPair pair;
  pair.domain = Domain::unit_square();
  pair.numbers = 3;
  pair.sample = [reused](const Uniforms& u) {
    const bool first = u[2] < share_of_first(u[0]);
    return at_point(first ? u[0] / 2 : 0.5 + u[0] / 2, u[1] + reused * u[2]);
  };
  return pair;
}

TEST(TwoWaysOfASampler, AreKnownWithTheirProbabilities) {
  const SamplingPair pair = two_ways_pair(0);
  const TwoWays ways(pair);
  ASSERT_TRUE(ways.found());
  const std::vector<Uniforms> others = even_numbers(40);
  const std::vector<double> first = ways.probabilities(0, others),
                            second = ways.probabilities(1, others);
  for (std::size_t i = 0; i < others.size(); ++i) {
    EXPECT_NEAR(first[i], share_of_first(others[i][0]), 1e-11) << others[i][0];
    EXPECT_NEAR(first[i] + second[i], 1, 1e-15);
    EXPECT_EQ(ways.way(0)(others[i])->x[0], others[i][0] / 2);
    if (others[i][0] < 0.75) {
      EXPECT_EQ(ways.way(1)(others[i])->x[0], 0.5 + others[i][0] / 2);
    }
  }
}

TEST(TwoWaysOfASampler, AreNoneWhereTheNumberDoesMore) {
  EXPECT_FALSE(TwoWays(two_ways_pair(0.1)).found());
  SamplingPair two = two_ways_pair(0);
  two.numbers = 2;
  EXPECT_FALSE(TwoWays(two).found());
}

/// A jump that is seen is larger than a thousandth, and stays one however close it is looked at.
TEST(PartsOfASampler, AreParted) {
  const auto parted = [](double jump) {
    SamplingPair pair;
    pair.domain = Domain::unit_square();
    pair.numbers = 2;
    // Steep, but smooth, near the end.
    pair.sample = [jump](const Uniforms& u) {
      return at_point(0.2 * u[0] + 0.3 * std::pow(u[0], 40) + (u[0] < 0.3 ? 0 : jump), u[1]);
    };
    return parts_of(pair);
  };
  EXPECT_EQ(parted(0).count(), 1u);
  EXPECT_EQ(parted(7e-4).count(), 1u);
  const std::vector<double> found = parted(0.1).borders;
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0], 0);
  EXPECT_NEAR(found[1], 0.3, 1e-8);
  EXPECT_EQ(found[2], 1);
}

/// Six rows of a map, of 20° each, chosen with these probabilities; pdf() has `weights` for them.
std::optional<Finding> cause_of_rows(const std::vector<double>& weights) {
  constexpr double kShares[] = {0.1, 0.25, 0.15, 0.2, 0.1, 0.2};
  constexpr double kFirst = pi / 6, kRow = pi / 9;
  const auto cosine = [](std::size_t border) {
    return std::cos(kFirst + static_cast<double>(border) * kRow);
  };
  SamplingPair pair;
  pair.domain = Domain::sphere();
  pair.numbers = 3;
  pair.sample = [=](const Uniforms& u) {
    std::size_t row = 0;
    for (double left = u[2]; row < 5 && left >= kShares[row]; ++row) left -= kShares[row];
    const double z = cosine(row) + u[0] * (cosine(row + 1) - cosine(row)), r = std::sqrt(1 - z * z);
    const double phi = 2 * pi * u[1];
    return Sample(SampleRecord{{r * std::cos(phi), r * std::sin(phi), z}, {}, {}});
  };
  pair.pdf = [=](const Vec3& x) {
    for (std::size_t row = 0; row < 6; ++row) {
      if (x[2] > cosine(row) || x[2] <= cosine(row + 1)) continue;
      return weights[row] / (2 * pi * (cosine(row) - cosine(row + 1)));
    }
    return 0.0;
  };
  ReportEvidence evidence;
  ViewEvidence& view = evidence.views.emplace_back();
  view.pair = &pair;
  view.failed = true;
  view.mass = MassSeen{1, 1e-4, 0, 0, 0};
  return PartExplanations(evidence).by_parts(false);
}

/// Of directions that are even in a row the mean sine is ∫sin² / ∫sin.
TEST(PartsOfASampler, AreRowsWithoutTheirSines) {
  std::vector<double> with_sines, uneven, right = {0.1, 0.25, 0.15, 0.2, 0.1, 0.2};
  for (std::size_t row = 0; row < 6; ++row) {
    const double a = pi / 6 + static_cast<double>(row) * pi / 9, b = a + pi / 9;
    const double sine =
        ((b - a) / 2 - (std::sin(2 * b) - std::sin(2 * a)) / 4) / (std::cos(a) - std::cos(b));
    with_sines.push_back(1.1 * right[row] * sine);
    // Of one row a tenth more.
    uneven.push_back(with_sines.back() * (row == 2 ? 1.1 : 1));
  }
  const auto kind = [](const std::vector<double>& weights) {
    const auto f = cause_of_rows(weights);
    return f ? f->kind : CauseKind::none;
  };
  EXPECT_EQ(kind(right), CauseKind::none);
  EXPECT_EQ(kind(with_sines), CauseKind::sine);
  EXPECT_NE(kind(uneven), CauseKind::sine);
}

// Round trips.

CheckResult round_trip(double off_by, double grows) {
  SamplingPair pair;
  pair.name = "root";
  pair.domain = Domain::interval(0, 1);
  pair.numbers = 1;
  pair.epsilon = 0x1p-24;
  // Steep next to 0: x = u^¼.
  pair.sample = [](const Uniforms& u) { return at_point(std::pow(u[0], 0.25)); };
  pair.pdf = [](const Vec3& x) { return 4 * std::pow(x[0], 3); };
  pair.inverse = [=](const Vec3& x) -> Uniforms {
    return {std::min(1.0, std::pow(x[0], 4) * (1 + grows) + off_by * 0x1p-24), 0, 0};
  };
  return check_inverse(pair, {});
}

/// A rounding of the numbers is as much of a point as the map is steep: seen beside the numbers.
TEST(Inverses, MayBeOffByARoundingWhereTheMapIsSteep) {
  EXPECT_EQ(round_trip(0, 0).verdict, Verdict::pass);
  EXPECT_EQ(round_trip(1, 0).verdict, Verdict::pass) << round_trip(1, 0).reason;
  EXPECT_EQ(round_trip(0, 1e-3).verdict, Verdict::fail);
}

TEST(Inverses, ThatLeadNowhereFail) {
  const CheckResult r = round_trip(-0x1p22, 0);
  EXPECT_EQ(r.verdict, Verdict::fail);
  EXPECT_NE(r.reason.find("leads nowhere"), std::string::npos) << r.reason;
}

}  // namespace
}  // namespace plumbline::verify
