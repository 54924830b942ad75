#include "render_arguments.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/core/errors.h>

#include "render_values.h"
#include "sample_range_option.h"

namespace plumbline::tools {
namespace {

/// An option with a name of one of `values`, which stand in its help in the place of {}.
template <class Value, std::size_t N>
void add_named(options::Command& command, const char* option, const char* what,
               const std::array<Value, N>& values, Value& value, const char* help) {
  const auto parse = [&value, &values, option, what](const std::string& text) {
    value = parse_name(option, what, values, text);
  };
  command
      .add_text(option, parse, fmt::format(fmt::runtime(help), fmt::join(names_of(values), ", ")))
      .type("NAME");
}

void add_basic_options(options::Command& command, RenderArguments& arguments) {
  command.add("scene", arguments.scene, "Scene file, or name of a known scene").required().type("");
  command.add("-o,--output", arguments.output, "OpenEXR file to write").required().type("FILE");
  add_named(command, "--strategy", "strategy", renderer::kStrategies,
            arguments.options.path.strategy, "One of {}; mis without it");
  command
      .add_text(
          "--heuristic",
          [&](const std::string& text) {
            arguments.options.path.heuristic = parse_heuristic(text);
          },
          fmt::format("One of {}; power=2 without it. power=b and cutoff=a take a parameter",
                      fmt::join(names_of(renderer::kHeuristics), ", ")))
      .type("NAME");
  command
      .add("--counts", arguments.counts,
           "Samples of each technique at the first vertex, for mis; 1,1 without it")
      .type("BSDF,LIGHT");
  command
      .add("--light-probability", arguments.light_probability,
           "Chance of the light, for one-sample; 0.5 without it")
      .type("C");
  command
      .add("--roulette", arguments.roulette,
           "Russian roulette from this depth on, or off; the scene's without it")
      .type("N");
  add_named(command, "--sampler", "sampler", renderer::kSamplers, arguments.options.sampler,
            "One of {}; independent without it");
  add_named(command, "--backend", "backend", renderer::kBackends, arguments.options.backend,
            "One of {}: many paths side by side, or one after the other; the same image but for "
            "rounding (docs/conventions.md). batched without it");
  add_named(
      command, "--accelerator", "accelerator", renderer::kAccelerators, arguments.accelerator,
      "What finds where rays meet surfaces, one of {}: by the number of primitives, a tree, or "
      "all primitives against sixteen rays at once. auto without it");
  add_named(command, "--light-selection", "selection", renderer::kLightSelections,
            arguments.light_selection,
            "How one of the lights is chosen, one of {}; uniform without it");
  command
      .add("--replicates", arguments.replicates,
           "Of sobol: scrambles that --spp is dealt out to, which show the noise; 4 without "
           "it, 1 for the least noise and no estimate of it")
      .whole_number(1, 1024)
      .type("N");
  command.add("--spp", arguments.samples, "Samples per pixel; the scene's without it")
      .whole_number(1, kMaxSamples)
      .type("N");
  command.add_flag("--adaptive", arguments.options.adaptive,
                   "After a pilot of 16 samples in every pixel, more where neighbours show noise: "
                   "--spp on average, for a small relative error of the image");
  command.add("--seconds", arguments.options.seconds, "Stop after this time")
      .positive_number()
      .type("S");
  command.add("--error", arguments.options.relative_error, "Stop at this estimated relative error")
      .positive_number()
      .type("E");
  command
      .add("--max-depth", arguments.max_depth,
           "1: emission only, 2: direct light too, -1: all; the scene's without it")
      .whole_number(-1, std::numeric_limits<int>::max())
      .type("N");
  command.add("--seed", arguments.options.seed, "The same seed gives the same bits; 0 without it")
      .whole_number(0, std::numeric_limits<std::int64_t>::max())
      .type("N");
  command
      .add("--threads", arguments.options.threads, "All cores without it; no matter to the image")
      .whole_number(1, 1024)
      .type("N");
  command.add("--size", arguments.size, "Size of the image in place of the scene's").type("WxH");
  command.add("--json", arguments.json, "Write rays, time, mean and settings to this file")
      .type("FILE");
  command.add("-D", arguments.definitions, "Value for a <default> of the scene; repeatable")
      .one_value_each()
      .type("NAME=VALUE");
}

/// Options of one strategy that are given with another would be without effect.
void require_strategy(const RenderArguments& arguments, renderer::Strategy strategy,
                      const char* option) {
  const renderer::Strategy given = arguments.options.path.strategy;
  if (given == strategy) return;
  throw renderer::InputError(
      fmt::format("{} belongs to --strategy {}, not {}", option, name(strategy), name(given)));
}

/// Into how many scrambles the samples of a pixel are dealt out. Two would do for a variance, but
/// one of a single degree of freedom.
std::uint32_t replicates_of(const RenderArguments& arguments) {
  if (arguments.options.sampler == renderer::SamplerType::sobol) {
    return arguments.replicates.value_or(4);
  }
  if (arguments.replicates) {
    throw renderer::InputError("--replicates belongs to --sampler sobol");
  }
  return 1;
}

void require_samples_to_share_out(const renderer::RenderOptions& options) {
  const std::uint32_t pilot = pilot_samples(options);
  if (!options.adaptive || options.samples_per_pixel > pilot) return;
  throw renderer::InputError(
      fmt::format("--adaptive: {} samples per pixel are the pilot's {}, or fewer: give it a larger "
                  "--spp",
                  options.samples_per_pixel, pilot));
}

}  // namespace

renderer::RenderOptions render_options(const RenderArguments& arguments,
                                       const renderer::SceneDescription& scene) {
  renderer::RenderOptions options = arguments.options;
  options.path.max_depth = arguments.max_depth.value_or(scene.integrator.max_depth);
  options.path.rr_depth =
      arguments.roulette.empty() ? scene.integrator.rr_depth : parse_roulette(arguments.roulette);
  if (!arguments.counts.empty()) {
    require_strategy(arguments, renderer::Strategy::mis, "--counts");
    set_counts(arguments.counts, options.path);
  }
  if (arguments.light_probability) {
    require_strategy(arguments, renderer::Strategy::one_sample, "--light-probability");
    const double c = *arguments.light_probability;
    if (!(c > 0 && c < 1)) {
      throw renderer::InputError("--light-probability: must lie between 0 and 1, both excluded");
    }
    options.path.light_probability = static_cast<float>(c);
  }
  // A limit on time or error stands for the number of samples unless both are given.
  const bool other_limit = options.seconds > 0 || options.relative_error > 0;
  options.samples_per_pixel = arguments.samples.value_or(
      other_limit ? kMaxSamples : static_cast<std::uint32_t>(scene.samples_per_pixel));
  options.replicates = replicates_of(arguments);
  set_allocation(arguments.allocation, arguments.samples.has_value(), options);
  check_first_sample(options);
  require_samples_to_share_out(options);
  return options;
}

void add_render_options(options::Command& command, RenderArguments& arguments) {
  add_basic_options(command, arguments);
  add_sample_range_option(command, arguments.options);
  add_allocation_options(command, arguments.allocation);
  add_checkpoint_options(command, arguments.checkpoint);
  add_rank_options(
      command, arguments.ranks,
      "Deal the pixels out to the ranks of an mpirun: the same image, bit for bit, for "
      "any number of ranks (docs/scaling.md)")
      .excludes("--shard")
      .excludes("--seconds");
}

}  // namespace plumbline::tools
