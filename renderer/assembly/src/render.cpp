#include <plumbline/renderer/assembly/render.h>

#include <memory>
#include <utility>

#include <plumbline/renderer/batched/batch.h>
#include <plumbline/renderer/core/errors.h>

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

RenderResult render(const Scene& scene, const RenderOptions& options) {
  if (options.path.max_depth < 0 && options.path.rr_depth == kNoRoulette) {
    throw InputError(
        "paths of unlimited depth without Russian roulette may never end: set a maximum depth or a "
        "roulette depth");
  }
  if (options.allocation) return render_allocated(scene, options);
  return {run_render_loop(scene.camera(), options, pixel_samplers(scene, options)), {}};
}

}  // namespace plumbline::renderer
