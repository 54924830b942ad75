#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <plumbline/output/failure.h>
#include <plumbline/output/output_file.h>
#include <plumbline/output/stop.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/exr.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include <plumbline/reports/render_record.h>

#include "allocation_options.h"
#include "checkpoint_options.h"
#include "command.h"
#include "progress.h"
#include "render_numbers.h"
#include "render_values.h"
#include "scene_argument.h"

namespace plumbline::tools {
namespace {

constexpr std::uint32_t kMaxSamples = 1u << 31;

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
  AllocationArguments allocation;
  CheckpointArguments checkpoint;
  std::optional<std::uint32_t> samples;
  std::optional<int> max_depth;
  std::string size;
  std::vector<std::string> definitions;
};

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
  return options;
}

std::string counted(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

/// The strategy as records name it: "mis", "mis 4,2", "one-sample 0.25".
std::string strategy_text(const RenderArguments& arguments) {
  std::string text(name(arguments.options.path.strategy));
  if (arguments.allocation.policy) text += fmt::format(" {}", name(*arguments.allocation.policy));
  if (!arguments.counts.empty()) text += " " + arguments.counts;
  if (arguments.light_probability) text += fmt::format(" {}", *arguments.light_probability);
  return text;
}

/// The weights' heuristic; empty where the strategy has no use for one.
std::string heuristic_text(const renderer::RenderOptions& options) {
  return uses_heuristic(options.path.strategy) ? describe(options.path.heuristic) : std::string();
}

void print_found(const RenderArguments& arguments, const renderer::SceneDescription& description,
                 const renderer::Scene& scene, const renderer::RenderOptions& options) {
  std::string strategy = strategy_text(arguments);
  if (options.path.strategy == renderer::Strategy::mis) strategy.replace(0, 3, "MIS");
  const std::string heuristic = heuristic_text(options);
  fmt::print("{}{}: {}, {}, {}, {}x{} pixels", strategy,
             heuristic.empty() ? "" : fmt::format(" ({})", heuristic),
             counted(scene.lights().size(), "light"), counted(scene.shape_count(), "shape"),
             counted(description.bsdfs->size(), "BSDF"), description.camera.width,
             description.camera.height);
  if (options.path.max_depth < 0) {
    fmt::print(", depth unlimited");
  } else {
    fmt::print(", depth {}", options.path.max_depth);
  }
  if (options.samples_per_pixel < kMaxSamples) {
    fmt::print(", up to {} per pixel", counted(options.samples_per_pixel, "sample"));
  }
  fmt::print("\n");
  std::fflush(stdout);
}

reports::RenderRecord make_record(const RenderArguments& arguments,
                                  const renderer::RenderOptions& options,
                                  const renderer::RenderResult& result) {
  const renderer::Rgbd mean = result.film.mean();
  reports::RenderRecord record;
  record.scene = arguments.scene;
  record.strategy = strategy_text(arguments);
  record.heuristic = heuristic_text(options);
  record.sampler = name(options.sampler);
  record.replicates = options.replicates;
  record.light_selection = name(arguments.light_selection);
  record.samples_per_pixel = result.samples_per_pixel;
  record.seconds = result.seconds;
  record.camera_rays = result.counters.camera_rays;
  record.bounce_rays = result.counters.bounce_rays;
  record.shadow_rays = result.counters.shadow_rays;
  record.rejected = result.counters.rejected;
  record.non_finite = result.film.non_finite();
  record.mean = {mean.r, mean.g, mean.b};
  record.seed = options.seed;
  record.version = PLUMBLINE_VERSION;
  record.max_depth = options.path.max_depth;
  record.width = result.film.width();
  record.height = result.film.height();
  record.threads =
      options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency());
  record.parameters = parse_definitions(arguments.definitions);
  return record;
}

/// What an image says about itself in its header; `compare` reads it back.
std::map<std::string, std::string> metadata(const reports::RenderRecord& record) {
  std::map<std::string, std::string> data = {
      {"scene", record.scene},
      {"strategy", record.strategy},
      {"seed", std::to_string(record.seed)},
      {"sampler", record.sampler},
      {"replicates", std::to_string(record.replicates)},
      {"light_selection", record.light_selection},
      {"samples", std::to_string(record.samples_per_pixel)},
      {"seconds", fmt::format("{:.3f}", record.seconds)},
      {"max_depth", std::to_string(record.max_depth)},
      {"non_finite", std::to_string(record.non_finite)},
      {"version", record.version},
  };
  if (!record.heuristic.empty()) data["heuristic"] = record.heuristic;
  for (const auto& [name, value] : record.parameters) data["parameter." + name] = value;
  return data;
}

void print_done(const std::string& output, const reports::RenderRecord& record) {
  const auto rays =
      static_cast<double>(record.camera_rays + record.bounce_rays + record.shadow_rays);
  fmt::print("{}: mean {:.6g} {:.6g} {:.6g}, {} samples per pixel in {:.2f} s, {:.2f} Mrays/s",
             output, record.mean[0], record.mean[1], record.mean[2], record.samples_per_pixel,
             record.seconds, rays / record.seconds * 1e-6);
  if (record.rejected > 0) fmt::print(", {} rejected", record.rejected);
  fmt::print("\n");
}

/// Where a signal ended the render, for the header and for the user.
std::string stopped_at(const renderer::RenderOptions& options,
                       const renderer::RenderResult& result) {
  if (options.samples_per_pixel >= kMaxSamples) {
    return fmt::format("at {} samples per pixel", result.samples_per_pixel);
  }
  return fmt::format("at {} of {} samples per pixel", result.samples_per_pixel,
                     options.samples_per_pixel);
}

bool has_samples(const renderer::Film& film) {
  return std::any_of(film.pixels().begin(), film.pixels().end(),
                     [](const auto& pixel) { return pixel.count > 0 || pixel.non_finite > 0; });
}

int report_stop(const Checkpoints& checkpoints, const std::string& where) {
  const int signal = output::stop_signal();
  output::tell(fmt::format("plumbline: stopped by signal {} {}; {}\n", signal, where,
                           checkpoints.how_to_resume()));
  return output::exit_code_of_signal(signal);
}

int run_render(const RenderArguments& arguments) {
  output::Files files;
  output::OutputFile& output = files.writes("--output", arguments.output);
  output::OutputFile* json =
      arguments.json.empty() ? nullptr : &files.writes("--json", arguments.json);
  const ShareMap share_map(arguments.allocation, files);
  Checkpoints checkpoints(arguments.checkpoint, files);
  renderer::SceneDescription description =
      load_scene(scene_path(arguments.scene), parse_definitions(arguments.definitions),
                 parse_size(arguments.size));
  for (const std::filesystem::path& file : description.files) files.reads(file);
  description.light_selection = arguments.light_selection;
  const renderer::Scene scene = renderer::make_scene(description);
  renderer::RenderOptions options = render_options(arguments, description);
  checkpoints.attach(description, options);
  print_found(arguments, description, scene, options);
  Progress progress(options.seconds, options.samples_per_pixel < kMaxSamples);
  if (progress.shown()) options.progress = [&](double done) { progress.update(done); };
  const output::StopRequests stops_at_signals;
  const renderer::RenderResult result = render(scene, options);
  if (!has_samples(result.film)) return report_stop(checkpoints, "before the first sample");

  reports::RenderRecord record = make_record(arguments, options, result);
  if (!output.is_device()) record.image = arguments.output;
  renderer::Image image = to_image(result.film);
  image.metadata = metadata(record);
  if (!arguments.checkpoint.shard.empty()) image.metadata["shard"] = arguments.checkpoint.shard;
  if (result.stopped) image.metadata["stopped"] = stopped_at(options, result);
  output.fill([&](const auto& path) { write_exr(path, image); });
  if (!result.stopped) share_map.write(result);  // the shares of a pixel are those at its end
  if (json) {
    json->fill([&](const auto& path) { write_render_record(path, record, json->target()); });
  }
  files.finish();
  print_done(arguments.output, record);
  std::fflush(stdout);  // before what goes to standard error
  const bool usable = check_numbers(scene, options, result);
  if (result.stopped) return report_stop(checkpoints, stopped_at(options, result));
  return usable ? kExitFine : kExitUnexpectedVerdict;
}

void add_options(options::Command& command, RenderArguments& arguments) {
  command.add("scene", arguments.scene, "Scene file, or name of a known scene").required().type("");
  command.add("-o,--output", arguments.output, "OpenEXR file to write").required().type("FILE");
  command
      .add_text(
          "--strategy",
          [&](const std::string& text) {
            arguments.options.path.strategy =
                parse_name("--strategy", "strategy", renderer::kStrategies, text);
          },
          fmt::format("One of {}; mis without it",
                      fmt::join(names_of(renderer::kStrategies), ", ")))
      .type("NAME");
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
  command
      .add_text(
          "--sampler",
          [&](const std::string& text) {
            arguments.options.sampler =
                parse_name("--sampler", "sampler", renderer::kSamplers, text);
          },
          fmt::format("One of {}; independent without it",
                      fmt::join(names_of(renderer::kSamplers), ", ")))
      .type("NAME");
  command
      .add_text(
          "--backend",
          [&](const std::string& text) {
            arguments.options.backend =
                parse_name("--backend", "backend", renderer::kBackends, text);
          },
          fmt::format(
              "One of {}: many paths side by side, or one after the other; the same image but for "
              "rounding (docs/conventions.md). batched without it",
              fmt::join(names_of(renderer::kBackends), ", ")))
      .type("NAME");
  command
      .add_text(
          "--light-selection",
          [&](const std::string& text) {
            arguments.light_selection =
                parse_name("--light-selection", "selection", renderer::kLightSelections, text);
          },
          fmt::format("How one of the lights is chosen, one of {}; uniform without it",
                      fmt::join(names_of(renderer::kLightSelections), ", ")))
      .type("NAME");
  command
      .add("--replicates", arguments.replicates,
           "Of sobol: scrambles that --spp is dealt out to, which show the noise; 4 without "
           "it, 1 for the least noise and no estimate of it")
      .whole_number(1, 1024)
      .type("N");
  command.add("--spp", arguments.samples, "Samples per pixel; the scene's without it")
      .whole_number(1, kMaxSamples)
      .type("N");
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

}  // namespace

void add_render_command(options::CommandLine& line) {
  const auto arguments = std::make_shared<RenderArguments>();
  options::Command command = line.add_command("render", "Render a scene to an OpenEXR image");
  add_options(command, *arguments);
  add_allocation_options(command, arguments->allocation);
  add_checkpoint_options(command, arguments->checkpoint);
  command.footer(R"(Examples:
  plumbline render furnace_cube -o cube.exr --strategy one-sample --heuristic balance --spp 1024
  plumbline render sphere_light -o light.exr -D radius=0.1 -D height=2 --error 0.01
  plumbline render scene.xml -o /dev/null --seconds 30 --threads 1 --json timing.json
  plumbline render scene.xml -o long.exr --spp 65536 --checkpoint long.checkpoint

Ctrl-C, TERM and HUP stop a render within a second and write the image of the samples that are there; their number
stands in its header. A second signal stops at once. Exit code 128 + signal: 130, 143, 129.
A checkpoint is gone on from with the scene, settings, seed and version that it was kept of alone; --spp may be
higher.)");
  command.runs([arguments] { return run_render(*arguments); });
}

}  // namespace plumbline::tools
