#include "scenes.h"

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/render/render.h>
#include <plumbline/renderer/scene/load_scene.h>

namespace plumbline::bench {

std::filesystem::path scene_path(const std::string& name) {
  if (analytic::find_known_scene(name) != nullptr) return analytic::scene_file(name);
  std::filesystem::path path = std::filesystem::path(PLUMBLINE_BENCH_SCENES) / (name + ".xml");
  if (!std::filesystem::exists(path)) throw renderer::InputError("no scene named '" + name + "'");
  return path;
}

renderer::SceneDescription load_at_size(const std::string& name, int width, int height) {
  renderer::SceneDescription description = renderer::load_scene(scene_path(name));
  description.camera.width = width;
  description.camera.height = height;
  return description;
}

std::vector<double> reference_luminance(const std::string& name,
                                        const renderer::SceneDescription& description,
                                        std::uint32_t reference_spp) {
  const renderer::CameraDescription& camera = description.camera;
  if (const analytic::KnownScene* known = analytic::find_known_scene(name)) {
    return analytic::make_oracle(*known, {}, analytic::FilmSize{camera.width, camera.height})
        ->image();
  }
  renderer::RenderOptions options;
  options.path.max_depth = description.integrator.max_depth;
  options.path.rr_depth = description.integrator.rr_depth;
  options.samples_per_pixel = reference_spp;
  options.seed = 0x5eed;  // no replicate has it
  const renderer::RenderResult result = render(renderer::Scene(description), options);
  std::vector<double> luminances;
  luminances.reserve(result.film.pixels().size());
  for (const renderer::PixelMoments& pixel : result.film.pixels()) {
    luminances.push_back(luminance(pixel.mean));
  }
  return luminances;
}

}  // namespace plumbline::bench
