#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <plumbline/merging/merge.h>
#include <plumbline/output/output_file.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/exr.h>

#include "command.h"

namespace plumbline::tools {
namespace {

struct MergeArguments {
  std::vector<std::string> parts;
  std::string output;
};

/// By its first bytes, whatever it is called.
bool is_exr(const std::string& file) {
  constexpr std::array kMagic = {'\x76', '\x2f', '\x31', '\x01'};
  std::array<char, kMagic.size()> start{};
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  return start == kMagic;
}

renderer::Image merge(const std::vector<std::string>& parts) {
  const auto images = std::count_if(parts.begin(), parts.end(), is_exr);
  if (images == 0) return merging::merge_checkpoints(parts);
  const auto other = std::find_if_not(parts.begin(), parts.end(), is_exr);
  if (other == parts.end()) return merging::merge_images(parts);
  throw renderer::InputError(*other +
                             ": is no OpenEXR image, as others are: checkpoints hold more "
                             "digits, and are merged with each other");
}

int run_merge(const MergeArguments& arguments) {
  output::Files files;
  for (const std::string& file : arguments.parts) files.reads(file);
  output::OutputFile& output = files.writes("--output", arguments.output);
  const renderer::Image image = merge(arguments.parts);
  output.fill([&](const auto& path) { write_exr(path, image); });
  files.finish();
  fmt::print("{}: {} samples per pixel of {} parts, seed {}\n", arguments.output,
             image.metadata.at("samples"), arguments.parts.size(), image.metadata.at("seed"));
  return kExitFine;
}

}  // namespace

void add_merge_command(options::CommandLine& line) {
  const auto arguments = std::make_shared<MergeArguments>();
  options::Command command = line.add_command(
      "merge", "Make one image of checkpoints, or of images, of one scene and settings");
  command.add("parts", arguments->parts, "Of render: --checkpoint, or -o").required().type("");
  command.add("-o,--output", arguments->output, "OpenEXR file to write").required().type("FILE");
  command.footer(
      R"(Checkpoints are exact: shards of one seed give the image of a render without --shard, bit for bit; other seeds and
other samples of a seed (--first-sample) are added in double, in an order that the command line does not change. Images
hold floats: each layer is that of the checkpoints but for their rounding, within 3 units in the last digit for a mean.
The same samples twice, another scene, other settings and another version are refused; so are images of one seed under
--sampler sobol: points of one scramble depend on each other, and only checkpoints know how.

Examples:
  plumbline render scene.xml -o /dev/null --shard 1/2 --checkpoint 1.state
  plumbline render scene.xml -o /dev/null --shard 2/2 --checkpoint 2.state
  plumbline merge 1.state 2.state -o scene.exr
  plumbline render scene.xml -o a.exr --spp 64
  plumbline render scene.xml -o b.exr --spp 64 --first-sample 64
  plumbline render scene.xml -o c.exr --spp 64 --seed 1
  plumbline merge a.exr b.exr c.exr -o scene.exr)");
  command.runs([arguments] { return run_merge(*arguments); });
}

}  // namespace plumbline::tools
