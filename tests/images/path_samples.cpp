#include "path_samples.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace plumbline::tests {
namespace {

using renderer::PathCounters;
using renderer::Rgbf;
using renderer::Sampler;
using renderer::SamplerType;
using renderer::Vec2f;

constexpr std::uint64_t kChunk = 1024;

}  // namespace

verify::MomentSampler path_samples(const renderer::Scene& scene,
                                   const renderer::PathOptions& options, std::uint64_t seed,
                                   SamplerType type) {
  return [&scene, options, seed, type](std::uint64_t first, std::uint64_t count) {
    const std::uint64_t chunks = (count + kChunk - 1) / kChunk;
    std::vector<verify::Moments> parts(chunks);
    const auto width = static_cast<float>(scene.camera().width());
    const auto height = static_cast<float>(scene.camera().height());
    const std::uint32_t net_size = type == SamplerType::sobol ? kNetSize : 1;
    oneapi::tbb::parallel_for(std::uint64_t{0}, chunks, [&](std::uint64_t chunk) {
      const std::uint64_t begin = first + chunk * kChunk;
      const std::uint64_t end = std::min(begin + kChunk, first + count);
      PathCounters counters;
      for (std::uint64_t sample = begin; sample < end; ++sample) {
        double sum = 0;
        for (std::uint32_t i = 0; i < net_size; ++i) {
          Sampler random(type, seed, sample, i);
          const Vec2f film = random.next_2d();
          const Rgbf radiance =
              estimate_radiance(scene, options, scene.camera().ray(film.x * width, film.y * height),
                                random, counters);
          sum += static_cast<double>(luminance(radiance));
        }
        parts[chunk].add(sum / net_size);
      }
    });
    verify::Moments all;
    for (const verify::Moments& part : parts) all.merge(part);
    return all;
  };
}

}  // namespace plumbline::tests
