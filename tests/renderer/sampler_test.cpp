#include <plumbline/renderer/core/sampling/sampler.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/names.h>
#include <plumbline/verify/dependent.h>
#include <plumbline/verify/mean.h>
#include <plumbline/verify/pair.h>
#include <plumbline/verify/ratio.h>
#include <plumbline_tests/support.h>

namespace plumbline::tests {
namespace {

using renderer::kSamplers;
using renderer::Sampler;
using renderer::SamplerType;
using renderer::SobolSampler;
using renderer::Vec2f;

/// The `pair`th pair of numbers of a sample.
Vec2f pair_of(SamplerType type, std::uint64_t seed, std::uint64_t net, std::uint64_t index,
              int pair) {
  Sampler random(type, seed, net, index);
  for (int i = 0; i < pair; ++i) random.next_2d();
  return random.next_2d();
}

/// Whether `points`, 2^k of them, have one in every box of 2^-a by 2^(a-k).
bool is_net(const std::vector<Vec2f>& points, int k) {
  for (int a = 0; a <= k; ++a) {
    std::vector<bool> taken(points.size());
    for (const Vec2f& p : points) {
      const auto column = static_cast<std::size_t>(std::ldexp(p.x, a));
      const auto row = static_cast<std::size_t>(std::ldexp(p.y, k - a));
      const std::size_t box = column << (k - a) | row;
      if (taken[box]) return false;
      taken[box] = true;
    }
  }
  return true;
}

std::vector<Vec2f> net_of(SamplerType type, std::uint64_t net, std::uint64_t first, int k,
                          int pair) {
  std::vector<Vec2f> points;
  for (std::uint64_t i = first; i < first + (1u << k); ++i) {
    points.push_back(pair_of(type, check_seed("nets"), net, i, pair));
  }
  return points;
}

TEST(SobolSampler, EveryPairOfEveryPixelIsANetAtPowersOfTwo) {
  for (const std::uint64_t pixel : {0u, 1u, 2u, 777u, 1u << 20}) {
    for (const int pair : {0, 1, 2, 17}) {
      for (int k = 0; k <= 10; ++k) {
        ASSERT_TRUE(is_net(net_of(SamplerType::sobol, pixel, 0, k, pair), k))
            << "pixel " << pixel << ", pair " << pair << ", 2^" << k;
      }
    }
  }
}

TEST(SobolSampler, EveryAlignedRunOfSamplesIsANetSoThatPassesStayStratified) {
  for (const std::uint64_t first : {1u << 10, 7u << 10, 1u << 17, 0xfffffc00u}) {
    ASSERT_TRUE(is_net(net_of(SamplerType::sobol, 3, first, 10, 1), 10)) << first;
  }
  ASSERT_TRUE(is_net(net_of(SamplerType::sobol, 3, 0, 16, 1), 16));
}

/// Two padded pairs of numbers of each sample, a pixel for each replicate.
verify::PointSets padded_pairs(SamplerType type) {
  verify::PointSets sets{std::string(renderer::name(type)), 4, {}};
  sets.points = [type](std::uint64_t replicate, std::size_t n) {
    std::vector<double> numbers;
    for (std::uint64_t i = 0; i < n; ++i) {
      Sampler random(type, check_seed("padded pairs"), replicate, i);
      for (int pair = 0; pair < 2; ++pair) {
        const Vec2f p = random.next_2d();
        numbers.insert(numbers.end(), {double{p.x}, double{p.y}});
      }
    }
    return numbers;
  };
  return sets;
}

TEST(SobolSampler, PaddedPairsAreSequencesOfNetsAndEachPointIsUniform) {
  verify::NetOptions nets;
  nets.seed = check_seed("sobol/net");
  nets.sequence = true;
  verify::ReplicateOptions replicates;
  replicates.seed = check_seed("sobol/replicates");
  expect_verdict(check_net(padded_pairs(SamplerType::sobol), nets));
  expect_verdict(check_replicates(padded_pairs(SamplerType::sobol), replicates));

  verify::CheckResult none = check_net(padded_pairs(SamplerType::independent), nets);
  none.expected = verify::Verdict::fail;
  expect_verdict(none);
  expect_verdict(check_replicates(padded_pairs(SamplerType::independent), replicates));
}

TEST(SobolSampler, IndependentNumbersAreNoNet) {
  EXPECT_FALSE(is_net(net_of(SamplerType::independent, 3, 0, 8, 0), 8));
}

TEST(Samplers, SamplesDoNotRepeatBeyondTwoToTheSeventeen) {
  for (const SamplerType type : kSamplers) {
    std::set<std::pair<float, float>> seen;
    constexpr std::uint64_t kCount = 3u << 17;
    for (std::uint64_t i = 0; i < kCount; ++i) {
      const Vec2f u = pair_of(type, 1, 5, i, 0);
      seen.emplace(u.x, u.y);
    }
    // Of 2^48 pairs, independent ones meet with probability kCount²/2/2^48 = 3e-4 once, 4e-8 twice.
    EXPECT_GE(seen.size(), kCount - 1) << name(type);
  }
}

TEST(Samplers, NeverReturnOne) {
  EXPECT_LT(renderer::to_unit(0xffffffffu), 1.0f);
  EXPECT_EQ(renderer::to_unit(0), 0.0f);
  for (const SamplerType type : kSamplers) {
    for (std::uint64_t net = 0; net < 100; ++net) {
      for (std::uint64_t i = 0; i < 10'000; ++i) {
        Sampler random(type, 2, net, i);
        const Vec2f u = random.next_2d();
        const float v = random.next_1d();
        ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1 && v >= 0 && v < 1);
      }
    }
  }
}

/// A point at a fixed index, under a scramble of its own each time: uniform, or nets are biased.
TEST(SobolSampler, EveryPointUnderARandomScrambleIsUniformOnTheSquare) {
  for (const std::uint64_t index : {0u, 1u, 2u, 5u, 1023u, 131'073u, 0xffffffffu}) {
    std::string subject = "sobol/point ";
    subject.append(std::to_string(index));
    verify::ContractOptions options;
    options.seed = check_seed(subject);
    const auto pair = verify::sampling_pair<Vec2f>(
        subject, verify::Domain::unit_square(),
        [index](verify::Random& random) { return SobolSampler(random.bits(), 0, index).next_2d(); },
        [](const Vec2f&) { return 1.0f; });
    expect_verdict(verify::check_chi_square(pair, options));
  }
}

/// Error of the mean of x y over 16 samples of a net.
double error_of(SamplerType type, std::uint64_t seed, std::uint64_t net, int pair) {
  double sum = 0;
  for (std::uint64_t i = 0; i < 16; ++i) {
    const Vec2f u = pair_of(type, seed, net, i, pair);
    sum += static_cast<double>(u.x) * static_cast<double>(u.y) - 0.25;
  }
  return sum / 16;
}

double variance_of_error(SamplerType type) {
  verify::Moments moments;
  for (std::uint64_t net = 0; net < 100'000; ++net) {
    moments.add(error_of(type, check_seed("variance of nets"), net, 0));
  }
  return moments.variance();
}

/// Whether the errors of two nets that have nothing to do with each other are uncorrelated.
///
/// @param first, second  (seed, trial) to an error
template <class First, class Second>
void expect_uncorrelated(SamplerType type, const std::string& what, const First& first,
                         const Second& second, verify::Verdict expected = verify::Verdict::pass) {
  verify::MeanOptions options;
  options.subject.append(what).append("/").append(name(type));
  options.reference = 0;
  options.relative = false;
  options.tolerance = 0.02;  // a correlation
  options.rounding_allowance = 1e-4;
  options.expected = expected;
  options.seed = check_seed(options.subject);
  const double variance = variance_of_error(type);
  expect_verdict(check_mean(options, [&](std::uint64_t begin, std::uint64_t count) {
    verify::Moments moments;
    for (std::uint64_t i = begin; i < begin + count; ++i) {
      moments.add(first(options.seed, i) * second(options.seed, i) / variance);
    }
    return moments;
  }));
}

TEST(Samplers, ErrorsOfNeighbouringPixelsOtherSeedsAndOtherPairsAreUncorrelated) {
  for (const SamplerType type : kSamplers) {
    const auto error = [type](std::uint64_t seed, std::uint64_t net, int pair = 0) {
      return error_of(type, seed, net, pair);
    };
    const auto own = [&](std::uint64_t seed, std::uint64_t i) { return error(seed, 2 * i); };
    expect_uncorrelated(type, "neighbouring pixels", own, [&](std::uint64_t seed, std::uint64_t i) {
      return error(seed, 2 * i + 1);
    });
    expect_uncorrelated(type, "neighbouring seeds", own, [&](std::uint64_t seed, std::uint64_t i) {
      return error(seed + 1, 2 * i);
    });
    expect_uncorrelated(type, "neighbouring pairs", own,
                        [&](std::uint64_t seed, std::uint64_t i) { return error(seed, 2 * i, 1); });
    expect_uncorrelated(type, "control/the same numbers", own, own, verify::Verdict::fail);
  }
}

/// Pairs of one sample: a product over two pairs has the mean of independent factors only if the
/// pairs are shuffled against each other.
TEST(SobolSampler, TheNumbersOfDifferentPairsOfOneSampleAreUncorrelated) {
  verify::MeanOptions options;
  options.subject = "sobol/(x - 1/2) of one pair times that of the next";
  options.reference = 0;
  options.relative = false;
  options.tolerance = 0.02 / 12;
  options.rounding_allowance = 1e-6;
  options.seed = check_seed(options.subject);
  expect_verdict(check_mean(options, [&](std::uint64_t begin, std::uint64_t count) {
    verify::Moments moments;
    for (std::uint64_t net = begin; net < begin + count; ++net) {
      double sum = 0;
      for (std::uint64_t i = 0; i < 64; ++i) {
        Sampler random(SamplerType::sobol, options.seed, net, i);
        const Vec2f u = random.next_2d();
        sum += (static_cast<double>(u.x) - 0.5) * (static_cast<double>(random.next_1d()) - 0.5);
      }
      moments.add(sum / 64);
    }
    return moments;
  }));
}

TEST(SobolSampler, ScramblesOf16PointsHaveFarLessVarianceThanIndependentOnes) {
  verify::VarianceRatioOptions options;
  options.subject = "x y over 16 points/independent over sobol";
  options.at_least = 10;
  options.seed = check_seed(options.subject);
  const auto batches = [&](SamplerType type) {
    std::vector<verify::Moments> result(32);
    for (std::uint64_t net = 0; net < 32'000; ++net) {
      result[net / 1000].add(error_of(type, options.seed, net, 0));
    }
    return result;
  };
  expect_verdict(check_variance_ratio(options, batches(SamplerType::independent),
                                      batches(SamplerType::sobol)));
}

}  // namespace
}  // namespace plumbline::tests
