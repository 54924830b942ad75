#include "scene_argument.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <system_error>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/nearest_name.h>

namespace plumbline::tools {
namespace {

std::string hint_for(const std::string& name) {
  std::vector<std::string> known;
  for (const analytic::KnownScene& scene : analytic::known_scenes()) known.emplace_back(scene.name);
  return renderer::name_hint(name, known);
}

}  // namespace

std::filesystem::path scene_path(const std::string& argument) {
  if (analytic::find_known_scene(argument)) return analytic::scene_file(argument);
  const std::filesystem::path path(argument);
  std::error_code ignored;
  if (!path.has_extension() && !path.has_parent_path() && !std::filesystem::exists(path, ignored)) {
    throw renderer::InputError(fmt::format("{}: neither a scene file nor a known scene; {}",
                                           argument, hint_for(argument)));
  }
  return path;
}

const analytic::KnownScene& known_scene(const std::string& name) {
  if (const analytic::KnownScene* scene = analytic::find_known_scene(name)) return *scene;
  throw renderer::InputError(
      fmt::format("no closed form is known for a scene \"{}\"; {}", name, hint_for(name)));
}

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& definitions) {
  std::map<std::string, std::string> result;
  for (const std::string& definition : definitions) {
    const std::size_t equals = definition.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw renderer::InputError(fmt::format("-D {}: must read name=value", definition));
    }
    const std::string name = definition.substr(0, equals);
    if (!result.emplace(name, definition.substr(equals + 1)).second) {
      throw renderer::InputError(fmt::format("-D {}: {} is set twice", definition, name));
    }
  }
  return result;
}

analytic::ParameterValues numeric_values(const std::map<std::string, std::string>& parameters) {
  analytic::ParameterValues values;
  for (const auto& [name, text] : parameters) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) {
      throw renderer::InputError(
          fmt::format("parameter {}={}: the closed form needs one finite number", name, text));
    }
    values.emplace(name, value);
  }
  return values;
}

}  // namespace plumbline::tools
