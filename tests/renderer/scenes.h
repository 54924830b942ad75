#pragma once

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/assembly/description.h>

/// Small scenes made in code, for tests that need no file.
namespace plumbline::tests {

inline renderer::SceneDescription empty_scene(int width, int height) {
  renderer::SceneDescription scene;
  scene.bsdfs = renderer::make_bsdfs({renderer::Lambertian{{0.5f, 0.5f, 0.5f}}});
  scene.camera = {.origin = {0, 0, 0},
                  .left = {-1, 0, 0},
                  .up = {0, 1, 0},
                  .forward = {0, 0, 1},
                  .tan_half_fov_x = 1,
                  .width = width,
                  .height = height};
  return scene;
}

/// A camera off the centre of a closed sphere that emits `radiance` and reflects half: 2·radiance
/// everywhere, the geometric series of albedo 1/2.
inline renderer::SceneDescription closed_sphere(int width, int height,
                                                const renderer::Vec3d& center = {0, 0, 0},
                                                double radius = 1, double radiance = 0.5) {
  renderer::SceneDescription scene = empty_scene(width, height);
  scene.camera.origin = center + renderer::Vec3d{0.3, 0.2, 0.1} * radius;
  scene.shapes.push_back({renderer::SphereShape{center, radius, true}, 0,
                          renderer::Rgbd{radiance, radiance, radiance}});
  return scene;
}

inline renderer::Scene made_with(renderer::SceneDescription scene,
                                 renderer::Accelerator accelerator) {
  scene.accelerator = accelerator;
  return make_scene(scene);
}

}  // namespace plumbline::tests
