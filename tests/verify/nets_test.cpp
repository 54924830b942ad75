#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/dependent.h>
#include <plumbline/verify/mean.h>

namespace plumbline::verify {
namespace {

using tests::check_seed;
using tests::expect_verdict;

/// Options with the seed of the test.
template <class Options>
Options with_seed(const std::string& subject, Options options = {}) {
  options.seed = check_seed(subject);
  return options;
}

CheckResult declared(Verdict verdict, CheckResult result) {
  result.expected = verdict;
  return result;
}

/// Latin hypercubes: a permutation of the strata in each dimension, jittered.
///
/// @param jitter  of a random number in [0, 1)
template <class Jitter>
PointSets hypercube(std::string name, Jitter jitter) {
  PointSets sets{std::move(name), 3, {}};
  sets.points = [jitter](std::uint64_t replicate, std::size_t n) {
    Random random(replicate);
    std::vector<double> x(3 * n);
    std::vector<std::size_t> strata(n);
    for (std::size_t d = 0; d < 3; ++d) {
      std::iota(strata.begin(), strata.end(), std::size_t{0});
      std::shuffle(strata.begin(), strata.end(), random);
      for (std::size_t i = 0; i < n; ++i) {
        x[3 * i + d] =
            (static_cast<double>(strata[i]) + jitter(random.uniform())) / static_cast<double>(n);
      }
    }
    return x;
  };
  return sets;
}

/// φ_b(i): the digits of i behind the point, each added to the one of a shift modulo b.
///
/// @source Niederreiter 1992, Definition 3.1
double radical_inverse(std::uint64_t i, std::uint64_t base, std::uint64_t shift, int digits) {
  double value = 0, place = 1;
  for (int k = 0; k < digits; ++k) {
    place /= static_cast<double>(base);
    value += static_cast<double>((i % base + shift % base) % base) * place;
    i /= base, shift /= base;
  }
  return value;
}

enum class Scramble { none, both_alike, digits, rotation };

/// Hammersley's points: (i/b^m, φ_b(i)), a (0, m, 2)-net.
PointSets hammersley(std::string name, std::uint64_t base, Scramble scramble) {
  PointSets sets{std::move(name), 2, {}};
  sets.points = [base, scramble](std::uint64_t replicate, std::size_t n) {
    constexpr int kDigits = 30;
    Random random(replicate);
    std::uint64_t shift = random.bits() >> 2, other_shift = random.bits() >> 2;
    if (scramble == Scramble::none || scramble == Scramble::rotation) shift = other_shift = 0;
    if (scramble == Scramble::both_alike) other_shift = shift;
    const double by_x = random.uniform(), by_y = random.uniform();
    std::vector<double> x;
    int m = 0;
    for (std::size_t power = 1; power < n; power *= base) ++m;
    for (std::size_t i = 0; i < n; ++i) {
      // i/b^m is φ of i with its m digits reversed.
      std::uint64_t reversed = 0;
      std::size_t rest = i;
      for (int k = 0; k < m; ++k) reversed = reversed * base + rest % base, rest /= base;
      double u = radical_inverse(reversed, base, shift, kDigits);
      double v = radical_inverse(i, base, other_shift, kDigits);
      if (scramble == Scramble::rotation) {
        u += by_x, v += by_y;
        u -= u >= 1 ? 1 : 0, v -= v >= 1 ? 1 : 0;
      }
      x.push_back(u), x.push_back(v);
    }
    return x;
  };
  return sets;
}

PointSets halton() {
  PointSets sets{"halton", 2, {}};
  sets.points = [](std::uint64_t, std::size_t n) {
    std::vector<double> x;
    for (std::size_t i = 0; i < n; ++i) {
      x.push_back(radical_inverse(i, 2, 0, 24));
      x.push_back(radical_inverse(i, 3, 0, 15));
    }
    return x;
  };
  return sets;
}

PointSets independent_sets() {
  PointSets sets{"independent", 2, {}};
  sets.points = [](std::uint64_t replicate, std::size_t n) {
    Random random(replicate);
    std::vector<double> x(2 * n);
    for (double& value : x) value = random.uniform();
    return x;
  };
  return sets;
}

const auto kEven = [](double u) { return u; };

TEST(Strata, AreFilledByALatinHypercubeAndNotByIndependentPoints) {
  const auto o = with_seed<StratifiedOptions>("strata", {{}, 100, 16});
  expect_verdict(check_stratified(hypercube("hypercube", kEven), o));
  expect_verdict(declared(Verdict::fail, check_stratified(independent_sets(), o)));
}

TEST(Strata, APointThatIsRoundedUpToOneFails) {
  const auto o = with_seed<StratifiedOptions>("strata, rounded", {{}, 64, 16});
  const CheckResult r =
      check_stratified(hypercube("rounded", [](double u) { return u > 0.9 ? 1.0 : u; }), o);
  expect_verdict(declared(Verdict::fail, r));
}

TEST(Strata, AnEdgeBelongsToTheStratumThatItBegins) {
  const auto o = with_seed<StratifiedOptions>("strata, edges", {{}, 64, 16});
  expect_verdict(check_stratified(hypercube("edges", [](double) { return 0.0; }), o));
}

TEST(Net, HammersleysPointsAreNetsInTheirBase) {
  expect_verdict(
      check_net(hammersley("base 2", 2, Scramble::digits), with_seed<NetOptions>("net, base 2")));
  NetOptions three = with_seed<NetOptions>("net, base 3");
  three.base = 3;
  three.m = 5;
  expect_verdict(check_net(hammersley("base 3", 3, Scramble::none), three));
}

TEST(Net, OtherPointsAreNone) {
  const auto o = with_seed<NetOptions>("net, other points");
  expect_verdict(declared(Verdict::fail, check_net(independent_sets(), o)));
  expect_verdict(declared(Verdict::fail, check_net(halton(), o)));
  expect_verdict(declared(Verdict::fail, check_net(hypercube("hypercube", kEven), o)));
  // A rotation leaves strata and takes elementary intervals apart.
  const PointSets rotated = hammersley("rotated", 2, Scramble::rotation);
  expect_verdict(declared(Verdict::fail, check_net(rotated, o)));
}

TEST(Net, OneWrongBitOfOneIndexIsFound) {
  PointSets sets = hammersley("one bit", 2, Scramble::digits);
  sets.points = [right = sets.points](std::uint64_t replicate, std::size_t n) {
    std::vector<double> x = right(replicate, n);
    double& y = x[2 * (n / 3) + 1];
    y += y < 0.5 ? 0.5 : -0.5;
    return x;
  };
  expect_verdict(
      declared(Verdict::fail, check_net(sets, with_seed<NetOptions>("net, one wrong bit"))));
}

TEST(Net, ALowerQualityIsEnoughWhereItIsClaimed) {
  // Three dimensions of which two are Hammersley's and the third the first again: no interval of
  // 2^-1 × 1 × 2^-1 holds its share, so that t = m is all that can be claimed.
  PointSets sets = hammersley("twice", 2, Scramble::digits);
  sets.dimensions = 3;
  sets.points = [pairs = sets.points](std::uint64_t replicate, std::size_t n) {
    const std::vector<double> two = pairs(replicate, n);
    std::vector<double> three;
    for (std::size_t i = 0; i < n; ++i) {
      three.insert(three.end(), {two[2 * i], two[2 * i + 1], two[2 * i]});
    }
    return three;
  };
  NetOptions o = with_seed<NetOptions>("net, quality");
  o.m = 6;
  o.group = 0;
  o.t = o.m - 2;
  expect_verdict(declared(Verdict::fail, check_net(sets, o)));
  o.t = o.m - 1;
  expect_verdict(check_net(sets, o));
}

TEST(Net, ASequenceIsANetInEachBlock) {
  // (φ_2(i), φ_2(i) by Pascal's matrix) is Sobol's sequence; Hammersley's first coordinate is a net
  // as a whole only.
  NetOptions o = with_seed<NetOptions>("net, sequence");
  o.sequence = true;
  expect_verdict(declared(Verdict::fail, check_net(hammersley("set", 2, Scramble::digits), o)));
  PointSets sobol{"sobol", 2, {}};
  sobol.points = [](std::uint64_t, std::size_t n) {
    std::vector<double> x;
    for (std::uint64_t i = 0; i < n; ++i) {
      std::uint64_t column = 1, bits = 0;  // Pascal's triangle modulo 2, the first digit lowest
      for (std::uint64_t rest = i; rest != 0; rest >>= 1, column ^= column << 1) {
        if ((rest & 1) != 0) bits ^= column;
      }
      x.push_back(radical_inverse(i, 2, 0, 30));
      x.push_back(radical_inverse(bits, 2, 0, 30));
    }
    return x;
  };
  expect_verdict(check_net(sobol, o));
}

TEST(Replicates, ARandomisationThatMakesEachPointUniformPasses) {
  expect_verdict(check_replicates(hypercube("hypercube", kEven),
                                  with_seed<ReplicateOptions>("replicates, hypercube")));
  expect_verdict(check_replicates(hammersley("digits", 2, Scramble::digits),
                                  with_seed<ReplicateOptions>("replicates, digits")));
  expect_verdict(check_replicates(hammersley("rotation", 2, Scramble::rotation),
                                  with_seed<ReplicateOptions>("replicates, rotation")));
}

TEST(Replicates, ARandomisationThatDoesNotIsFound) {
  const auto fails = [](const PointSets& sets) {
    const auto o = with_seed<ReplicateOptions>("replicates, " + sets.name);
    expect_verdict(declared(Verdict::fail, check_replicates(sets, o)));
  };
  fails(hammersley("none", 2, Scramble::none));
  fails(hammersley("alike", 2, Scramble::both_alike));  // each dimension by itself is uniform
  fails(hypercube("jitter too short", [](double u) { return 0.9 * u; }));
  fails(hypercube("outside", [](double u) { return u > 0.5 ? 64.0 : u; }));
}

CheckResult mean_of_product(const PointSets& sets, const std::string& subject, Verdict expected) {
  MeanOptions o;
  o.subject = subject;
  o.reference = 0.25;  // ∫∫ x y
  o.seed = check_seed(subject);
  o.expected = expected;
  return check_mean(o,
                    replicate_means(
                        sets, 16, [](std::span<const double> x) { return x[0] * x[1]; }, o.seed));
}

TEST(Replicates, GiveIndependentMeans) {
  const PointSets right = hammersley("digits", 2, Scramble::digits);
  const CheckResult r = mean_of_product(right, "replicates/mean", Verdict::pass);
  expect_verdict(r);
  // Always the same mean: no number of replicates makes it right.
  const PointSets none = hammersley("none", 2, Scramble::none);
  expect_verdict(mean_of_product(none, "replicates/mean, none", Verdict::fail));
}

TEST(Nets, RefuseWhatMakesNoSense) {
  PointSets wrong{"wrong", 2, [](std::uint64_t, std::size_t) { return std::vector<double>(3); }};
  EXPECT_THROW(check_net(wrong), std::invalid_argument);
  EXPECT_THROW(check_stratified(wrong), std::invalid_argument);
  EXPECT_THROW(check_replicates(wrong), std::invalid_argument);
  EXPECT_THROW(check_net(PointSets{}), std::invalid_argument);
  NetOptions o;
  o.m = 30;
  EXPECT_THROW(check_net(independent_sets(), o), std::invalid_argument);
  o.base = 1;
  EXPECT_THROW(check_net(independent_sets(), o), std::invalid_argument);
  ReplicateOptions few;
  few.replicates = 100;
  EXPECT_THROW(check_replicates(independent_sets(), few), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::verify
