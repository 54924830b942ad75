#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/options/options.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>

#include "allocation_options.h"
#include "checkpoint_options.h"
#include "rank_options.h"

namespace plumbline::tools {

/// What is asked for where no number of samples is, but another limit.
inline constexpr std::uint32_t kMaxSamples = 1u << 31;

/// What `render` was told.
struct RenderArguments {
  std::string scene;
  std::string output;
  std::string json;
  renderer::RenderOptions options;  ///< those that need nothing of the scene and of each other
  std::string counts;
  std::optional<double> light_probability;
  std::string roulette;
  std::optional<std::uint32_t> replicates;
  renderer::LightSelection light_selection = renderer::LightSelection::uniform;
  renderer::Accelerator accelerator = renderer::Accelerator::automatic;
  AllocationArguments allocation;
  CheckpointArguments checkpoint;
  RankArguments ranks;
  std::optional<std::uint32_t> samples;
  std::optional<int> max_depth;
  std::string size;
  std::vector<std::string> definitions;
};

/// Adds all options of `render`.
void add_render_options(options::Command& command, RenderArguments& arguments);

/// How the scene is to be rendered.
/// @throws renderer::InputError for options that do not go together
renderer::RenderOptions render_options(const RenderArguments& arguments,
                                       const renderer::SceneDescription& scene);

}  // namespace plumbline::tools
