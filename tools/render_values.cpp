#include "render_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include <plumbline/renderer/nearest_name.h>

namespace plumbline::tools {

std::optional<renderer::FilmSize> parse_size(const std::string& text) {
  if (text.empty()) return std::nullopt;
  renderer::FilmSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    if (height.ec == std::errc() && height.ptr == end) return size;
  }
  throw renderer::InputError(fmt::format("--size {}: must read WIDTHxHEIGHT", text));
}

void set_counts(const std::string& text, renderer::PathOptions& path) {
  constexpr int kMaxCount = 4096;
  const char* end = text.data() + text.size();
  const auto bsdf = std::from_chars(text.data(), end, path.bsdf_samples);
  if (bsdf.ec == std::errc() && bsdf.ptr != end && *bsdf.ptr == ',') {
    const auto light = std::from_chars(bsdf.ptr + 1, end, path.light_samples);
    const auto [low, high] = std::minmax(path.bsdf_samples, path.light_samples);
    if (light.ec == std::errc() && light.ptr == end && low >= 0 && high >= 1 && high <= kMaxCount) {
      return;
    }
  }
  throw renderer::InputError(fmt::format(
      "--counts {}: must read BSDF,LIGHT, two numbers up to {}, not both 0", text, kMaxCount));
}

int parse_roulette(const std::string& text) {
  if (text == "off") return renderer::kNoRoulette;
  int depth = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, depth);
  if (parsed.ec == std::errc() && parsed.ptr == end && depth >= 1) return depth;
  throw renderer::InputError(fmt::format("--roulette {}: must be a depth from 1 on, or off", text));
}

renderer::Strategy parse_strategy(const std::string& text) {
  if (const auto strategy = renderer::strategy_from_name(text)) return *strategy;
  throw renderer::InputError(
      fmt::format("--strategy {}: there is no such strategy; {}", text,
                  renderer::name_hint(text, names_of(renderer::kStrategies))));
}

renderer::Weighting parse_heuristic(const std::string& text) {
  if (const auto weighting = renderer::weighting_from_text(text)) return *weighting;
  const std::string heuristic = text.substr(0, text.find('='));
  if (renderer::heuristic_from_name(heuristic)) {
    throw renderer::InputError(fmt::format(
        "--heuristic {}: only power=b with b > 0 and cutoff=a with a in [0, 1] have a parameter",
        text));
  }
  throw renderer::InputError(
      fmt::format("--heuristic {}: there is no such heuristic; {}", text,
                  renderer::name_hint(heuristic, names_of(renderer::kHeuristics))));
}

renderer::SamplerType parse_sampler(const std::string& text) {
  if (const auto sampler = renderer::sampler_from_name(text)) return *sampler;
  throw renderer::InputError(fmt::format("--sampler {}: there is no such sampler; {}", text,
                                         renderer::name_hint(text, names_of(renderer::kSamplers))));
}

renderer::LightSelection parse_light_selection(const std::string& text) {
  if (const auto selection = renderer::light_selection_from_name(text)) return *selection;
  throw renderer::InputError(
      fmt::format("--light-selection {}: there is no such selection; {}", text,
                  renderer::name_hint(text, names_of(renderer::kLightSelections))));
}

}  // namespace plumbline::tools
