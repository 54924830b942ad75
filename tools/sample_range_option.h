#pragma once

#include <cstdint>
#include <map>
#include <string>

#include <plumbline/options/options.h>
#include <plumbline/output/checkpoint.h>
#include <plumbline/renderer/assembly/render.h>

/// Which samples `render` draws, and what a picture says of them.
namespace plumbline::tools {

/// Adds --first-sample.
void add_sample_range_option(options::Command& command, renderer::RenderOptions& options);

/// @param options  all else is set
/// @throws renderer::InputError for a first sample that cuts a net of points in two, with one that
///         does not, and for one beyond which there are not so many
void check_first_sample(const renderer::RenderOptions& options);

/// One past the last sample of a pixel that has most.
std::uint64_t end_sample(const renderer::RenderOptions& options,
                         const renderer::RenderResult& result);

/// What the header says besides the record: what `merge` asks of a picture.
///
/// @param settings  that the samples depend on
/// @param shard     as --shard has it
std::map<std::string, std::string> origin(const output::CheckpointSettings& settings,
                                          const renderer::RenderOptions& options,
                                          const renderer::RenderResult& result,
                                          const std::string& shard);

}  // namespace plumbline::tools
