#pragma once

#include <cstddef>
#include <memory>

#include <plumbline/renderer/core/scene/geometry.h>

namespace plumbline::renderer {

/// Up to here sixteen rays at a time against all primitives are faster than a tree. Measured with
/// `./run bench --only accelerators`: by AVX-512 always up to 128, by AVX2, which takes 1.6 times
/// as long, up to about this many.
inline constexpr std::size_t kMostForBruteForce = 64;

/// Whether every surface of a scene is one that sixteen rays can be held against in single
/// precision: what has to be exact (ExactShape) is Embree's.
bool brute_force_can_trace(const SceneGeometry& geometry);

/// All primitives, one after the other, against sixteen rays at once.
///
/// Of a flat surface a ray meets just what lies within its edges: where single precision does not
/// tell on which side of an edge it passes, double precision does, and two surfaces with a common
/// edge agree on it. Distances differ from Embree's by rounding. The same bits on every machine.
///
/// @param geometry  with its surfaces, which may not change after
/// @pre             brute_force_can_trace(geometry)
std::unique_ptr<RayEngine> make_brute_force(const SceneGeometry& geometry);

}  // namespace plumbline::renderer
