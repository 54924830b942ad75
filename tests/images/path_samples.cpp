#include "path_samples.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/render.h>

namespace plumbline::tests {
namespace {

using renderer::PixelMoments;
using renderer::PixelSampler;
using renderer::RenderOptions;
using renderer::Rgbd;
using renderer::SamplerType;
using renderer::Scene;

constexpr std::uint64_t kChunk = renderer::kSamplesPerTile;

/// What is judged of a sample: a path, or the mean of a net of them.
using Quantity = double (*)(const Rgbd& mean);

double value_of(const PixelMoments& moments, Quantity quantity) {
  return moments.non_finite > 0 ? std::numeric_limits<double>::quiet_NaN() : quantity(moments.mean);
}

/// Moments of N quantities of the same samples.
template <std::size_t N>
class PathSamples {
 public:
  using All = std::array<verify::Moments, N>;

  PathSamples(const Scene& scene, RenderOptions options, const std::array<Quantity, N>& quantities)
      : options_(std::move(options)),
        quantities_(quantities),
        samplers_(pixel_samplers(scene, options_)) {}

  All draw(std::uint64_t first, std::uint64_t count) {
    const std::uint64_t chunks = (count + kChunk - 1) / kChunk;
    std::vector<All> parts(chunks);
    oneapi::tbb::parallel_for(std::uint64_t{0}, chunks, [&](std::uint64_t chunk) {
      const std::uint64_t begin = first + chunk * kChunk;
      parts[chunk] = draw_chunk(begin, std::min(begin + kChunk, first + count));
    });
    All all;
    for (const All& part : parts) {
      for (std::size_t i = 0; i < N; ++i) all[i].merge(part[i]);
    }
    return all;
  }

 private:
  All draw_chunk(std::uint64_t begin, std::uint64_t end) {
    const std::uint32_t net_size = options_.sampler == SamplerType::sobol ? kNetSize : 1;
    PixelSampler& sampler = *samplers_.local();
    std::vector<PixelMoments> nets(end - begin);
    for (std::uint64_t net = begin; net < end; ++net) {
      for (std::uint32_t i = 0; i < net_size; ++i) sampler.sample(0, 0, net, i, nets[net - begin]);
    }
    sampler.finish();
    All moments;
    // All quantities of a sample together: each waits for its own last sum, not for the others'.
    for (const PixelMoments& net : nets) {
      for (std::size_t i = 0; i < N; ++i) moments[i].add(value_of(net, quantities_[i]));
    }
    return moments;
  }

  RenderOptions options_;
  std::array<Quantity, N> quantities_;
  oneapi::tbb::enumerable_thread_specific<std::unique_ptr<PixelSampler>> samplers_;
};

template <std::size_t N>
std::shared_ptr<PathSamples<N>> make_samples(const Scene& scene, const renderer::PathOptions& path,
                                             std::uint64_t seed, SamplerType sampler,
                                             renderer::Backend backend,
                                             const std::array<Quantity, N>& quantities) {
  if (scene.camera().width() != 1 || scene.camera().height() != 1) {
    throw std::invalid_argument("samples of paths take a scene of one pixel");
  }
  RenderOptions options;
  options.path = path;
  options.seed = seed;
  options.sampler = sampler;
  options.backend = backend;
  return std::make_shared<PathSamples<N>>(scene, std::move(options), quantities);
}

}  // namespace

renderer::SceneDescription one_pixel(renderer::SceneDescription scene) {
  renderer::CameraDescription& camera = scene.camera;
  // The height of the film follows from its width and the number of pixels: stretched, `up` keeps
  // it.
  camera.up = camera.up * (static_cast<double>(camera.height) / camera.width);
  camera.width = camera.height = 1;
  return scene;
}

ColourSampler path_samples(const Scene& scene, const renderer::PathOptions& path,
                           std::uint64_t seed, SamplerType sampler, renderer::Backend backend) {
  const auto samples =
      make_samples<3>(scene, path, seed, sampler, backend,
                      {[](const Rgbd& c) { return c.r; }, [](const Rgbd& c) { return c.g; },
                       [](const Rgbd& c) { return c.b; }});
  return
      [samples](std::uint64_t first, std::uint64_t count) { return samples->draw(first, count); };
}

verify::MomentSampler luminance_samples(const Scene& scene, const renderer::PathOptions& path,
                                        std::uint64_t seed, SamplerType sampler) {
  const auto samples = make_samples<1>(scene, path, seed, sampler, renderer::Backend::batched,
                                       {[](const Rgbd& c) { return luminance(c); }});
  return [samples](std::uint64_t first, std::uint64_t count) {
    return samples->draw(first, count)[0];
  };
}

}  // namespace plumbline::tests
