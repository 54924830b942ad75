#pragma once

/// Light that something stands in the way of.
namespace plumbline::analytic {

/// Irradiance on the floor from the part x ≥ `from_x` of a disk that faces it, radiance 1.
///
/// E = ∫∫ H²/(H² + ρ²)² dA, ρ the lateral distance; the inner integral in closed form, the outer
/// one by adaptive quadrature to 1e-12.
///
/// @param radius      of the disk around (0, 0, height) [m], > 0
/// @param height      H over the floor [m], > 0
/// @param x, y        receiving point
/// @param from_x      −radius or less: the whole disk; radius or more: none of it
double disk_part_irradiance(double radius, double height, double x, double y, double from_x);

/// Irradiance from a whole disk: π/2 (1 − (H² + r² − R²)/√((H² + r² + R²)² − 4 r² R²)).
///
/// @param lateral  r of the receiving point
/// @source         Foote 1915 (Bull. Bureau of Standards 12); any table of view factors, B-13
double disk_irradiance(double radius, double height, double lateral);

/// A cone of directions around the sphere that fills it.
struct SphereCone {
  double x, y, z;     ///< unit, towards the centre; z along the receiver's normal
  double half_angle;  ///< [rad], (0, π/2)
};

/// Irradiance from the part of a spherical light that a spherical blocker in front does not cover,
/// radiance 1: the integral over rings around the light's axis, closed in azimuth.
///
/// @param light  wholly above the horizon
/// @return       error below 1e-7 of the light's full irradiance; exactly 0 where all is covered
/// @throws std::invalid_argument where the light dips below the horizon
double eclipsed_irradiance(const SphereCone& light, const SphereCone& blocker);

}  // namespace plumbline::analytic
