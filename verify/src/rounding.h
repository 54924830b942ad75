#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <plumbline/verify/detail/vector_access.h>

#include "streams.h"
#include "vec3.h"

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

/// What the points are that a function is asked at.
enum class Coordinates {
  directions,  ///< unit vectors: components come out of sums with larger ones
  independent  ///< each has its own magnitude
};

inline constexpr std::size_t kNeighbours = 32;

/// Moves of points by random shares of a distance.
class Moves {
 public:
  explicit Moves(Coordinates coordinates) : coordinates_(coordinates) {}

  template <std::size_t N>
  std::array<Vec3, N> draw(const std::array<Vec3, N>& x, double distance) {
    std::array<Vec3, N> moves{};
    for (std::size_t p = 0; p < N; ++p) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double unit = coordinates_ == Coordinates::directions ? 1 : std::abs(x[p][i]);
        moves[p][i] = distance * (2 * random_.uniform() - 1) * unit;
      }
    }
    return moves;
  }

 private:
  Coordinates coordinates_;
  // The same moves everywhere: a check must not depend on how often it has asked before.
  Random random_ = random_for(0, Stream::neighbours);
};

template <std::size_t N>
std::array<Vec3, N> moved(const std::array<Vec3, N>& x, const std::array<Vec3, N>& by,
                          double times) {
  std::array<Vec3, N> y;
  for (std::size_t p = 0; p < N; ++p) y[p] = sum(x[p], scaled(by[p], times));
  return y;
}

/// What rounding does to f at the points x, all of which are moved at once:
///
/// - its largest change over neighbours within 8 ulps: how steep f is in each component, and what
///   it loses by cancellation wherever a neighbour rounds in another way;
/// - its largest second difference over √(8ε), the angle whose cosine is 1 − 4ε: what a formula
///   loses that knows an angle by its cosine only, like 1 + (α² − 1)·cos² at its peak, where every
///   neighbour within ulps rounds in the same way. It is ε·f'', and so next to nothing where f is
///   smooth on a scale of more than √ε.
///
/// Neighbours where f is not finite show nothing.
///
/// @param f  of many places, each of the same number of points, to a vector of numbers
template <std::size_t N, class F>
double spread_by_rounding(const std::array<Vec3, N>& x, double epsilon, Coordinates coordinates,
                          const F& f) {
  Moves moves(coordinates);
  std::vector<std::array<Vec3, N>> places{x};
  for (std::size_t k = 0; k < kNeighbours; ++k) {
    places.push_back(moved(x, moves.draw(x, 16 * epsilon), 1));
    const auto by = moves.draw(x, std::sqrt(8 * epsilon));
    places.push_back(moved(x, by, 1));
    places.push_back(moved(x, by, -1));
  }
  const std::vector<double> values = f(places);
  double spread = 0;
  const auto see = [&spread](double change) {
    if (std::isfinite(change)) spread = std::max(spread, std::abs(change));
  };
  for (std::size_t k = 0; k < kNeighbours; ++k) {
    see(values[3 * k + 1] - values[0]);
    see(values[3 * k + 2] + values[3 * k + 3] - 2 * values[0]);
  }
  return spread;
}

/// Whether a and b are equal up to the stated tolerance, or up to what rounding does to them.
///
/// Of 1e6 pairs of directions on rough mirrors and glasses (α = 1e-4 to 1, textbook D and a stable
/// one, float and double), none had f both ways more than 0.08 of the sum of both spreads apart.
///
/// @param spread  () to the sum of `spread_by_rounding` of both; asked only where it matters
template <class Spread>
bool equal_up_to_rounding(double a, double b, double epsilon, const Spread& spread) {
  const double difference = std::abs(a - b);
  const double allowed = stated_tolerance(epsilon) * std::max(std::abs(a), std::abs(b));
  if (difference <= allowed) return true;
  if (!std::isfinite(difference)) return false;
  return difference <= allowed + spread();
}

}  // namespace plumbline::verify
