#pragma once

#include <string>

#include <plumbline/renderer/core/scene/geometry.h>

/// What a ray really meets, in quad precision: who is right where two engines differ.
namespace plumbline::tests {

/// Bounds of what single precision may do to an answer, in units of 2⁻²⁴ of the lengths that enter
/// it (judge.cpp has them): of a distance, and of where a round surface ends. Of flat surfaces the
/// edges are exact but for double precision. The worst case: a plane's distance has 5 roundings in
/// its numerator and 4 in the cosine; a sphere's middle 9, its half chord 5 more; a disk's outline
/// 6 beside those of its distance. Measured over 8e7 rays: 1.9.
inline constexpr double kMostUlps = 16;

/// An answer; `kind` is RTC_INVALID_GEOMETRY_ID for a miss.
using Answer = renderer::PrimitiveHit;

/// Holds an answer against all primitives, in quad precision.
///
/// @param most_ulps  bound that it is held to
/// @return           what is wrong with it; empty where it is right: it names the nearest surface
///                   that the ray meets, and its distance, where rounding within the bounds decides
///                   on neither
std::string fault_of(const renderer::SceneGeometry& geometry, const renderer::Ray& ray,
                     const Answer& answer, double most_ulps = kMostUlps);

/// How far the distance of a hit is from the exact one, in the units above.
double distance_error(const renderer::SceneGeometry& geometry, const renderer::Ray& ray,
                      const Answer& answer);

}  // namespace plumbline::tests
