#pragma once

#include <optional>
#include <span>
#include <vector>

#include <plumbline/verify/pair.h>

namespace plumbline::verify {

/// A map from uniform numbers to points, without its weights.
using Map = Many<std::optional<SampleRecord>(Uniforms)>;

/// A density at a point, with its relative error.
struct DensityAt {
  double value = 0;
  double relative_error = 0;
};

/// What a density by differences may be off by, relative, whatever it says of its own error: more
/// where the map is rounded to float.
inline double tolerance_of_differences(double epsilon) { return epsilon > 0x1p-40 ? 5e-3 : 1e-4; }

/// Density with which a map spreads uniform numbers around u: 1/|∂x/∂u| by extrapolated
/// differences. nullopt where the map rejects or has atoms nearby, or is flat.
///
/// @param dimension   of the domain, 1 or 2
/// @param epsilon     rounding unit of the map
/// @param first_step  longest difference in u; a short one sees a seam only where it is very near
/// @source Ridders 1982 (Adv. Eng. Software 4:2)
std::optional<DensityAt> density_by_differences(const Map& map, const Uniforms& u, int dimension,
                                                double epsilon, double first_step = 0x1p-4);

/// The same at many u, all of whose differences are asked for at once.
std::vector<std::optional<DensityAt>> densities_by_differences(const Map& map,
                                                               std::span<const Uniforms> u,
                                                               int dimension, double epsilon,
                                                               double first_step = 0x1p-4);

/// The same from one side of u in each number, away from a seam on the other: at each u, of every
/// choice of sides that gives one. Each derivative is taken at the step that leaves it the smallest
/// error.
std::vector<std::vector<DensityAt>> densities_on_one_side(const Map& map,
                                                          std::span<const Uniforms> u,
                                                          int dimension, double epsilon);

}  // namespace plumbline::verify
