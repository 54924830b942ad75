#pragma once

#include <plumbline/merging/sample_range.h>
#include <plumbline/renderer/loop/render_state.h>

/// States of the pixels of a shard.
namespace plumbline::tools {

using merging::Shard;

/// Leaves the pixels of other parts to others.
void keep_only(const Shard& shard, renderer::RenderState& state);

/// The pixels of a part, side by side in one row, with the counters and the time of the state.
renderer::RenderState taken_out(const Shard& shard, const renderer::RenderState& state);

/// Puts what `taken_out` gives into its place, but for counters and time.
/// @throws renderer::InputError for a part of another size
void put_back(const Shard& shard, const renderer::RenderState& part, renderer::RenderState& state);

}  // namespace plumbline::tools
