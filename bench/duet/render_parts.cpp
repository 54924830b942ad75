#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/core/sampling/warps.h>
#include <plumbline/renderer/core/scene/scene.h>
#include <plumbline/renderer/image_io/exr.h>
#include <plumbline/renderer/scene_file/load_scene.h>

#include "parts.h"

namespace plumbline::duet {
namespace {

using namespace renderer;

/// Of the film [pixels].
int side_of(Size size) { return size == Size::timed ? 16 : 2; }

/// A scene with the way in which it is rendered, by one thread.
struct Rendering {
  Scene scene;
  RenderOptions options;

  Rendering(const SceneDescription& description, Strategy strategy, Backend backend)
      : scene(make_scene(description)) {
    options.path.strategy = strategy;
    options.path.max_depth = description.integrator.max_depth;
    options.path.rr_depth = description.integrator.rr_depth;
    options.sampler = SamplerType::sobol;
    options.samples_per_pixel = backend == Backend::batched ? 4 : 1;
    options.threads = 1;
    options.backend = backend;
  }
};

SceneDescription small_scene(const std::string& name, Size size) {
  SceneDescription description =
      load_scene(std::filesystem::path(PLUMBLINE_DUET_SCENES) / (name + ".xml"), {});
  description.camera.width = side_of(size);
  description.camera.height = side_of(size);
  return description;
}

Counters render_once(const Rendering& rendering) {
  const RenderResult rendered = render(rendering.scene, rendering.options);
  Counters counters;
  const PathCounters& c = rendered.counters;
  counters.rays = c.camera_rays + c.bounce_rays + c.shadow_rays;
  for (const PixelMoments& pixel : rendered.film.pixels()) {
    counters.result = with_bits(counters.result, pixel.mean.r + pixel.mean.g + pixel.mean.b);
  }
  return counters;
}

Part render_part(const std::string& name, const std::string& scene, Strategy strategy,
                 Backend backend) {
  return {"render/" + name,
          [=](Size size) -> Work {
            return [rendering =
                        std::make_shared<Rendering>(small_scene(scene, size), strategy, backend)] {
              return render_once(*rendering);
            };
          },
          false};
}

/// Rays from what the camera sees, towards the lights.
std::vector<Ray> shadow_rays_of(const Scene& scene) {
  std::vector<Ray> rays;
  const int width = scene.camera().width(), height = scene.camera().height();
  for (int pixel = 0; pixel < width * height; ++pixel) {
    Pcg32 random(1, static_cast<std::uint64_t>(pixel), 0);
    const auto hit =
        scene.intersect(scene.camera().ray(pixel % width, pixel / width, random.next_2d()));
    if (!hit) continue;
    for (int i = 0; i < 8; ++i) {
      const auto light = scene.lights().sample(hit->position, random.next_2d());
      if (!light || dot(hit->normal, light->wi) <= 0) continue;
      const Ray ray = shadow_ray(*hit, *light);
      if (ray.t_max > 0) rays.push_back(ray);
    }
  }
  return rays;
}

Work shadow_rays(Size size) {
  const auto scene = std::make_shared<Scene>(make_scene(small_scene("cornell", size)));
  return [scene, rays = shadow_rays_of(*scene)] {
    Counters counters;
    counters.rays = rays.size();
    for (const Ray& ray : rays) counters.result += scene->occluded(ray) ? 1u : 0u;
    return counters;
  };
}

/// An image file, removed at the end.
struct ScratchImage {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("duet." + std::to_string(getpid()) + ".exr");
  Image image;

  ScratchImage() : image{32, 32, {}, {}, {}, {}} {
    Pcg32 random(1, 0, 0);
    for (int i = 0; i < image.width * image.height; ++i) {
      image.pixels.push_back({random.next_1d(), random.next_1d(), random.next_1d()});
    }
  }
  ~ScratchImage() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  ScratchImage(const ScratchImage&) = delete;
  ScratchImage& operator=(const ScratchImage&) = delete;
};

Work image_file(Size) {
  return [scratch = std::make_shared<ScratchImage>()] {
    write_exr(scratch->path, scratch->image);
    Counters counters;
    counters.bytes = std::filesystem::file_size(scratch->path);
    return counters;
  };
}

std::vector<Part> make_render_parts() {
  return {render_part("bsdf", "cornell", Strategy::bsdf, Backend::scalar),
          render_part("light", "cornell", Strategy::light, Backend::scalar),
          render_part("mis", "cornell", Strategy::mis, Backend::scalar),
          render_part("one_sample", "cornell", Strategy::one_sample, Backend::scalar),
          render_part("batched", "cornell", Strategy::mis, Backend::batched),
          render_part("batched_veach", "veach", Strategy::mis, Backend::batched),
          {"shadow-rays", shadow_rays},
          {"image-file", image_file, false}};
}

}  // namespace

std::span<const Part> render_parts() {
  static const std::vector<Part> parts = make_render_parts();
  return parts;
}

}  // namespace plumbline::duet
