#pragma once

#include <cstddef>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/verify/detail/random.h>

/// Inputs at which BSDF code loses its digits: grazing and normal incidence, critical angles, half
/// vectors along the surface or almost zero, random numbers at the ends of their range.
namespace plumbline::tests {

/// Unit vector with a given cosine to the normal, as exact as float allows.
renderer::Vec3f direction(double cosine, double azimuth);

/// Directions to look from, on both faces.
std::vector<renderer::Vec3f> hard_outgoing(verify::Random& random);

/// Directions that light comes from as seen from wo: samples of the BSDF, near its mirror and
/// refracted directions, along the surface, back where wo is, anywhere.
std::vector<renderer::Vec3f> hard_incoming(const renderer::BsdfRef& bsdf, const renderer::Vec3f& wo,
                                           std::size_t count, verify::Random& random);

/// Points of the unit square, most of them at its border.
std::vector<renderer::Vec2f> hard_numbers(std::size_t count, verify::Random& random);

}  // namespace plumbline::tests
