#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <plumbline/verify/joint.h>

#include "pairs/differences.h"

namespace plumbline::verify {

/// A density with its relative error, and what it is at least where the error is as large: of a
/// map that is flat, far more than any pdf says.
struct JointDensity {
  DensityAt near;
  double at_least = 0;
};

/// Density with which a map of as many numbers as dimensions spreads them around each u, per
/// product of the factors' measures: one over the Gram determinant of ∂x/∂u, by extrapolated
/// differences. nullopt where the map rejects nearby, or a factor does not move.
///
/// @param first_step  longest difference in u; a short one sees a seam only where it is very near
/// @source Ridders 1982 (Adv. Eng. Software 4:2)
std::vector<std::optional<JointDensity>> joint_densities_by_differences(
    const JointPair& pair, const std::vector<JointUniforms>& u, double first_step = 0x1p-4);

}  // namespace plumbline::verify
