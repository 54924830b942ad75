#include "scene_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <vector>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/nearest_name.h>

namespace plumbline::tools {
namespace {

std::string hint_for(const std::string& name) {
  std::vector<std::string> known;
  for (const analytic::KnownScene& scene : analytic::known_scenes()) known.emplace_back(scene.name);
  return renderer::name_hint(name, known);
}

/// The numbers of a list with commas or spaces between them, as in scene files; none where anything
/// else stands in it.
std::vector<double> finite_numbers(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto is_separator = [](char c) { return c == ',' || c == ' '; };
  while (at != end) {
    double value = 0;
    const auto parsed = std::from_chars(at, end, value);
    if (parsed.ec != std::errc() || !std::isfinite(value)) return {};
    numbers.push_back(value);
    at = std::find_if_not(parsed.ptr, end, is_separator);
    if (at == parsed.ptr && at != end) return {};
  }
  return numbers;
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
    const auto numbers = finite_numbers(text);
    if (numbers.size() == 1) {
      values.emplace(name, numbers[0]);
    } else if (numbers.size() == 3) {
      values.emplace(name, analytic::Colour(numbers[0], numbers[1], numbers[2]));
    } else {
      throw renderer::InputError(fmt::format(
          "parameter {}={}: the closed form needs one finite number, or three", name, text));
    }
  }
  return values;
}

}  // namespace plumbline::tools
