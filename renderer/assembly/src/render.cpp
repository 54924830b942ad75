#include <plumbline/renderer/assembly/render.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include <plumbline/renderer/batched/batch.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/loop/tiles.h>

#include "allocated.h"
#include "batched_bsdfs.h"

namespace plumbline::renderer {

SamplerFactory pixel_samplers(const Scene& scene, const RenderOptions& options) {
  const std::shared_ptr<const BsdfKernels> kernels = batched_bsdfs(scene.bsdfs());
  return [&scene, &options, kernels] {
    std::unique_ptr<PixelSampler> sampler;
    if (options.backend == Backend::batched && kernels) {
      sampler = make_batched_sampler(scene, *kernels, options.path, options.sampler, options.seed);
    }
    return sampler ? std::move(sampler)
                   : make_scalar_sampler(scene, options.path, options.sampler, options.seed);
  };
}

void require_renderable(const RenderOptions& options) {
  if (options.path.max_depth < 0 && options.path.rr_depth == kNoRoulette) {
    throw InputError(
        "paths of unlimited depth without Russian roulette may never end: set a maximum depth or a "
        "roulette depth");
  }
  require_known_error(options);
  if (options.allocation) check_allocation(options);
}

RenderResult render(const Scene& scene, const RenderOptions& options) {
  require_renderable(options);
  if (options.allocation) return render_allocated(scene, options);
  return {run_render_loop(scene.camera(), options, pixel_samplers(scene, options)), {}};
}

RenderState fresh_state(int width, int height, const RenderOptions& options) {
  const SamplingOptions& sampling = options;
  RenderState state = fresh_state(width, height, sampling);
  if (options.allocation) {
    state.bsdf_counts.resize(state.drawn.size() * options.allocation->iterations);
  }
  return state;
}

std::optional<NonFinite> first_non_finite(const Scene& scene, const RenderOptions& options,
                                          const RenderResult& result) {
  const auto& pixels = result.film.pixels();
  const auto found =
      std::find_if(pixels.begin(), pixels.end(), [](const auto& p) { return p.non_finite > 0; });
  if (found == pixels.end()) return std::nullopt;
  const auto pixel = static_cast<std::size_t>(found - pixels.begin());
  const auto width = static_cast<std::size_t>(result.film.width());
  NonFinite place{static_cast<int>(pixel % width), static_cast<int>(pixel / width), {}};
  if (options.allocation) return place;
  const SamplerFactory make_sampler = pixel_samplers(scene, options);  // keeps what they share
  // By a tile, so that denormal numbers are zero as they were then.
  TileThreads(1).run(1, 1, 1, [&](const Tile&) {
    const std::unique_ptr<PixelSampler> sampler = make_sampler();
    for (std::uint32_t i = 0; i < result.drawn[pixel] && !place.sample; ++i) {
      const std::uint32_t s = options.first_sample + i;
      PixelMoments moments;
      sampler->sample(place.x, place.y, pixel * options.replicates + s % options.replicates,
                      s / options.replicates, moments);
      sampler->finish();
      if (moments.non_finite > 0) place.sample = s;
    }
  });
  return place;
}

}  // namespace plumbline::renderer
