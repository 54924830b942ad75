#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <plumbline/analytic/estimator_moments.h>
#include <plumbline/renderer/estimators/mis_weights.h>

namespace plumbline::tests {
namespace {

using renderer::Heuristic;
using renderer::mis_weight;
using renderer::TechniqueDensity;
using renderer::Weighting;

using Densities = std::vector<TechniqueDensity<double>>;

const std::vector<Weighting> kWeightings = {
    Heuristic::balance,    Heuristic::power,  {Heuristic::power, 1.3},   {Heuristic::power, 0.5},
    {Heuristic::power, 9}, Heuristic::cutoff, {Heuristic::cutoff, 0.45}, Heuristic::maximum};

double weight(const Weighting& weighting, const Densities& densities, std::size_t i) {
  return mis_weight(weighting, std::span<const TechniqueDensity<double>>(densities), i);
}

/// The densities of an integral at x, with counts 1, 2, 3, …
Densities densities_at(const analytic::Integral1d& integral, double x) {
  Densities densities;
  for (const auto& density : integral.densities) {
    densities.push_back({density.pdf_x(x), static_cast<double>(densities.size() + 1)});
  }
  return densities;
}

template <class F>
void on_every_integral(F check) {
  std::vector<analytic::Integral1d> all = analytic::known_integrals();
  all.insert(all.end(), analytic::combination_integrals().begin(),
             analytic::combination_integrals().end());
  for (const auto& integral : all) {
    for (int k = 0; k <= 400; ++k) {
      // Denser towards the low end, where the sun is a sliver.
      const double t = std::pow(k / 400.0, 4);
      check(integral, integral.low + t * (integral.high - integral.low));
    }
  }
}

TEST(MisWeights, AreThoseOfTheDefinitions) {
  const Densities q = {{3, 1}, {1, 4}, {0.25, 1}};  // q = 3, 4, 1/4
  EXPECT_DOUBLE_EQ(weight(Heuristic::balance, q, 0), 3 / 7.25);
  EXPECT_DOUBLE_EQ(weight(Heuristic::balance, q, 1), 4 / 7.25);
  EXPECT_DOUBLE_EQ(weight(Heuristic::power, q, 0), 9 / 25.0625);
  EXPECT_DOUBLE_EQ(weight({Heuristic::power, 3}, q, 1), 64 / (27 + 64 + 1 / 64.0));
  EXPECT_DOUBLE_EQ(weight({Heuristic::cutoff, 0.1}, q, 0), 3 / 7.0);
  EXPECT_EQ(weight({Heuristic::cutoff, 0.1}, q, 2), 0);
  EXPECT_DOUBLE_EQ(weight({Heuristic::cutoff, 0.05}, q, 2), 0.25 / 7.25);
  EXPECT_EQ(weight(Heuristic::maximum, q, 0), 0);
  EXPECT_EQ(weight(Heuristic::maximum, q, 1), 1);
}

TEST(MisWeights, SeedsTwoSteps) {
  const Densities low = {{1}, {0}};    // x = 0.5
  const Densities high = {{1}, {10}};  // x = 0.95
  EXPECT_EQ(weight(Heuristic::balance, low, 0), 1);
  EXPECT_EQ(weight(Heuristic::balance, low, 1), 0);
  EXPECT_DOUBLE_EQ(weight(Heuristic::balance, high, 0), 1.0 / 11);
  EXPECT_DOUBLE_EQ(weight(Heuristic::balance, high, 1), 10.0 / 11);
}

TEST(MisWeights, SumToOneWhereverAnyDensityIsPositive) {
  on_every_integral([](const analytic::Integral1d& integral, double x) {
    const Densities densities = densities_at(integral, x);
    bool any = false;
    for (const auto& d : densities) any = any || d.pdf > 0;
    for (const Weighting& weighting : kWeightings) {
      double sum = 0;
      for (std::size_t i = 0; i < densities.size(); ++i) {
        const double w = weight(weighting, densities, i);
        ASSERT_TRUE(w >= 0 && w <= 1) << integral.name << ' ' << x;
        ASSERT_TRUE(w == 0 || densities[i].pdf > 0) << integral.name << ' ' << x;
        sum += w;
      }
      ASSERT_NEAR(sum, any ? 1 : 0, 1e-15) << integral.name << ' ' << x;
    }
  });
}

TEST(MisWeights, AgreeWithTheOracleAtEveryPoint) {
  using Kind = analytic::WeightRule::Kind;
  const std::vector<std::pair<Weighting, analytic::WeightRule>> pairs = {
      {Heuristic::balance, {Kind::balance, 0}},
      {Heuristic::power, {Kind::power, 2}},
      {{Heuristic::power, 1.3}, {Kind::power, 1.3}},
      {Heuristic::cutoff, {Kind::cutoff, 0.1}},
      {Heuristic::maximum, {Kind::maximum, 0}}};
  on_every_integral([&](const analytic::Integral1d& integral, double x) {
    const Densities densities = densities_at(integral, x);
    std::vector<double> q;
    for (const auto& d : densities) q.push_back(d.count * d.pdf);
    for (const auto& [weighting, rule] : pairs) {
      for (std::size_t i = 0; i < q.size(); ++i) {
        ASSERT_NEAR(weight(weighting, densities, i), analytic::weight(rule, q, i), 1e-14)
            << integral.name << ' ' << x;
      }
    }
  });
}

TEST(MisWeights, PowerOneIsBalance) {
  on_every_integral([](const analytic::Integral1d& integral, double x) {
    const Densities densities = densities_at(integral, x);
    for (std::size_t i = 0; i < densities.size(); ++i) {
      ASSERT_EQ(weight({Heuristic::power, 1}, densities, i),
                weight(Heuristic::balance, densities, i));
    }
  });
}

TEST(MisWeights, PowerTwoWithoutPowIsPowerTwo) {
  on_every_integral([](const analytic::Integral1d& integral, double x) {
    const Densities densities = densities_at(integral, x);
    for (std::size_t i = 0; i < densities.size(); ++i) {
      ASSERT_NEAR(weight(Heuristic::power, densities, i),
                  weight({Heuristic::power, std::nextafter(2.0, 3.0)}, densities, i), 1e-13);
    }
  });
}

TEST(MisWeights, PowerTendsToMaximum) {
  const double infinity = std::numeric_limits<double>::infinity();
  on_every_integral([&](const analytic::Integral1d& integral, double x) {
    const Densities densities = densities_at(integral, x);
    for (std::size_t i = 0; i < densities.size(); ++i) {
      ASSERT_EQ(weight({Heuristic::power, infinity}, densities, i),
                weight(Heuristic::maximum, densities, i));
    }
  });
  const Densities close = {{1}, {1.01}};
  double last = 0;
  for (const double beta : {1.0, 10.0, 100.0, 1000.0, 10000.0}) {
    const double w = weight({Heuristic::power, beta}, close, 1);
    EXPECT_GT(w, last);
    last = w;
  }
  EXPECT_EQ(last, 1);
}

TEST(MisWeights, EqualMaximaShareWhateverTheOrder) {
  const Densities tied = {{2}, {1}, {2}};
  EXPECT_EQ(weight(Heuristic::maximum, tied, 0), 0.5);
  EXPECT_EQ(weight(Heuristic::maximum, tied, 1), 0);
  EXPECT_EQ(weight(Heuristic::maximum, tied, 2), 0.5);
}

TEST(MisWeights, TwoTechniquesWeighTheSameAtBothCallSites) {
  // The renderer asks once from the light sample and once from the BSDF sample.
  for (const Weighting& weighting : kWeightings) {
    for (const auto& [a, b] : {std::pair{0.3, 0.7}, {2.0, 2.0}, {0.0, 1.0}, {1e-9, 3.0}}) {
      const Densities ab = {{a}, {b}};
      EXPECT_EQ(mis_weight(weighting, a, b), weight(weighting, ab, 0));
      EXPECT_EQ(mis_weight(weighting, b, a), weight(weighting, ab, 1));
      EXPECT_NEAR(mis_weight(weighting, a, b) + mis_weight(weighting, b, a), 1, 1e-15);
    }
  }
}

TEST(MisWeights, AnAtomTakesAllTheWeightAtItsPoint) {
  // However large the densities beside it, and however small its mass.
  const Densities beside = {{1e-6, 1, true}, {1e300, 8}, {5, 1}};
  const Densities two_atoms = {{0.25, 1, true}, {7, 1}, {0.75, 1, true}};
  for (const Weighting& weighting : kWeightings) {
    EXPECT_EQ(weight(weighting, beside, 0), 1);
    EXPECT_EQ(weight(weighting, beside, 1), 0);
    EXPECT_EQ(weight(weighting, beside, 2), 0);
    EXPECT_EQ(weight(weighting, two_atoms, 1), 0);
    EXPECT_NEAR(weight(weighting, two_atoms, 0) + weight(weighting, two_atoms, 2), 1, 1e-15);
  }
  EXPECT_EQ(weight(Heuristic::balance, two_atoms, 0), 0.25);
}

TEST(MisWeights, AnAtomWithoutMassIsNoAtom) {
  const Densities densities = {{0, 1, true}, {2, 1}};
  EXPECT_EQ(weight(Heuristic::balance, densities, 0), 0);
  EXPECT_EQ(weight(Heuristic::balance, densities, 1), 1);
}

}  // namespace
}  // namespace plumbline::tests
