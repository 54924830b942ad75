#include "render_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/nearest_name.h>

namespace plumbline::tools {

renderer::InputError unknown_name(std::string_view option, std::string_view kind,
                                  const std::string& text, const std::vector<std::string>& known) {
  return renderer::InputError(fmt::format("{} {}: there is no such {}; {}", option, text, kind,
                                          renderer::name_hint(text, known)));
}

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

renderer::Weighting parse_heuristic(const std::string& text) {
  if (const auto weighting = renderer::weighting_from_text(text)) return *weighting;
  const std::string heuristic = text.substr(0, text.find('='));
  if (renderer::from_name(renderer::kHeuristics, heuristic)) {
    throw renderer::InputError(fmt::format(
        "--heuristic {}: only power=b with b > 0 and cutoff=a with a in [0, 1] have a parameter",
        text));
  }
  throw unknown_name("--heuristic", "heuristic", heuristic, names_of(renderer::kHeuristics));
}

}  // namespace plumbline::tools
