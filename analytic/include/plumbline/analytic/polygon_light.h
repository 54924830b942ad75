#pragma once

#include <vector>

#include <plumbline/analytic/camera.h>

/// Light from uniform polygons and cones on surfaces with a diffuse or Phong response.
namespace plumbline::analytic {

/// Corners in order, either way round, in one plane; convex.
using Polygon = std::vector<Vec3>;

/// Solid angle [sr] under which the part of a polygon above the horizon is seen.
///
/// @param normal  unit: what lies behind the plane through `point` across it is cut off
/// @source        Van Oosterom, Strackee 1983, Eq. 8, over a fan of triangles
double polygon_solid_angle(const Polygon& polygon, const Vec3& point, const Vec3& normal);

/// Irradiance from a polygon of radiance 1: ∫ cosθ dω over what is above the horizon, in [0, π].
/// The same from either side of the polygon.
///
/// E = ½ Σ Γᵢ n·(rᵢ × rᵢ₊₁)/|rᵢ × rᵢ₊₁|, Γᵢ the angle between neighbouring corners.
/// @source Lambert 1760; Arvo 1995, "Applications of irradiance tensors", Eq. 3
double polygon_irradiance(const Polygon& polygon, const Vec3& point, const Vec3& normal);

/// Double-axis moment ∫ (w·u)ⁿ (v·u) dω over the directions u towards a polygon with v·u > 0 and
/// w·u > 0.
///
/// @param normal    v, unit
/// @param axis      w, unit
/// @param exponent  n ≥ 0
/// @source          Arvo 1995, Section 4.2; derived anew in the source
double polygon_moment(const Polygon& polygon, const Vec3& point, const Vec3& normal,
                      const Vec3& axis, int exponent);

/// The same moment over a cone of directions, which must lie above the horizons of both axes.
///
/// With the axis of the cone along w: v·w 2π (1 − cosⁿ⁺²θ)/(n + 2).
/// @param center      unit
/// @param half_angle  θ in (0, π/2) [rad]
/// @throws std::invalid_argument where v·u or w·u is negative somewhere in the cone
double cone_moment(const Vec3& center, double half_angle, const Vec3& normal, const Vec3& axis,
                   int exponent);

}  // namespace plumbline::analytic
