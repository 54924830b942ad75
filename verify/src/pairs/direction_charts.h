#pragma once

#include <plumbline/verify/detail/domain.h>

namespace plumbline::verify {

/// Square = ((1 − z)/2, φ/2π) on the sphere, and the same stretched on a hemisphere.
///
/// @param first, last  of (1 − z)/2, the part that the domain covers
std::shared_ptr<const Chart> direction_chart(double first, double last);

/// Square = (θ/π, φ/2π).
std::shared_ptr<const Chart> latitude_chart(const Vec3& up, const Vec3& start);

/// Square of an octahedral map.
std::shared_ptr<const Chart> octahedral_chart();

}  // namespace plumbline::verify
