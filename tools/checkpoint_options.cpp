#include "checkpoint_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <utility>

#include <plumbline/merging/sample_range.h>
#include <plumbline/output/failure.h>
#include <plumbline/output/stop.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/core/errors.h>

#include "shard.h"

namespace plumbline::tools {
namespace {

/// A state is what the options make of one, whatever the file says.
bool fits(const renderer::RenderState& state, const renderer::RenderState& fresh, bool adaptive) {
  return state.width == fresh.width && state.height == fresh.height && state.nets == fresh.nets &&
         state.bsdf_counts.size() == fresh.bsdf_counts.size() &&
         (state.needs.empty() || (adaptive && state.needs.size() == state.drawn.size()));
}

bool is_of(const renderer::RenderState& state, const merging::Shard& shard) {
  for (std::size_t i = 0; i < state.drawn.size(); ++i) {
    if (output::is_here(state.drawn[i]) != shard.has(i)) return false;
  }
  return true;
}

/// Of each pixel as many as are asked for, or fewer.
void require_no_more(const std::string& file, const renderer::RenderState& state,
                     const renderer::RenderOptions& options) {
  renderer::SampleCounts counts = sample_counts(state, options);
  counts.set_level(options.samples_per_pixel);
  for (std::size_t i = 0; i < state.drawn.size(); ++i) {
    if (!output::is_here(state.drawn[i]) || state.drawn[i] <= counts.of(i)) continue;
    throw renderer::InputError(fmt::format("{}: holds {} samples of a pixel, more than --spp {}",
                                           file, state.drawn[i], options.samples_per_pixel));
  }
}

void add_allocation(const renderer::RenderOptions& options, output::CheckpointSettings& settings) {
  const renderer::AllocationOptions& allocation = *options.allocation;
  settings["allocation"] =
      fmt::format("{}, {} iterations, share limit {}, cost ratio {}", name(allocation.policy),
                  allocation.iterations, allocation.limit, allocation.cost_ratio);
  // What a pixel's samples are shared out to depends on how many there are.
  settings["samples per pixel"] = std::to_string(options.samples_per_pixel);
}

}  // namespace

void add_checkpoint_options(options::Command& command, CheckpointArguments& arguments) {
  command
      .add(
          "--checkpoint", arguments.file,
          "Keep all that is done in this file now and then, when the render is stopped, and at its "
          "end")
      .type("FILE");
  command.add("--every", arguments.every, "Time between checkpoints; 60 without it")
      .positive_number()
      .needs("--checkpoint")
      .type("S");
  command
      .add("--resume", arguments.resume,
           "Go on from this checkpoint: the image is that of a render that never stopped, bit for "
           "bit, but with --seconds, whose samples are as many as there was time for")
      .type("FILE");
  command
      .add("--shard", arguments.shard,
           "Render the part I of N of the pixels; merge puts the checkpoints of all together")
      .needs("--checkpoint")
      .excludes("--seconds")
      .excludes("--error")
      .excludes("--adaptive")
      .type("I/N");
}

output::CheckpointSettings checkpoint_settings(const renderer::SceneDescription& scene,
                                               renderer::Accelerator accelerator,
                                               const renderer::RenderOptions& options) {
  const renderer::PathOptions& path = options.path;
  output::CheckpointSettings settings = {
      {"scene content",
       fmt::format("{:016x}", output::content_hash(scene.files, scene.parameters))},
      {"size", fmt::format("{}x{}", scene.camera.width, scene.camera.height)},
      {"strategy", std::string(name(path.strategy))},
      {"heuristic", describe(path.heuristic)},
      {"counts", fmt::format("{},{}", path.bsdf_samples, path.light_samples)},
      {"light probability", fmt::format("{}", path.light_probability)},
      {"maximum depth", std::to_string(path.max_depth)},
      {"roulette depth", std::to_string(path.rr_depth)},
      {"light selection", std::string(name(scene.light_selection))},
      {"sampler", std::string(name(options.sampler))},
      {"replicates", std::to_string(options.replicates)},
      {"backend", std::string(name(options.backend))},
      {"accelerator", std::string(name(accelerator))},
      {"error", fmt::format("{}", options.relative_error)},
      {"seed", std::to_string(options.seed)},
      {"first sample", std::to_string(options.first_sample)},
      {"version", PLUMBLINE_VERSION},
  };
  if (options.adaptive) settings["adaptive"] = fmt::format("pilot of {}", pilot_samples(options));
  if (options.allocation) add_allocation(options, settings);
  return settings;
}

Checkpoints::Checkpoints(CheckpointArguments arguments, output::Files& files)
    : arguments_(std::move(arguments)) {
  if (!arguments_.resume.empty()) files.reads_first(arguments_.resume);
  if (!arguments_.file.empty()) files.writes("--checkpoint", arguments_.file);
}

void Checkpoints::attach(const renderer::SceneDescription& scene,
                         const output::CheckpointSettings& settings,
                         renderer::RenderOptions& options) {
  options.interruptions.stop = [] { return output::stop_signal() != 0; };
  if (arguments_.file.empty() && arguments_.resume.empty()) return;
  settings_ = settings;
  const merging::Shard shard = merging::parse_shard(arguments_.shard);
  const auto state = std::make_shared<renderer::RenderState>(
      fresh_state(scene.camera.width, scene.camera.height, options));
  if (arguments_.resume.empty()) {
    keep_only(shard, *state);
  } else {
    output::Checkpoint checkpoint = output::read_checkpoint(arguments_.resume);
    output::require_same(arguments_.resume, checkpoint.settings, settings_);
    if (!fits(checkpoint.state, *state, options.adaptive)) {
      throw renderer::InputError(arguments_.resume + ": does not hold what it says");
    }
    if (!is_of(checkpoint.state, shard)) {
      throw renderer::InputError(arguments_.resume + ": is of another --shard");
    }
    require_no_more(arguments_.resume, checkpoint.state, options);
    *state = std::move(checkpoint.state);
  }
  options.interruptions.from = state;
  if (arguments_.file.empty()) return;
  options.interruptions.keep = [this](const renderer::RenderState& done, bool is_last) {
    keep(done, is_last);
  };
}

/// A checkpoint that cannot be written costs no render.
void Checkpoints::keep(const renderer::RenderState& state, bool is_last) {
  const auto now = std::chrono::steady_clock::now();
  if (!is_last && std::chrono::duration<double>(now - kept_).count() < arguments_.every) return;
  kept_ = now;
  try {
    output::OutputFile file(arguments_.file, true);
    file.fill([&](const auto& path) { output::write_checkpoint(path, settings_, state); });
    file.finish();
    is_kept_ = true;
  } catch (const std::exception&) {
    output::tell(fmt::format("plumbline: no checkpoint: {}\n",
                             output::failure_of(std::current_exception()).what));
  }
}

std::string Checkpoints::how_to_resume() const {
  if (arguments_.file.empty()) return "without --checkpoint it cannot be gone on with";
  if (!is_kept_) return "there is no checkpoint to go on from";
  return fmt::format("the same command with --resume {} goes on", arguments_.file);
}

}  // namespace plumbline::tools
