#pragma once

#include "pairs/binned_pair.h"

namespace plumbline::verify {

/// Share of the uniform numbers that the sampler rejects.
struct RejectedShare {
  double value = 0;
  double error = 0;       ///< at the level asked for
  bool measured = false;  ///< as an area of the unit square; else counted among samples
};

/// Where the probability of a pair is: ∫pdf + atoms + rejected should be 1.
struct MassBalance {
  double integral = 0, integral_error = 0;
  double atoms = 0;
  RejectedShare rejected;

  double excess() const { return integral + atoms + rejected.value - 1; }
  double error() const { return integral_error + rejected.error; }

  /// Share of rejected samples to expect: what is counted, as far as the balance leaves it room.
  double expected_rejected(double tolerance) const;
};

/// Area of the set of u that `sample` rejects, lobe by lobe where there are lobes. Not measured for
/// pairs of other than two numbers.
///
/// @param seed  of the random numbers that show where to look
RejectedShare measure_rejected(const SamplingPair& pair, std::uint64_t seed);

/// @param measured  by measure_rejected
/// @param level     two-sided, for the error of a counted share
MassBalance balance_mass(const BinnedPair& pair, const RejectedShare& measured, double level);

}  // namespace plumbline::verify
