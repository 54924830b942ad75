#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <plumbline/renderer/scene/description.h>

namespace plumbline::renderer {

/// Reads a scene file in the subset of Mitsuba 3's XML that docs/scene_format.md lists.
///
/// @param overrides  values for the file's <default> parameters, by name (the command's -D)
/// @throws InputError "file:line: what and why" for anything outside the subset, naming the element
/// or
///         attribute and the nearest supported name; never crashes or hangs on hostile input
SceneDescription load_scene(const std::filesystem::path& file,
                            const std::map<std::string, std::string>& overrides = {});

}  // namespace plumbline::renderer
