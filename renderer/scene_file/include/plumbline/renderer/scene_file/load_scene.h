#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/renderer/assembly/description.h>

namespace plumbline::renderer {

/// Reads a scene file in the subset of Mitsuba 3's XML that docs/scene_format.md lists.
///
/// @param overrides  values for the file's <default> parameters, by name (the command's -D)
/// @param size       film size in place of the file's; the field of view stays along its axis
/// @throws InputError "file:line: what and why" for anything outside the subset, naming the element
///         or attribute and the nearest supported name; never crashes or hangs on hostile input
SceneDescription load_scene(const std::filesystem::path& file,
                            const std::map<std::string, std::string>& overrides = {},
                            std::optional<FilmSize> size = std::nullopt);

/// Everything for which load_scene would refuse a file, in the order of files and lines: what is
/// wrong in one element does not hide the next.
///
/// @return  lines "file:line: what and what to do", a thousand at most; none where it takes the
/// file
std::vector<std::string> check_scene(const std::filesystem::path& file,
                                     const std::map<std::string, std::string>& overrides = {});

/// A property, as the tables of docs/scene_format.md have it.
struct SupportedProperty {
  std::string name;
  std::string kind;    ///< the element that gives it, "float or string"; "object" for a nested one
  std::string absent;  ///< the default, or "required"
  std::string range;   ///< "0 to 1"; empty where every value of the kind is taken
};

struct SupportedType {
  std::string name;
  std::vector<SupportedProperty> properties;
};

/// The types that a scene file may name for an element: "sphere", "rectangle", … for "shape".
/// Empty for an element that has no type.
std::vector<SupportedType> supported_types(std::string_view tag);

}  // namespace plumbline::renderer
