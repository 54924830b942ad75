#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <variant>

#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/core/sampling/sobol.h>

namespace plumbline::renderer {

/// Where random numbers come from.
enum class SamplerType {
  independent,  ///< every number on its own (PCG32)
  sobol         ///< Owen-scrambled Sobol' pairs, stratified over the samples of a pixel
};

/// The random numbers of one path, uniform in [0, 1) and never 1. Which numbers they are depends on
/// the arguments alone, not on who asked before.
class Sampler {
 public:
  /// @param net    pixel, or replicate of a pixel, whose samples belong together
  /// @param index  of the sample in it; under Sobol < 2^32
  Sampler(SamplerType type, std::uint64_t seed, std::uint64_t net, std::uint64_t index)
      : source_(type == SamplerType::sobol ? Source(SobolSampler(seed, net, index))
                                           : Source(Pcg32(seed, net, index))) {}

  float next_1d() {
    return std::visit([](auto& source) { return source.next_1d(); }, source_);
  }

  /// A pair that is stratified together: the two numbers of one direction, or of one point.
  Vec2f next_2d() {
    return std::visit([](auto& source) { return source.next_2d(); }, source_);
  }

 private:
  using Source = std::variant<Pcg32, SobolSampler>;
  Source source_;
};

}  // namespace plumbline::renderer
