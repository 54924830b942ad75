#include "scenes.h"

#include <map>
#include <utility>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include "made_scenes.h"

namespace plumbline::bench {
namespace {

/// The values under which a known scene is grey; none for other scenes.
std::map<std::string, std::string> grey_parameters(const std::string& name) {
  std::map<std::string, std::string> parameters;
  if (const analytic::KnownScene* known = analytic::find_known_scene(name)) {
    for (const auto& [parameter, value] : in_grey(*known)) {
      parameters.emplace(parameter, to_text(value));
    }
  }
  return parameters;
}

}  // namespace

std::filesystem::path scene_path(const std::string& name) {
  if (analytic::find_known_scene(name) != nullptr) return analytic::scene_file(name);
  std::filesystem::path path = std::filesystem::path(PLUMBLINE_BENCH_SCENES) / (name + ".xml");
  if (!std::filesystem::exists(path)) throw renderer::InputError("no scene named '" + name + "'");
  return path;
}

renderer::SceneDescription load_at_size(const std::string& name, int width, int height) {
  auto made = made_scene(name);
  renderer::SceneDescription description =
      made ? std::move(*made) : renderer::load_scene(scene_path(name), grey_parameters(name));
  description.camera.width = width;
  description.camera.height = height;
  return description;
}

std::vector<double> reference_luminance(const std::string& name,
                                        const renderer::SceneDescription& description,
                                        std::uint32_t reference_spp) {
  const renderer::CameraDescription& camera = description.camera;
  if (const analytic::KnownScene* known = analytic::find_known_scene(name)) {
    std::vector<double> grey;
    const analytic::FilmSize film{camera.width, camera.height};
    for (const analytic::Colour& pixel : make_oracle(*known, in_grey(*known), film)->image()) {
      grey.push_back(pixel.g);
    }
    return grey;
  }
  renderer::RenderOptions options;
  options.path.max_depth = description.integrator.max_depth;
  options.path.rr_depth = description.integrator.rr_depth;
  options.samples_per_pixel = reference_spp;
  options.seed = 0x5eed;  // no replicate has it
  options.sampler = renderer::SamplerType::sobol;
  const renderer::RenderResult result = render(renderer::make_scene(description), options);
  return luminances(result.film);
}

std::vector<double> luminances(const renderer::Film& film) {
  std::vector<double> values;
  values.reserve(film.pixels().size());
  for (const renderer::PixelMoments& pixel : film.pixels()) values.push_back(luminance(pixel.mean));
  return values;
}

double rel_mse(const std::vector<double>& image, const std::vector<double>& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const double difference = image[i] - reference[i];
    sum += difference * difference / (reference[i] * reference[i] + 0.01);
  }
  return sum / static_cast<double>(reference.size());
}

}  // namespace plumbline::bench
