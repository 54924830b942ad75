#include "made_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/core/sampling/pcg32.h>

namespace plumbline::bench {
namespace {

using renderer::SceneDescription;
using renderer::Vec3d;

constexpr std::uint32_t kGrey = 0, kBlack = 1;

/// Seen from (0, 0, 4): an object of radius 1 around the origin, over a floor.
SceneDescription scene_with_floor(int max_depth) {
  SceneDescription scene;
  scene.camera.origin = {0, 0, 4};
  scene.camera.left = {-1, 0, 0};
  scene.camera.up = {0, 1, 0};
  scene.camera.forward = {0, 0, -1};
  scene.camera.tan_half_fov_x = 0.35;
  scene.integrator.max_depth = max_depth;
  scene.bsdfs = renderer::make_bsdfs(
      {renderer::Lambertian{{0.7f, 0.7f, 0.7f}}, renderer::Lambertian{{0, 0, 0}}});
  scene.shapes.push_back(
      {renderer::RectangleShape{{-5, -1.2, 5}, {10, 0, 0}, {0, 0, -10}}, kGrey, {}});
  return scene;
}

void add_rectangular_light(SceneDescription& scene) {
  scene.shapes.push_back({renderer::RectangleShape{{-1, 3, -1}, {2, 0, 0}, {0, 0, 2}}, kBlack,
                          renderer::Rgbd{10, 10, 10}});
}

/// Bumps whose height falls with their size, as on a rough stone.
Vec3d displaced(const Vec3d& direction) {
  double height = 0;
  for (double f = 4; f <= 512; f *= 2) {
    height += std::sin(f * direction.x + f) * std::sin(f * direction.y + 2 * f) *
              std::sin(f * direction.z + 3 * f) / f;
  }
  return direction * (0.9 + 0.3 * height);
}

renderer::MeshShape displaced_mesh(std::size_t triangles) {
  const auto rings = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 4));
  const std::uint32_t sectors = 2 * rings;
  renderer::MeshShape mesh;
  mesh.vertices.reserve(std::size_t{rings + 1} * sectors);
  for (std::uint32_t i = 0; i <= rings; ++i) {
    // Not quite to the poles, or the triangles there would have no area.
    const double theta =
        std::numbers::pi * std::clamp(static_cast<double>(i) / rings, 1e-3, 1 - 1e-3);
    for (std::uint32_t j = 0; j < sectors; ++j) {
      const double phi = 2 * std::numbers::pi * j / sectors;
      mesh.vertices.push_back(displaced(
          {std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)}));
    }
  }
  mesh.triangles.reserve(std::size_t{2} * rings * sectors);
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t j = 0; j < sectors; ++j) {
      const std::uint32_t a = i * sectors + j, b = i * sectors + (j + 1) % sectors;
      mesh.triangles.push_back({a, a + sectors, b});
      mesh.triangles.push_back({b, a + sectors, b + sectors});
    }
  }
  return mesh;
}

/// Uniform in the cube from −1 to 1.
Vec3d point_in_cube(renderer::Pcg32& random) {
  const renderer::Vec2f xy = random.next_2d();
  const renderer::Vec3f unit{xy.x, xy.y, random.next_1d()};
  return renderer::vec_cast<double>(unit) * 2.0 - Vec3d{1, 1, 1};
}

}  // namespace

SceneDescription displaced_sphere(std::size_t triangles) {
  SceneDescription scene = scene_with_floor(7);
  add_rectangular_light(scene);
  scene.shapes.push_back({displaced_mesh(triangles), kGrey, {}});
  return scene;
}

SceneDescription many_spheres(std::size_t spheres) {
  SceneDescription scene = scene_with_floor(7);
  add_rectangular_light(scene);
  renderer::Pcg32 random(1, 0, 0);
  const double radius = 0.5 / std::cbrt(static_cast<double>(spheres));
  for (std::size_t i = 0; i < spheres; ++i) {
    scene.shapes.push_back({renderer::SphereShape{point_in_cube(random), radius}, kGrey, {}});
  }
  return scene;
}

SceneDescription many_lights(std::size_t lights) {
  SceneDescription scene = scene_with_floor(2);
  renderer::Pcg32 random(1, 0, 0);
  constexpr double kRadius = 0.005;
  const double radiance = 1 / (kRadius * kRadius * static_cast<double>(lights));
  for (std::size_t i = 0; i < lights; ++i) {
    scene.shapes.push_back({renderer::SphereShape{point_in_cube(random), kRadius}, kBlack,
                            renderer::Rgbd{radiance, radiance, radiance}});
  }
  return scene;
}

std::optional<SceneDescription> made_scene(const std::string& name) {
  if (name == "displaced_sphere") return displaced_sphere(1'000'000);
  if (name == "many_spheres") return many_spheres(100'000);
  return std::nullopt;
}

}  // namespace plumbline::bench
