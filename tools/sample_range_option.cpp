#include "sample_range_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include <plumbline/merging/merge.h>
#include <plumbline/merging/sample_range.h>
#include <plumbline/renderer/core/errors.h>

#include "render_arguments.h"

namespace plumbline::tools {
namespace {

/// Of a Sobol' sequence the points k·2^m … (k + 1)·2^m − 1 are a net of their own; others are parts
/// of nets, and the samples before them the other parts.
void require_whole_nets(const renderer::RenderOptions& options) {
  const std::uint32_t first = options.first_sample, samples = options.samples_per_pixel;
  const std::uint32_t each = std::max(samples / options.replicates, 1u);
  const std::uint64_t lower = std::uint64_t{options.replicates} * std::bit_floor(each);
  if (lower != samples) {
    throw renderer::InputError(fmt::format(
        "--first-sample {}: --spp {} is no whole net of Sobol points in each of {} replicates: "
        "write --spp {} or {}",
        first, samples, options.replicates, lower, 2 * lower));
  }
  if (first % samples == 0) return;
  const std::uint64_t before = first - first % samples;
  throw renderer::InputError(
      fmt::format("--first-sample {}: cuts a net of Sobol points in two: write {} or {}, a "
                  "multiple of --spp {}",
                  first, before, before + samples, samples));
}

}  // namespace

void add_sample_range_option(options::Command& command, renderer::RenderOptions& options) {
  command
      .add("--first-sample", options.first_sample,
           "Number of the first sample of each pixel, 0 without it: the seed's samples from there "
           "on, to be merged with those before. Under sobol a multiple of --spp")
      .whole_number(0, kMaxSamples - 1)
      .excludes("--seconds")
      .excludes("--error")
      .excludes("--adaptive")
      .type("K");
}

void check_first_sample(const renderer::RenderOptions& options) {
  if (options.first_sample == 0) return;
  if (options.samples_per_pixel > kMaxSamples - options.first_sample) {
    throw renderer::InputError(fmt::format("--first-sample {}: there are {} samples, not {} more",
                                           options.first_sample, kMaxSamples,
                                           options.samples_per_pixel));
  }
  if (options.sampler == renderer::SamplerType::sobol) require_whole_nets(options);
}

std::uint64_t end_sample(const renderer::RenderOptions& options,
                         const renderer::RenderResult& result) {
  return std::uint64_t{options.first_sample} + output::most_drawn(result.drawn);
}

std::map<std::string, std::string> origin(const output::CheckpointSettings& settings,
                                          const renderer::RenderOptions& options,
                                          const renderer::RenderResult& result,
                                          const std::string& shard) {
  const merging::SampleRange range{options.seed, options.first_sample, end_sample(options, result),
                                   merging::parse_shard(shard)};
  std::map<std::string, std::string> data = merging::header_of(settings);
  data["holds"] = merging::to_text({range});
  return data;
}

}  // namespace plumbline::tools
