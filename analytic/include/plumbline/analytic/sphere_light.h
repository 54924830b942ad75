#pragma once

namespace plumbline::analytic {

/// Irradiance on a plane from a uniform sphere of radiance 1 [sr projected; times L gives W/m²].
///
/// The sphere may stand wholly above the plane, dip into it, or lie below; what is below the plane
/// sends nothing. The formula and its derivation stand in the source.
///
/// @param radius   R > 0 [m]
/// @param height   of the centre over the plane [m]; any sign
/// @param lateral  distance of the receiving point from the foot of the centre [m], ≥ 0
/// @return E/L in [0, π]; 0 inside the sphere, which emits outwards only. Relative error below
///         1e-13 for height ≥ 0; below 0 the error is 1e-13 of the unclipped value
/// @source Snyder 1996 (Microsoft TR-96-11), here derived from Lambert's boundary formula
double sphere_irradiance(double radius, double height, double lateral);

/// Mean of `sphere_irradiance` over the rectangle [x0, x1] × [y0, y1] of the plane, when the sphere
/// stands wholly above it (height ≥ radius) over the origin.
///
/// E/L = π R² h/d³ there, and ∫∫ h/d³ dx dy is the solid angle of the rectangle seen from the
/// centre.
double sphere_irradiance_mean_above(double radius, double height, double x0, double x1, double y0,
                                    double y1);

}  // namespace plumbline::analytic
