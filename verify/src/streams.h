#pragma once

#include <cstdint>

#include <plumbline/verify/detail/random.h>

namespace plumbline::verify {

/// The sequences of random numbers that one seed gives, one for each purpose: two that share a
/// number would look at the same points. A new purpose gets a number of its own; old numbers stay,
/// so that a seed replays what it did.
enum class Stream : std::uint64_t {
  pilot = 1,          ///< samples that shape bins and cells
  samples = 2,        ///< that chi-square counts
  jacobian = 3,       ///< uniform numbers to differentiate at
  pointwise = 4,      ///< samples and points of the pointwise checks
  reciprocity = 5,    ///< pairs of directions
  atoms_albedo = 6,   ///< samples that show which atoms there are
  channel = 7,        ///< samples that show the brightest channel
  atoms = 8,          ///< samples held to the laws of reflection and refraction
  views = 9,          ///< azimuths and random directions to look from
  rounding = 10,      ///< samples at which the rounding of the pdf is measured
  neighbours = 11,    ///< shifts by ulps
  rejected = 12,      ///< places on lines between which the borders of the rejected part are sought
  probes = 13,        ///< uniform numbers that show whether anything is rejected
  energy_pilot = 19,  ///< samples that shape the cells of an albedo
  own_nodes = 20,     ///< samples at which an integral's fit is corrected
  nodes = 21          ///< random points at which it is
};

inline Random random_for(std::uint64_t seed, Stream stream) {
  return Random(seed, static_cast<std::uint64_t>(stream));
}

}  // namespace plumbline::verify
