#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <plumbline/renderer/estimators/mis_weights.h>

namespace plumbline::tests {
namespace {

using renderer::Heuristic;
using renderer::kMaxTechniques;
using renderer::mis_weight;
using renderer::TechniqueDensity;
using renderer::Weighting;

using Densities = std::vector<TechniqueDensity<float>>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr auto kUlpOfOne = static_cast<double>(std::numeric_limits<float>::epsilon());

const std::vector<Weighting> kWeightings = {
    Heuristic::balance,       Heuristic::power,        {Heuristic::power, 1.5},
    {Heuristic::power, 9},    {Heuristic::power, 0.5}, {Heuristic::power, kInfinity},
    {Heuristic::cutoff, 0.1}, {Heuristic::cutoff, 0},  Heuristic::maximum};

/// Zero, both ends of float, denormals' neighbourhood, and either side of where squares overflow
/// (1.8e19) and vanish (2e-23).
constexpr std::array kValues = {0.0f, 1e-38f, 1e-30f,  2e-23f, 1e-12f,
                                1.0f, 1e12f,  1.9e19f, 1e30f,  1e38f};

/// Largest distance of a sum of weights from 1, in ulp of 1; infinite if a weight is not a weight.
template <class WeightOf>
double worst_in_ulp(const Densities& densities, WeightOf weight_of) {
  double sum = 0;
  bool any = false;
  for (std::size_t i = 0; i < densities.size(); ++i) {
    any = any || densities[i].pdf > 0;
    const float w = weight_of(densities, i);
    if (!(w >= 0 && w <= 1)) return kInfinity;
    if (densities[i].pdf == 0 && w != 0) return kInfinity;
    sum += static_cast<double>(w);
  }
  return std::abs(sum - (any ? 1 : 0)) / kUlpOfOne;
}

/// Calls `check` with every choice of 1 to `most` values, in non-decreasing order.
template <class F>
void for_all_choices(std::size_t most, Densities& chosen, std::size_t first, F& check) {
  if (!chosen.empty()) check(chosen);
  if (chosen.size() == most) return;
  for (std::size_t v = first; v < kValues.size(); ++v) {
    chosen.push_back({kValues[v]});
    for_all_choices(most, chosen, v, check);
    chosen.pop_back();
  }
}

/// Largest excess over M ulp that any choice of values gives; `counts` sets the counts first.
template <class WeightOf, class SetCounts>
double worst_excess(WeightOf weight_of, SetCounts set_counts) {
  double worst = -kInfinity;
  auto check = [&](const Densities& choice) {
    Densities densities = choice;
    set_counts(densities);
    worst =
        std::max(worst, worst_in_ulp(densities, weight_of) - static_cast<double>(densities.size()));
  };
  Densities chosen;
  for_all_choices(kMaxTechniques, chosen, 0, check);
  return worst;
}

auto heuristic(const Weighting& weighting) {
  return [&weighting](const Densities& densities, std::size_t i) {
    return mis_weight(weighting, std::span<const TechniqueDensity<float>>(densities), i);
  };
}

TEST(MisWeightNumerics, DenormalsAreNotFlushedHere) {
  volatile float smallest_normal = std::numeric_limits<float>::min();
  EXPECT_GT(smallest_normal / 4, 0.0f);
}

TEST(MisWeightNumerics, SumToOneWithinMUlpForAllDensitiesOfUpToEightTechniques) {
  for (const Weighting& weighting : kWeightings) {
    EXPECT_LE(worst_excess(heuristic(weighting), [](Densities&) {}), 0)
        << static_cast<int>(weighting.heuristic) << ' ' << weighting.parameter;
  }
}

TEST(MisWeightNumerics, AlsoWithCountsWhoseProductsWouldOverflow) {
  const auto counts = [](Densities& densities) {
    for (std::size_t i = 0; i < densities.size(); ++i) {
      densities[i].count = i % 3 == 0 ? 1e6f : i % 3 == 1 ? 1.0f : 64.0f;
    }
  };
  for (const Weighting& weighting : kWeightings) {
    EXPECT_LE(worst_excess(heuristic(weighting), counts), 0)
        << static_cast<int>(weighting.heuristic) << ' ' << weighting.parameter;
  }
}

TEST(MisWeightNumerics, TheOrderOfTheTechniquesDoesNotMatter) {
  for (const Weighting& weighting : kWeightings) {
    const Densities forwards = {{1e-38f}, {3}, {1e38f}, {2e38f}, {0}};
    const Densities backwards(forwards.rbegin(), forwards.rend());
    for (std::size_t i = 0; i < forwards.size(); ++i) {
      EXPECT_NEAR(heuristic(weighting)(forwards, i),
                  heuristic(weighting)(backwards, forwards.size() - 1 - i), kUlpOfOne);
    }
  }
}

TEST(MisWeightNumerics, AgreeWithLongDouble) {
  // x87 long double has the exponents to square any float.
  for (const float a : kValues) {
    for (const float b : kValues) {
      if (a == 0 && b == 0) continue;
      const Densities densities = {{a}, {b}};
      const auto la = static_cast<long double>(a), lb = static_cast<long double>(b);
      const auto exact = static_cast<double>(la * la / (la * la + lb * lb));
      EXPECT_NEAR(heuristic(Heuristic::power)(densities, 0), exact, kUlpOfOne) << a << ' ' << b;
    }
  }
}

TEST(MisWeightNumerics, TheNaiveFormsFail) {
  const auto naive_power = [](const Densities& densities, std::size_t i) {
    float sum = 0;
    for (const auto& d : densities) sum += d.pdf * d.pdf;
    return densities[i].pdf * densities[i].pdf / sum;
  };
  const auto naive_balance = [](const Densities& densities, std::size_t i) {
    float sum = 0;
    for (const auto& d : densities) sum += d.count * d.pdf;
    return densities[i].count * densities[i].pdf / sum;
  };
  EXPECT_GT(worst_excess(naive_power, [](Densities&) {}), 0);
  EXPECT_GT(worst_excess(naive_balance, [](Densities&) {}), 0);
}

}  // namespace
}  // namespace plumbline::tests
