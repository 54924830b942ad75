#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/core/render/path.h>
#include <plumbline/renderer/scene_file/load_scene.h>

/// Values of the options of `render`, from the text on the command line.
namespace plumbline::tools {

/// The names that an option takes.
template <class Values>
std::vector<std::string> names_of(const Values& values) {
  std::vector<std::string> names;
  names.reserve(std::size(values));
  for (const auto value : values) names.emplace_back(name(value));
  return names;
}

/// What `parse_name` throws: what was written, and the name that was meant or all that there are.
renderer::InputError unknown_name(std::string_view option, std::string_view kind,
                                  const std::string& text, const std::vector<std::string>& known);

// All of these throw renderer::InputError with the option, its value and what it takes.

/// The value that a name stands for.
///
/// @param option  "--sampler"
/// @param kind    what the message calls such a value: "sampler"
template <class Value, std::size_t N>
Value parse_name(std::string_view option, std::string_view kind, const std::array<Value, N>& values,
                 const std::string& text) {
  if (const auto value = renderer::from_name(values, text)) return *value;
  throw unknown_name(option, kind, text, names_of(values));
}

/// "WxH"; none for an empty text.
std::optional<renderer::FilmSize> parse_size(const std::string& text);

/// "BSDF,LIGHT": two sample counts, not both 0.
void set_counts(const std::string& text, renderer::PathOptions& path);

/// A depth from 1 on, or "off".
int parse_roulette(const std::string& text);

/// A name, for some with "=" and a parameter.
renderer::Weighting parse_heuristic(const std::string& text);

}  // namespace plumbline::tools
