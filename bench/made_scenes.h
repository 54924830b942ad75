#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <plumbline/renderer/assembly/description.h>

/// Scenes that no file holds: as large as one asks for.
namespace plumbline::bench {

/// A sphere with bumps of every size down to its triangles, over a floor, under a rectangular
/// light; diffuse, at most 6 bounces.
///
/// @param triangles  about so many, ≥ 100
renderer::SceneDescription displaced_sphere(std::size_t triangles);

/// Small spheres at random places in a cube, floor, light and depth as above.
renderer::SceneDescription many_spheres(std::size_t spheres);

/// A floor under `lights` small spheres of equal power, the same in sum whatever their number;
/// direct light only.
renderer::SceneDescription many_lights(std::size_t lights);

/// The scene of that name: "displaced_sphere", of a million triangles, or "many_spheres", 100,000.
std::optional<renderer::SceneDescription> made_scene(const std::string& name);

}  // namespace plumbline::bench
