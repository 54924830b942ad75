#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <plumbline/mpi/ranks.h>
#include <plumbline/output/failure.h>
#include <plumbline/output/output_file.h>
#include <plumbline/output/stop.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/image_io/exr.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include <plumbline/reports/render_record.h>

#include "allocation_options.h"
#include "checkpoint_options.h"
#include "command.h"
#include "progress.h"
#include "render_arguments.h"
#include "render_by_ranks.h"
#include "render_numbers.h"
#include "render_values.h"
#include "sample_range_option.h"
#include "scene_argument.h"

namespace plumbline::tools {
namespace {

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
    fmt::print(", up to {} per pixel{}", counted(options.samples_per_pixel, "sample"),
               options.adaptive ? " on average" : "");
  }
  fmt::print("\n");
  std::fflush(stdout);
}

reports::RenderRecord make_record(const RenderArguments& arguments, const renderer::Scene& scene,
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
  record.accelerator = name(accelerator_of(scene));
  record.samples_per_pixel = result.samples_per_pixel;
  record.adaptive = options.adaptive;
  record.first_sample = options.first_sample;
  record.end_sample = end_sample(options, result);
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
      {"accelerator", record.accelerator},
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

/// The scene, and how it is to be rendered.
struct Job {
  explicit Job(const RenderArguments& arguments)
      : description(described(arguments)),
        scene(renderer::make_scene(description)),
        options(render_options(arguments, description)),
        settings(checkpoint_settings(description, accelerator_of(scene), options)) {}

  static renderer::SceneDescription described(const RenderArguments& arguments) {
    renderer::SceneDescription description =
        load_scene(scene_path(arguments.scene), parse_definitions(arguments.definitions),
                   parse_size(arguments.size));
    description.light_selection = arguments.light_selection;
    description.accelerator = arguments.accelerator;
    return description;
  }

  renderer::SceneDescription description;
  renderer::Scene scene;
  renderer::RenderOptions options;
  output::CheckpointSettings settings;  ///< of the files as they were before
};

/// All that a render writes.
class Outputs {
 public:
  explicit Outputs(const RenderArguments& arguments)
      : arguments_(arguments),
        output_(files_.writes("--output", arguments.output)),
        json_(arguments.json.empty() ? nullptr : &files_.writes("--json", arguments.json)),
        share_map_(arguments.allocation, files_),
        checkpoints_(arguments.checkpoint, files_) {}

  /// To be called before the render.
  void attach(Job& job) {
    for (const std::filesystem::path& file : job.description.files) files_.reads(file);
    checkpoints_.attach(job.description, job.settings, job.options);
  }

  /// @return the exit code
  int write(const Job& job, const renderer::RenderResult& result);

 private:
  void write_files(const Job& job, const renderer::RenderResult& result,
                   reports::RenderRecord& record);

  const RenderArguments& arguments_;
  output::Files files_;
  output::OutputFile& output_;
  output::OutputFile* json_;
  ShareMap share_map_;
  Checkpoints checkpoints_;
};

int Outputs::write(const Job& job, const renderer::RenderResult& result) {
  if (!has_samples(result.film)) return report_stop(checkpoints_, "before the first sample");
  reports::RenderRecord record = make_record(arguments_, job.scene, job.options, result);
  write_files(job, result, record);
  print_done(arguments_.output, record);
  std::fflush(stdout);  // before what goes to standard error
  const bool usable = check_numbers(job.scene, job.options, result);
  if (result.stopped) return report_stop(checkpoints_, stopped_at(job.options, result));
  return usable ? kExitFine : kExitUnexpectedVerdict;
}

void Outputs::write_files(const Job& job, const renderer::RenderResult& result,
                          reports::RenderRecord& record) {
  if (!output_.is_device()) record.image = arguments_.output;
  renderer::Image image = to_image(result.film);
  image.metadata = metadata(record);
  image.metadata.merge(origin(job.settings, job.options, result, arguments_.checkpoint.shard));
  if (!arguments_.checkpoint.shard.empty()) image.metadata["shard"] = arguments_.checkpoint.shard;
  if (result.stopped) image.metadata["stopped"] = stopped_at(job.options, result);
  output_.fill([&](const auto& path) { write_exr(path, image); });
  if (!result.stopped) share_map_.write(result);  // the shares of a pixel are those at its end
  if (json_) {
    json_->fill([&](const auto& path) { write_render_record(path, record, json_->target()); });
  }
  files_.finish();
}

/// What it finds, and then a line of progress.
std::unique_ptr<Progress> tell_of(const RenderArguments& arguments, Job& job) {
  print_found(arguments, job.description, job.scene, job.options);
  auto progress =
      std::make_unique<Progress>(job.options.seconds, job.options.samples_per_pixel < kMaxSamples);
  if (progress->shown()) {
    job.options.progress = [line = progress.get()](double done) { line->update(done); };
  }
  return progress;
}

int render_alone(const RenderArguments& arguments) {
  Outputs outputs(arguments);
  Job job(arguments);
  outputs.attach(job);
  const std::unique_ptr<Progress> progress = tell_of(arguments, job);
  const output::StopRequests stops_at_signals;
  return outputs.write(job, render(job.scene, job.options));
}

/// The first rank alone writes and says anything.
int render_in_rank(const RenderArguments& arguments, mpi::Ranks& ranks) {
  std::optional<Outputs> outputs;
  std::optional<Job> job;
  agree(ranks, [&] {
    if (ranks.is_first()) outputs.emplace(arguments);
    job.emplace(arguments);
    if (outputs) outputs->attach(*job);
    require_renderable(job->options);
  });
  require_one_render(ranks, job->settings);
  const std::unique_ptr<Progress> progress = outputs ? tell_of(arguments, *job) : nullptr;
  const output::StopRequests stops_at_signals;
  const double every = arguments.checkpoint.file.empty() ? 0 : arguments.checkpoint.every;
  const renderer::RenderResult result = render_by_ranks(ranks, job->scene, job->options, every);
  if (outputs) return outputs->write(*job, result);
  return result.stopped ? output::exit_code_of_signal(output::stop_signal()) : kExitFine;
}

int run_render(const RenderArguments& arguments) {
  if (!arguments.ranks.asked_for) return render_alone(arguments);
  return mpi::run_in_ranks(arguments.ranks.timeout,
                           [&](mpi::Ranks& ranks) { return render_in_rank(arguments, ranks); });
}

}  // namespace

void add_render_command(options::CommandLine& line) {
  const auto arguments = std::make_shared<RenderArguments>();
  options::Command command = line.add_command("render", "Render a scene to an OpenEXR image");
  add_render_options(command, *arguments);
  command.footer(R"(Examples:
  plumbline render furnace_cube -o cube.exr --strategy one-sample --heuristic balance --spp 1024
  plumbline render sphere_light -o light.exr -D radius=0.1 -D height=2 --error 0.01
  plumbline render scene.xml -o /dev/null --seconds 30 --threads 1 --json timing.json
  plumbline render scene.xml -o long.exr --spp 65536 --checkpoint long.checkpoint
  mpirun -n 8 plumbline render scene.xml -o out.exr --mpi --spp 4096

Ctrl-C, TERM, HUP and USR1 stop a render within a second and write the image of the samples that are there; their
number stands in its header. A second signal stops at once. Exit code 128 + signal: 130, 143, 129, 138.
A checkpoint is gone on from with the scene, settings, seed and version that it was kept of alone; --spp may be
higher.)");
  command.runs([arguments] { return run_render(*arguments); });
}

}  // namespace plumbline::tools
