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
  lobe_seeds = 14,    ///< seeds of the lobes' own
  inverse = 15,       ///< numbers and points of the round trip
  purity = 16,        ///< numbers and directions that code is asked about twice
  energy_pilot = 19,  ///< samples that shape the cells of an albedo
  own_nodes = 20,     ///< samples at which an integral's fit is corrected
  nodes = 21,         ///< random points at which it is

  // Of pairs on products of domains.
  joint_pilot = 70,      ///< samples that shape bins and cells
  joint_samples = 71,    ///< that chi-square counts
  joint_own_nodes = 72,  ///< samples at which an integral's fit is corrected
  joint_nodes = 73,      ///< random points at which it is
  joint_rejected = 74,   ///< that show the rejected share
  joint_rounding = 75,   ///< samples at which the rounding of the pdf is measured
  joint_points = 76,     ///< samples and points of the pointwise checks
  joint_jacobian = 77,   ///< uniform numbers to differentiate at

  // Of a diagnosis, which has one seed: the same report gets the same cause.
  asked = 40,           ///< samples that are asked about twice, or looked at as they are
  asked_between = 41,   ///< what is asked between two times
  groups = 42,          ///< samples that lie next to each other
  sides = 43,           ///< samples left and right of the plane of incidence
  empty_cells = 44,     ///< samples that show where none fall
  part_points = 47,     ///< points of a part, for its equations
  part_accepted = 48,   ///< numbers that show what a part rejects
  part_numbers = 49,    ///< numbers that show which ones a part uses
  part_lines = 50,      ///< lines on which a number jumps
  branch_points = 51,   ///< points that several numbers may lead to
  part_latitudes = 52,  ///< samples that show where a part lies
  mean_direction = 53,  ///< samples of a generator
  discrete = 54,        ///< samples of a set, counted again
  atom_shares = 55,     ///< samples that show how often an atom is chosen
  consumed = 56,        ///< numbers that a sampler with a generator takes

  // Of BSDFs that answer at random.
  stochastic_views = 80,         ///< azimuths to look from
  stochastic_pilot = 81,         ///< samples that shape regions
  stochastic_samples = 82,       ///< that regions are held to
  stochastic_points = 83,        ///< at which eval and pdf are asked
  stochastic_lights = 84,        ///< where the lights are
  stochastic_mis = 85,           ///< multiple importance samples
  stochastic_light_points = 86,  ///< the same light without the BSDF
  stochastic_there = 87,         ///< pairs of directions, one way
  stochastic_back = 88,          ///< others, the other way
  stochastic_albedo = 89,        ///< samples of a known albedo

  // Of samples that depend on each other.
  replicates = 90,            ///< the first of the replicates' numbers
  contribution_pilot = 91,    ///< samples that shape regions
  contribution_samples = 92,  ///< points with their weights
  contribution_points = 93,   ///< at which the functions are integrated
  chains_pilot = 94,          ///< starting points that shape regions
  chains = 95,                ///< chains that have made steps
  chains_start = 96,          ///< chains that have made none

  // Of histories.
  nights = 100  ///< permutations of nights
};

inline Random random_for(std::uint64_t seed, Stream stream) {
  return Random(seed, static_cast<std::uint64_t>(stream));
}

/// For a diagnosis.
inline Random random_for(Stream stream) { return random_for(0x5eed, stream); }

}  // namespace plumbline::verify
