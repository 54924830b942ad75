#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace plumbline::verify::history {

/// How the distributions of two groups of nights differ.
struct DistributionShift {
  double energy_distance = 0;  ///< between the groups, in units of the values; about 0 if none
  double larger = 0.5;         ///< chance that a value after exceeds one before, ties counted half
  double p_value = 1;          ///< of nights that could as well stand in any order
};

/// Whether the nights after a point have another distribution than those before it: the energy
/// distance, with the p-value of a permutation of whole nights.
///
/// Values of one night may depend on each other in any way: they stay together, and each night
/// counts alike, however many values it has. Nights that depend on their neighbours make the
/// p-value too small: `judge_history` is calibrated with such.
///
/// @param before, after  nights, each with at least one finite value; at least two nights each
/// @param permutations   drawn, ≥ 1; where there are no more than that, all are counted
/// @param seed           of the drawn permutations
/// @throws std::invalid_argument for too few nights, empty ones or values that are not finite
/// @source Székely, Rizzo 2004 (InterStat), energy distance with its permutation test
DistributionShift distribution_shift(std::span<const std::vector<double>> before,
                                     std::span<const std::vector<double>> after,
                                     int permutations = 999, std::uint64_t seed = 1);

}  // namespace plumbline::verify::history
