#include "allocation_options.h"

#include <fmt/format.h>

#include <vector>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/exr.h>

#include "render_values.h"

namespace plumbline::tools {
namespace {

constexpr std::uint32_t kMaxIterations = 1u << 20;
constexpr std::uint32_t kSamples = 1000;  // 50 in each of 20 iterations

}  // namespace

void add_allocation_options(options::Command& command, AllocationArguments& arguments) {
  options::Option allocation =
      command
          .add_text(
              "--allocation",
              [&](const std::string& text) {
                arguments.policy =
                    parse_name("--allocation", "policy", renderer::kAllocations, text);
              },
              fmt::format("Direct light by BSDF and light samples, shared out pixel by pixel: {}",
                          fmt::join(names_of(renderer::kAllocations), ", ")))
          .type("NAME");
  for (const char* other : {"--strategy", "--heuristic", "--counts", "--light-probability",
                            "--sampler", "--adaptive", "--seconds", "--error"}) {
    allocation.excludes(other);
  }
  const auto add = [&](const char* option, auto& value, const char* meaning, const char* type) {
    return command.add(option, value, meaning).type(type).needs("--allocation");
  };
  add("--iterations", arguments.options.iterations, "Of the allocation; 20 without it", "N")
      .whole_number(1, kMaxIterations);
  add("--share-limit", arguments.options.limit, "Least share of a technique; 0.1 without it", "A")
      .positive_number();
  add("--cost-ratio", arguments.options.cost_ratio,
      "For cost-aware: time of a BSDF sample over that of a light sample", "C")
      .positive_number();
  add("--share-map", arguments.share_map,
      "Write the share of BSDF samples of each pixel to this OpenEXR file", "FILE");
}

void set_allocation(const AllocationArguments& arguments, bool samples_given,
                    renderer::RenderOptions& options) {
  if (!arguments.policy) return;
  options.allocation = arguments.options;
  options.allocation->policy = *arguments.policy;
  options.path.heuristic = renderer::Heuristic::balance;
  if (!samples_given) options.samples_per_pixel = kSamples;
  if (*arguments.policy == renderer::Allocation::cost_aware && arguments.options.cost_ratio == 1) {
    throw renderer::InputError(
        "--allocation cost-aware needs --cost-ratio: at equal costs it is root-nodes");
  }
}

ShareMap::ShareMap(const AllocationArguments& arguments, output::Files& files)
    : file_(arguments.share_map.empty() ? nullptr
                                        : &files.writes("--share-map", arguments.share_map)),
      iterations_(arguments.options.iterations) {}

void ShareMap::write(const renderer::RenderResult& result) const {
  if (!file_) return;
  renderer::Image map;
  map.width = result.film.width();
  map.height = result.film.height();
  for (const float share : final_shares(result, iterations_)) {
    map.pixels.push_back({share, share, share});
  }
  file_->fill([&](const auto& path) { write_exr(path, map); });
}

}  // namespace plumbline::tools
