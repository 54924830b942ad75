#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include <plumbline/options/options.h>
#include <plumbline/output/checkpoint.h>
#include <plumbline/output/output_file.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>

namespace plumbline::tools {

/// What `render` was told about checkpoints.
struct CheckpointArguments {
  std::string file, resume, shard;
  double every = 60;  ///< [s]
};

/// Adds --checkpoint, --every, --resume and --shard.
void add_checkpoint_options(options::Command& command, CheckpointArguments& arguments);

/// All that the samples of a render depend on: two renders with the same are of one image. Reads
/// the scene's files.
///
/// @param accelerator  that the scene was made with
output::CheckpointSettings checkpoint_settings(const renderer::SceneDescription& scene,
                                               renderer::Accelerator accelerator,
                                               const renderer::RenderOptions& options);

/// Keeps a render now and then, and goes on with one that was kept.
class Checkpoints {
 public:
  /// @param files  of the command: those that the render writes, so far
  /// @throws renderer::InputError for a file that cannot be written to, or is another one's
  Checkpoints(CheckpointArguments arguments, output::Files& files);

  /// Makes the options those of a render that is kept and, where that was asked for, gone on with.
  ///
  /// @param settings  `checkpoint_settings` of these
  /// @param options   all else is set; kept as long as this
  /// @throws renderer::InputError for a checkpoint of another render, with what is another
  void attach(const renderer::SceneDescription& scene, const output::CheckpointSettings& settings,
              renderer::RenderOptions& options);

  /// How to go on with a render that was stopped, as a sentence.
  std::string how_to_resume() const;

 private:
  void keep(const renderer::RenderState& state, bool is_last);

  CheckpointArguments arguments_;
  output::CheckpointSettings settings_;
  std::chrono::steady_clock::time_point kept_ = std::chrono::steady_clock::now();
  bool is_kept_ = false;
};

}  // namespace plumbline::tools
