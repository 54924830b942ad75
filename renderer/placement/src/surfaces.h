#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <plumbline/renderer/placement/placement.h>

namespace plumbline::renderer {

/// Corners in order; of a disk those of a polygon in it; none of a sphere.
std::vector<Vec3d> corners_of(const ExactShape& surface);

/// Half its shortest and half its longest side; the radius [m].
double size_of(const ExactShape& surface);
double reach_of(const ExactShape& surface);

/// At most the distance to it, and 0 on it [m].
double at_least_from(const ExactShape& surface, const Vec3d& p);

/// "scene.xml:12: <shape type="sphere">", as far as it is known.
std::string place_in_file(const PlacedParts& scene, std::size_t shape);

/// " of part.xml" for what an included file holds, else nothing.
std::string of_file(const std::filesystem::path& included);

/// "<shape type="sphere"> on line 12".
std::string name_of(const PlacedParts& scene, std::size_t shape);

/// Adds the surfaces that lie in one place to those that are exact.
void find_coincident(const PlacedParts& scene, Placement& placement);

}  // namespace plumbline::renderer
