#pragma once

#include <plumbline/mpi/ranks.h>
#include <plumbline/output/checkpoint.h>
#include <plumbline/renderer/assembly/render.h>

namespace plumbline::tools {

/// Files may differ from machine to machine.
/// @throws mpi::AgreedFailure where a rank would render something else than the first one, with
///         what is another
void require_one_render(mpi::Ranks& ranks, const output::CheckpointSettings& settings);

/// `render` with the pixels dealt out to the ranks: rank I of N has what `--shard I+1/N` has. To be
/// called by all with the same scene and options, of which the interruptions matter in the first
/// rank alone: it keeps, and goes on from, what all have done. The same bits for any number of
/// ranks.
///
/// @param options  without a time limit
/// @param every    [s] between the states that other ranks send to be kept; 0: none
/// @return  in the first rank what `render` returns; in others whether the render was stopped
renderer::RenderResult render_by_ranks(mpi::Ranks& ranks, const renderer::Scene& scene,
                                       const renderer::RenderOptions& options, double every);

}  // namespace plumbline::tools
