#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// Which samples a picture holds: what its header says of them, and whether two pictures have some
/// in common.
namespace plumbline::merging {

/// Whole pixels are dealt out, in turn: no net of points is ever cut, and no sum is split.
struct Shard {
  std::uint32_t number = 1, count = 1;  ///< from 1 to `count`

  bool has(std::size_t pixel) const { return pixel % count == number - 1; }
  bool operator==(const Shard&) const = default;
};

/// "I/N"; all pixels for an empty text.
///
/// @throws renderer::InputError for anything else
Shard parse_shard(const std::string& text);

/// Whether there is a pixel of both in an image that is large enough.
bool share_pixels(const Shard& a, const Shard& b);

/// Samples `first` to `end` − 1 of the pixels of a shard, by the random numbers of a seed.
struct SampleRange {
  std::uint64_t seed = 0;
  std::uint64_t first = 0, end = 0;
  Shard shard;

  bool operator==(const SampleRange&) const = default;
};

/// Whether there are samples that are in both.
bool overlap(const SampleRange& a, const SampleRange& b);

/// "SEED:FIRST-END", with "@I/N" behind where it is a shard; several with spaces between: the
/// header's `holds`.
std::string to_text(const std::vector<SampleRange>& ranges);

/// What `to_text` makes.
///
/// @throws renderer::InputError for anything else, nothing at all, and empty ranges
std::vector<SampleRange> parse_ranges(const std::string& text);

}  // namespace plumbline::merging
