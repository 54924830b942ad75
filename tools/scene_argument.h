#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <plumbline/analytic/known_scene.h>

/// What commands share that take scenes and their parameters.
namespace plumbline::tools {

/// Where the scene lies: the file of a known scene by its name, else the argument as a path.
///
/// @throws renderer::InputError for a name that is neither, with the nearest known one
std::filesystem::path scene_path(const std::string& argument);

/// @throws renderer::InputError for a name that no known scene has, with the nearest one
const analytic::KnownScene& known_scene(const std::string& name);

/// "k=v" as the command line gives them.
///
/// @throws renderer::InputError for a text without "=", and for a name that is given twice
std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& definitions);

/// Parameters of a closed form: one finite number each, or three for a colour.
///
/// @throws renderer::InputError for any other value
analytic::ParameterValues numeric_values(const std::map<std::string, std::string>& parameters);

}  // namespace plumbline::tools
