#pragma once

#include <optional>
#include <string>
#include <vector>

#include <plumbline/renderer/render/path.h>
#include <plumbline/renderer/scene/load_scene.h>

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

// All of these throw renderer::InputError with the option, its value and what it takes.

/// "WxH"; none for an empty text.
std::optional<renderer::FilmSize> parse_size(const std::string& text);

/// "BSDF,LIGHT": two sample counts, not both 0.
void set_counts(const std::string& text, renderer::PathOptions& path);

/// A depth from 1 on, or "off".
int parse_roulette(const std::string& text);

renderer::Strategy parse_strategy(const std::string& text);

/// A name, for some with "=" and a parameter.
renderer::Weighting parse_heuristic(const std::string& text);

renderer::SamplerType parse_sampler(const std::string& text);

renderer::LightSelection parse_light_selection(const std::string& text);

}  // namespace plumbline::tools
