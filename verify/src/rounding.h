#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <plumbline/verify/detail/vector_access.h>

#include "streams.h"

/// When two numbers that should be one are equal: up to a stated tolerance, and beyond it as far as
/// the formula magnifies the rounding of what it is given.
namespace plumbline::verify {

/// Relative difference that two ways to compute one number may always have. What a formula of a few
/// dozen operations piles up (256 roundings); in double 1e-9, far below whatever a picture or a
/// sampling test shows and far above what 1 + (α² − 1)·cos² loses at α = 1e-3 (2^-52/α²).
inline double stated_tolerance(double epsilon) { return std::max(256 * epsilon, 1e-9); }

/// Smallest number of the code under test that has all its digits, after a sum of parts in which
/// some underflow may have lost theirs.
inline double smallest_with_digits(double epsilon) {
  return epsilon > 0x1p-40 ? 0x1p-126 / 0x1p-24 : 0x1p-1022 / 0x1p-53;
}

constexpr std::size_t kNeighbours = 32;
constexpr double kMostUlps = 8;
/// Roundings inside a formula that one of its arguments stands for.
constexpr double kRoundingsPerUlp = 16;

/// x with each component moved by up to 8 ulps at random: of itself, or of `least` where that is
/// more (1 for unit vectors, whose components come out of sums with larger ones; 0 for independent
/// coordinates).
inline Vec3 moved_by_ulps(const Vec3& x, double epsilon, double least, Random& random) {
  Vec3 moved;
  for (std::size_t i = 0; i < 3; ++i) {
    const double ulps = kMostUlps * (2 * random.uniform() - 1);
    moved[i] = x[i] + 2 * epsilon * ulps * std::max(std::abs(x[i]), x[i] == 0 ? 0 : least);
  }
  return moved;
}

/// What rounding does to f at the points x: its largest change over neighbours, all points moved at
/// once. Shows how steep f is in each component, and, because each neighbour rounds in another way,
/// what f loses by its own cancellation. Neighbours where f is not finite show nothing.
///
/// @param f  of the same number of points
template <std::size_t N, class F>
double spread_by_rounding(const std::array<Vec3, N>& x, double epsilon, double least, const F& f) {
  // The same moves everywhere: a check must not depend on how often it has asked before.
  Random random = random_for(0, Stream::neighbours);
  const double here = f(x);
  double spread = 0;
  for (std::size_t k = 0; k < kNeighbours; ++k) {
    std::array<Vec3, N> moved;
    for (std::size_t i = 0; i < N; ++i) moved[i] = moved_by_ulps(x[i], epsilon, least, random);
    const double change = std::abs(f(moved) - here);
    if (std::isfinite(change)) spread = std::max(spread, change);
  }
  return spread;
}

/// Whether a and b are equal up to the stated tolerance, or up to what rounding does to them.
///
/// @param spread  () to the sum of `spread_by_rounding` of both; asked only where it matters
template <class Spread>
bool equal_up_to_rounding(double a, double b, double epsilon, const Spread& spread) {
  const double difference = std::abs(a - b);
  const double allowed = stated_tolerance(epsilon) * std::max(std::abs(a), std::abs(b));
  if (difference <= allowed) return true;
  if (!std::isfinite(difference)) return false;
  return difference <= allowed + kRoundingsPerUlp * spread();
}

}  // namespace plumbline::verify
