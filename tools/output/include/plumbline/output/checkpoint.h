#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <plumbline/renderer/loop/render_state.h>

/// Renders that were kept half done, to go on from. Format "plumbline.checkpoint/2": lines
/// "name=value" up to an empty one, then the moments of each replicate of each pixel as they are in
/// memory, in double, and a hash of all that.
namespace plumbline::output {

/// What the samples depend on, by name: another value would give others.
using CheckpointSettings = std::map<std::string, std::string>;

/// In `RenderState::drawn`: of a pixel that another shard renders. No render draws so many.
inline constexpr std::uint32_t kElsewhere = std::numeric_limits<std::uint32_t>::max();
constexpr bool is_here(std::uint32_t drawn) { return drawn != kElsewhere; }

/// Samples of the pixel that has most, of those that are rendered here.
std::uint32_t most_drawn(const std::vector<std::uint32_t>& drawn);

struct Checkpoint {
  CheckpointSettings settings;
  renderer::RenderState state;
};

/// Over what is there. Who needs the file whole or not at all writes it elsewhere.
///
/// @throws renderer::InputError, renderer::MachineError where it cannot be written
void write_checkpoint(const std::filesystem::path& path, const CheckpointSettings& settings,
                      const renderer::RenderState& state);

/// @throws renderer::InputError for what is no checkpoint, is torn or was changed
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// A state, or settings, alone, as a checkpoint holds them: for another process of the same
/// program.
std::string bytes_of_state(const renderer::RenderState& state);
std::string bytes_of_settings(const CheckpointSettings& settings);

/// @throws renderer::InputError for what these do not make
renderer::RenderState state_of_bytes(const std::string& bytes);
CheckpointSettings settings_of_bytes(const std::string& bytes);

/// What a checkpoint is of, before it is read as a whole: whether it is torn is not seen.
///
/// @throws renderer::InputError for what is no checkpoint
CheckpointSettings read_checkpoint_settings(const std::filesystem::path& path);

/// @throws renderer::InputError with each setting that is another
void require_same(const std::filesystem::path& path, const CheckpointSettings& kept,
                  const CheckpointSettings& given);

/// A number for what a scene is made of: the bytes of its files in the order in which they are
/// read, and its parameters. FNV-1a, 64 bits: against mistakes, not against malice.
///
/// @throws renderer::InputError where a file cannot be read
std::uint64_t content_hash(const std::vector<std::filesystem::path>& files,
                           const std::map<std::string, std::string>& parameters);

}  // namespace plumbline::output
