#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/render/film.h>

namespace plumbline::renderer {

/// How many samples a pixel should have: the number's logarithm in 1024ths of an octave, up to what
/// all pixels have in common.
using SampleNeed = std::int16_t;

/// The least samples of a pixel by which its neighbours' needs are judged.
inline constexpr std::uint32_t kLeastPilot = 16;

/// What pixels need for a small mean over them of Var/(m² + 0.01), the measure of
/// Film::relative_error: Σ σᵢ²/nᵢ is least at a given Σ nᵢ where nᵢ ∝ σᵢ.
///
/// σᵢ is what the 24 pixels around have, with weights exp(−d²/(2·0.8²)) at d pixels: the square of
/// their mean standard deviation of a sample, and the variance between their means, where an edge
/// passes. A pixel's own samples say nothing, so that its number of samples is independent of them,
/// and their mean unbiased: of what lights one pixel alone the neighbours know nothing.
///
/// @param pilot  in each pixel the moments of its samples; not finite ones are left out
/// @return  of each pixel; an image that is black, or of one pixel, needs the same everywhere
std::vector<SampleNeed> needs_from_neighbours(const Film& pilot);

/// The number of samples of each pixel at a level: so many on average, or as few less as whole
/// powers of two leave over.
class SampleCounts {
 public:
  /// As many samples in every pixel as the level.
  SampleCounts() = default;

  /// @param needs  of each pixel; empty: as many in every pixel
  /// @param pilot  the fewest of a pixel
  SampleCounts(std::vector<SampleNeed> needs, std::uint32_t pilot);

  /// Numbers grow with the level, each to its double. Below the pilot they are the pilot.
  void set_level(std::uint32_t level);

  /// Of a pixel: pilot · 2^k, at most 2^30 of pilots up to there. Sobol' points in a power of two
  /// are a net.
  std::uint32_t of(std::size_t pixel) const {
    return needs_.empty() ? level_ : of_need(needs_[pixel]);
  }

  const std::vector<SampleNeed>& needs() const { return needs_; }

 private:
  std::uint32_t of_need(SampleNeed need) const;
  std::uint64_t total() const;

  std::vector<SampleNeed> needs_;
  std::vector<std::pair<SampleNeed, std::uint64_t>> pixels_of_;  // how many have which need
  std::uint32_t pilot_ = 1, level_ = 0;
  int scale_ = 0;  // of all needs, in their unit
};

}  // namespace plumbline::renderer
