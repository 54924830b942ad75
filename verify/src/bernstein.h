#pragma once

#include <cmath>

namespace plumbline::verify {

/// How far a sum of independent terms may be from its expectation, two-sided at a level.
///
/// @param second_moment  Σ of the squares of the terms: at least what they add to the variance
/// @param largest        term seen, in the place of a bound
/// @source Maurer, Pontil 2009 (COLT), Theorem 4
inline double bernstein(double second_moment, double largest, double level) {
  const double logarithm = std::log(2 / level);
  return std::sqrt(2 * second_moment * logarithm) + 7.0 / 3 * largest * logarithm;
}

}  // namespace plumbline::verify
