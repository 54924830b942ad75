#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <plumbline/options/options.h>
#include <plumbline/output/output_file.h>
#include <plumbline/renderer/assembly/render.h>

namespace plumbline::tools {

/// What `render` was told about the allocation of samples.
struct AllocationArguments {
  std::optional<renderer::Allocation> policy;
  renderer::AllocationOptions options;
  std::string share_map;
};

/// Adds --allocation, which rules out the options that it takes the place of, and the options that
/// need it.
void add_allocation_options(options::Command& command, AllocationArguments& arguments);

/// Makes the options those of the allocation, if there is one: with the balance heuristic.
///
/// @param samples_given  or else the sample count becomes that of the allocation: 1000
/// @throws renderer::InputError for cost-aware without costs
void set_allocation(const AllocationArguments& arguments, bool samples_given,
                    renderer::RenderOptions& options);

/// The share of BSDF samples that each pixel came to, as a grey image: one of the files before the
/// render, written after it. Nothing without --share-map.
class ShareMap {
 public:
  ShareMap(const AllocationArguments& arguments, output::Files& files);
  void write(const renderer::RenderResult& result) const;

 private:
  output::OutputFile* file_;
  std::uint32_t iterations_;
};

}  // namespace plumbline::tools
