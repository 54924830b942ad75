#pragma once

#include <cstdint>

#include <plumbline/verify/pair.h>

namespace plumbline::verify {

/// Share of the random numbers that a sampler rejects, unbiased, with its sampling error.
struct RejectedShare {
  double value = 0;
  double variance = 0;      ///< of `value`
  double largest_term = 0;  ///< that one random point added to it
  double points = 0;        ///< random points that it rests on

  /// |value − truth| ≤ this with probability 1 − level. What none of the points has shown has a
  /// share of at most −ln(level)/points.
  double error(double level) const;

  RejectedShare scaled(double factor) const;
};

/// Measures the share until it is known well enough for the promise of the integral check, or a few
/// million random numbers are spent: along lines, whose borders are bisected, where the sampler
/// takes one or two numbers; on a jittered grid for three; by counting for a generator.
///
/// @param mass_error  what the integral is known to at 99.9 %: lines cost little, and reach it
RejectedShare measure_rejected(const SamplingPair& pair, const ContractOptions& options,
                               double mass_error);

}  // namespace plumbline::verify
