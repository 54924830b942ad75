#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include <plumbline/merging/sample_range.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/core/render/film.h>

namespace plumbline::merging {

/// What is put together, from which file.
struct Part {
  std::string file;
  std::vector<SampleRange> holds;
};

/// A setting that the samples of a picture depend on, and what its header calls it.
struct HeaderName {
  const char* header;
  const char* setting;  ///< output::CheckpointSettings
  bool in_record;       ///< `render` writes it with its record
};

inline constexpr HeaderName kHeaderNames[] = {{"scene_content", "scene content", false},
                                              {"strategy", "strategy", true},
                                              {"heuristic", "heuristic", true},
                                              {"sampler", "sampler", true},
                                              {"replicates", "replicates", true},
                                              {"light_selection", "light selection", true},
                                              {"accelerator", "accelerator", true},
                                              {"max_depth", "maximum depth", true},
                                              {"roulette_depth", "roulette depth", false},
                                              {"counts", "counts", false},
                                              {"light_probability", "light probability", false},
                                              {"allocation", "allocation", false},
                                              {"adaptive", "adaptive", false},
                                              {"version", "version", true}};

/// Digits alone.
inline std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t number = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  if (text.empty() || parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  return number;
}

/// By seed and first sample, so that sums have one order.
inline void sort_parts(std::vector<Part>& parts) {
  const auto before = [](const Part& a, const Part& b) {
    const SampleRange &x = a.holds.front(), &y = b.holds.front();
    return x.seed != y.seed ? x.seed < y.seed : x.first < y.first;
  };
  std::stable_sort(parts.begin(), parts.end(), before);
}

/// All that parts hold, and their seeds in words.
inline std::vector<SampleRange> all_ranges(const std::vector<Part>& parts) {
  std::vector<SampleRange> ranges;
  for (const Part& part : parts) ranges.insert(ranges.end(), part.holds.begin(), part.holds.end());
  return ranges;
}

inline std::string seeds_of(const std::vector<SampleRange>& ranges) {
  std::vector<std::uint64_t> seeds;
  for (const SampleRange& range : ranges) seeds.push_back(range.seed);
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  return fmt::format("{}", fmt::join(seeds, ", "));
}

/// @param samples  of each pixel
/// @throws renderer::InputError for pixels that no part has, or that have too many samples to count
inline void require_samples(const std::vector<std::uint64_t>& samples, const char* kind) {
  const auto missing = std::count(samples.begin(), samples.end(), std::uint64_t{0});
  if (missing > 0) {
    throw renderer::InputError(
        fmt::format("{} of {} pixels are in none of the {}; is a shard "
                    "missing?",
                    missing, samples.size(), kind));
  }
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (std::any_of(samples.begin(), samples.end(), [](auto n) { return n > kMost; })) {
    throw renderer::InputError(
        fmt::format("more than {} samples of a pixel cannot be counted", kMost));
  }
}

inline std::string least_samples(const std::vector<std::uint64_t>& samples) {
  return std::to_string(*std::min_element(samples.begin(), samples.end()));
}

}  // namespace plumbline::merging
