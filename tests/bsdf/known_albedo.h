#pragma once

#include <cstddef>

#include "examples.h"

namespace plumbline::tests {

/// Share of the power that a BSDF gives back in one channel (0 red, 1 green, 2 blue), worked out by
/// `analytic` from the parameters alone: closed forms for plane interfaces, quadrature over normals
/// or lobes for the rest. Radiance across a refraction is (η_o/η_i)² times its power.
double known_albedo(const Example& example, const renderer::Vec3d& wo, std::size_t channel);

/// How far, in units of the albedo, a model may be from `known_albedo` by construction: what the
/// clear coat's table of its own albedo is off by between its nodes, and nothing (1e-3 for the
/// cubature) elsewhere.
double albedo_tolerance(const Example& example);

}  // namespace plumbline::tests
