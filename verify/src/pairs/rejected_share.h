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
  /// What one rejected point of a part that has shown none would have added.
  double unseen_term = 0;

  /// |value − truth| ≤ this with probability 1 − level. A part of which n points have shown nothing
  /// has a share of at most −ln(level)/n of its own.
  double error(double level) const;

  RejectedShare scaled(double factor) const;

  /// Adds the share of another part, measured independently.
  void add(const RejectedShare& part);
};

/// Measures the share until it is known well enough for the promise of the integral check, or a few
/// million random numbers are spent: along lines, whose borders are bisected, where the sampler
/// takes one or two numbers; on a jittered grid for three; by counting for a generator.
///
/// @param mass_error  what the integral is known to at 99.9 %: lines cost little, and reach it
RejectedShare measure_rejected(const SamplingPair& pair, const ContractOptions& options,
                               double mass_error);

}  // namespace plumbline::verify
