#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <plumbline/renderer/loop/render_state.h>

namespace plumbline::tools {

/// A part of the pixels of an image. Whole pixels are dealt out, in turn: no net of points is ever
/// cut, no sum is split, and parts of an image with dear places in it take as long as each other.
struct Shard {
  std::uint32_t number = 1, count = 1;  ///< from 1

  bool has(std::size_t pixel) const { return pixel % count == number - 1; }
};

/// "I/N"; all for an empty text.
/// @throws renderer::InputError for what is no part
Shard parse_shard(const std::string& text);

/// Leaves the pixels of other parts to others.
void keep_only(const Shard& shard, renderer::RenderState& state);

/// The pixels of a part, side by side in one row, with the counters and the time of the state.
renderer::RenderState taken_out(const Shard& shard, const renderer::RenderState& state);

/// Puts what `taken_out` gives into its place, but for counters and time.
/// @throws renderer::InputError for a part of another size
void put_back(const Shard& shard, const renderer::RenderState& part, renderer::RenderState& state);

}  // namespace plumbline::tools
