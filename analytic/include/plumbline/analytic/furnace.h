#pragma once

namespace plumbline::analytic {

/// Radiance seen from inside any closed diffuse surface that emits `radiance` and reflects `albedo`
/// everywhere.
///
/// L = Le + (albedo/π) ∫ L cosθ dω over the hemisphere, and by symmetry of the answer L is the same
/// constant everywhere: L = Le + albedo·L, so L = Le/(1 − albedo). A path of at most k vertices
/// carries the first k terms of the Neumann series: L = Le Σ_{i<k} albedo^i.
///
/// @param albedo     [0, 1]; 1 only with a finite depth
/// @param radiance   Le ≥ 0 [W/(m² sr)]
/// @param max_depth  k, counted as in Mitsuba 3 (1 = emission alone, 0 = black); −1 is unlimited
/// @throws std::invalid_argument outside these ranges
double closed_furnace_radiance(double albedo, double radiance, int max_depth);

/// Radiance of a convex Lambertian object in a constant environment.
///
/// No point of a convex object sees another, so the incident radiance is Le over the whole
/// hemisphere: L = (albedo/π) Le ∫ cosθ dω = albedo·Le, from depth 2 on; black below.
///
/// @param albedo     [0, 1]
/// @param radiance   Le ≥ 0 [W/(m² sr)]
/// @param max_depth  as above
/// @throws std::invalid_argument outside these ranges
double open_furnace_radiance(double albedo, double radiance, int max_depth);

}  // namespace plumbline::analytic
