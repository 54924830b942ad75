#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/output/checkpoint.h>
#include <plumbline/output/output_file.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/exr.h>

#include "checkpoint_options.h"
#include "command.h"

namespace plumbline::tools {
namespace {

struct MergeArguments {
  std::vector<std::string> checkpoints;
  std::string output;
};

constexpr const char* kSeed = "seed";

/// Of one checkpoint of those that are put together: which samples it holds.
struct Part {
  std::string file;
  std::string seed;
  std::vector<std::uint32_t> drawn;
};

/// What has been put together so far.
class Sum {
 public:
  /// In the order of the calls: other orders round otherwise where pixels have samples of several.
  void add(const std::string& file) {
    output::Checkpoint checkpoint = output::read_checkpoint(file);
    const std::string seed = checkpoint.settings[kSeed];
    checkpoint.settings.erase(kSeed);
    renderer::RenderState& state = checkpoint.state;
    if (parts_.empty()) {
      settings_ = std::move(checkpoint.settings);
      film_ = renderer::Film(state.film.width(), state.film.height());
      samples_.resize(film_.pixels().size());
    } else {
      output::require_same(file, checkpoint.settings, settings_);
    }
    require_other_samples(file, seed, state.drawn);
    if (state.drawn.size() != samples_.size()) {
      throw renderer::InputError(file + ": does not hold what it says");
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (!state.replicates.empty()) state.sum_replicates(i);
      film_.pixels()[i].merge(state.film.pixels()[i]);
      if (output::is_here(state.drawn[i])) samples_[i] += state.drawn[i];
    }
    parts_.push_back({file, seed, std::move(state.drawn)});
  }

  /// @throws renderer::InputError for pixels that no part has
  renderer::Image image() const {
    const auto missing = std::count(samples_.begin(), samples_.end(), std::uint64_t{0});
    if (missing > 0) {
      throw renderer::InputError(
          fmt::format("{} of {} pixels are in none of the checkpoints; is a shard missing?",
                      missing, samples_.size()));
    }
    renderer::Image image = to_image(film_);
    image.metadata = metadata();
    return image;
  }

 private:
  /// The same seed gives the same samples: those of one pixel count once.
  void require_other_samples(const std::string& file, const std::string& seed,
                             const std::vector<std::uint32_t>& drawn) const {
    for (const Part& part : parts_) {
      if (part.seed != seed) continue;
      for (std::size_t i = 0; i < std::min(drawn.size(), part.drawn.size()); ++i) {
        if (!output::is_here(drawn[i]) || !output::is_here(part.drawn[i])) continue;
        throw renderer::InputError(fmt::format("{}: holds samples of the seed {} that {} holds too",
                                               file, seed, part.file));
      }
    }
  }

  std::map<std::string, std::string> metadata() const {
    std::set<std::string> seeds;
    for (const Part& part : parts_) seeds.insert(part.seed);
    std::map<std::string, std::string> data = {
        {"seed", fmt::format("{}", fmt::join(seeds, ", "))},
        {"samples", std::to_string(*std::min_element(samples_.begin(), samples_.end()))},
        {"merged", std::to_string(parts_.size())},
        {"non_finite", std::to_string(film_.non_finite())}};
    for (const char* name : {"strategy", "heuristic", "sampler", "replicates", "version"}) {
      data[name] = settings_.at(name);
    }
    data["light_selection"] = settings_.at("light selection");
    data["accelerator"] = settings_.at("accelerator");
    data["max_depth"] = settings_.at("maximum depth");
    return data;
  }

  output::CheckpointSettings settings_;
  std::vector<Part> parts_;
  renderer::Film film_{0, 0};
  std::vector<std::uint64_t> samples_;
};

int run_merge(const MergeArguments& arguments) {
  output::Files files;
  for (const std::string& file : arguments.checkpoints) files.reads(file);
  output::OutputFile& output = files.writes("--output", arguments.output);
  Sum sum;
  for (const std::string& file : arguments.checkpoints) sum.add(file);
  const renderer::Image image = sum.image();
  output.fill([&](const auto& path) { write_exr(path, image); });
  files.finish();
  fmt::print("{}: {} samples per pixel of {} checkpoints, seed {}\n", arguments.output,
             image.metadata.at("samples"), arguments.checkpoints.size(), image.metadata.at("seed"));
  return kExitFine;
}

}  // namespace

void add_merge_command(options::CommandLine& line) {
  const auto arguments = std::make_shared<MergeArguments>();
  options::Command command =
      line.add_command("merge", "Make one image of checkpoints of one scene and settings");
  command.add("checkpoints", arguments->checkpoints, "Of render --checkpoint").required().type("");
  command.add("-o,--output", arguments->output, "OpenEXR file to write").required().type("FILE");
  command.footer(
      R"(Shards of one seed give the image of a render without --shard, bit for bit; other seeds add samples, in double and in
the order of the command line. The same samples twice, another scene, other settings and another version are refused.

Example:
  plumbline render scene.xml -o /dev/null --shard 1/2 --checkpoint 1.state
  plumbline render scene.xml -o /dev/null --shard 2/2 --checkpoint 2.state
  plumbline merge 1.state 2.state -o scene.exr)");
  command.runs([arguments] { return run_merge(*arguments); });
}

}  // namespace plumbline::tools
