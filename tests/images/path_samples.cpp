#include "path_samples.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
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
using renderer::SamplerType;
using renderer::Scene;

constexpr std::uint64_t kChunk = renderer::kSamplesPerTile;

double luminance_of(const PixelMoments& moments) {
  return moments.non_finite > 0 ? std::numeric_limits<double>::quiet_NaN()
                                : luminance(moments.mean);
}

class PathSamples {
 public:
  PathSamples(const Scene& scene, RenderOptions options)
      : options_(std::move(options)), samplers_(pixel_samplers(scene, options_)) {}

  verify::Moments draw(std::uint64_t first, std::uint64_t count) {
    const std::uint64_t chunks = (count + kChunk - 1) / kChunk;
    std::vector<verify::Moments> parts(chunks);
    oneapi::tbb::parallel_for(std::uint64_t{0}, chunks, [&](std::uint64_t chunk) {
      const std::uint64_t begin = first + chunk * kChunk;
      parts[chunk] = draw_chunk(begin, std::min(begin + kChunk, first + count));
    });
    verify::Moments all;
    for (const verify::Moments& part : parts) all.merge(part);
    return all;
  }

 private:
  verify::Moments draw_chunk(std::uint64_t begin, std::uint64_t end) {
    const std::uint32_t net_size = options_.sampler == SamplerType::sobol ? kNetSize : 1;
    PixelSampler& sampler = *samplers_.local();
    std::vector<PixelMoments> nets(end - begin);
    for (std::uint64_t net = begin; net < end; ++net) {
      for (std::uint32_t i = 0; i < net_size; ++i) sampler.sample(0, 0, net, i, nets[net - begin]);
    }
    sampler.finish();
    verify::Moments moments;
    for (const PixelMoments& net : nets) moments.add(luminance_of(net));
    return moments;
  }

  RenderOptions options_;
  oneapi::tbb::enumerable_thread_specific<std::unique_ptr<PixelSampler>> samplers_;
};

}  // namespace

renderer::SceneDescription one_pixel(renderer::SceneDescription scene) {
  renderer::CameraDescription& camera = scene.camera;
  // The height of the film follows from its width and the number of pixels: stretched, `up` keeps
  // it.
  camera.up = camera.up * (static_cast<double>(camera.height) / camera.width);
  camera.width = camera.height = 1;
  return scene;
}

verify::MomentSampler path_samples(const Scene& scene, const renderer::PathOptions& path,
                                   std::uint64_t seed, SamplerType sampler) {
  if (scene.camera().width() != 1 || scene.camera().height() != 1) {
    throw std::invalid_argument("path_samples takes a scene of one pixel");
  }
  RenderOptions options;
  options.path = path;
  options.seed = seed;
  options.sampler = sampler;
  const auto samples = std::make_shared<PathSamples>(scene, std::move(options));
  return
      [samples](std::uint64_t first, std::uint64_t count) { return samples->draw(first, count); };
}

}  // namespace plumbline::tests
