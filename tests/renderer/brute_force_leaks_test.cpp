#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/core/sampling/warps.h>
#include <plumbline/renderer/core/scene/geometry.h>
#include <plumbline_tests/support.h>
#include "scenes.h"

/// Where surfaces share an edge or a corner, a ray meets one of them.
namespace plumbline::tests {
namespace {

using namespace renderer;

/// A ball of 80 triangles around a point, or a box of six rectangles.
SceneDescription closed(bool ball, const Vec3d& center) {
  SceneDescription scene = empty_scene(1, 1);
  // Specks that make the scene large, so that the ball lies far off its centre.
  for (const double side : {-20.0, 20.0}) {
    scene.shapes.push_back({SphereShape{{side, side, side}, 0.5, false}, 0, {}});
  }
  if (!ball) {
    const Vec3d u{1.6, 0.72, 0.96}, v{-1.2, 0.96, 1.28}, w = cross(u, v) * 0.5;
    const Vec3d low = center - (u + v + w) * 0.5;
    for (const Vec3d& o : {low, low + w}) {
      scene.shapes.push_back({RectangleShape{o, u, v, false}, 0, {}});
    }
    for (const Vec3d& o : {low, low + v}) {
      scene.shapes.push_back({RectangleShape{o, u, w, false}, 0, {}});
    }
    for (const Vec3d& o : {low, low + u}) {
      scene.shapes.push_back({RectangleShape{o, v, w, false}, 0, {}});
    }
    return scene;
  }
  MeshShape mesh;
  const double g = std::numbers::phi;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      mesh.vertices.push_back({0, a, b});
      mesh.vertices.push_back({a, b, 0});
      mesh.vertices.push_back({b, 0, a});
    }
  }
  std::vector<Triangle> faces;
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t j = i + 1; j < 12; ++j) {
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        const auto apart = [&](std::uint32_t a, std::uint32_t b) {
          return length(mesh.vertices[a] - mesh.vertices[b]);
        };
        if (apart(i, j) < 2.1 && apart(j, k) < 2.1 && apart(i, k) < 2.1) faces.push_back({i, j, k});
      }
    }
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] =
        middles.try_emplace(std::pair(std::min(a, b), std::max(a, b)),
                            static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(normalize(mesh.vertices[a] + mesh.vertices[b]) * 1.9);
    return place->second;
  };
  for (const auto& [a, b, c] : faces) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t :
         {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}}) {
      mesh.triangles.push_back(t);
    }
  }
  for (Vec3d& v : mesh.vertices) v = v + center;
  scene.shapes.push_back({std::move(mesh), 0, {}});
  return scene;
}

/// Rays from within at corners and edges that surfaces share, which leave nowhere.
std::size_t leaks(const Scene& scene, const Vec3d& center, std::uint64_t seed) {
  const SceneGeometry& geometry = scene.geometry();
  Pcg32 random(seed, 0, 0);
  std::size_t escaped = 0;
  const std::size_t outlines = geometry.rectangles.size() + geometry.triangles.size();
  for (int i = 0; i < 40'000; ++i) {
    const Vec2f u = random.next_2d(), w = random.next_2d();
    const auto n = static_cast<std::size_t>(static_cast<double>(u.x) * double(outlines));
    const std::uint32_t* of = n < geometry.rectangles.size()
                                  ? geometry.rectangles[n].data()
                                  : geometry.triangles[n - geometry.rectangles.size()].data();
    const float along = w.y < 0.3f ? 0 : w.x;
    const Vec3f a = geometry.vertices[of[0]], b = geometry.vertices[of[1]];
    const Vec3f from =
        vec_cast<float>(center) + square_to_uniform_sphere(random.next_2d()) * (0.4f * u.y);
    const auto hit = scene.intersect({from, normalize(a + (b - a) * along - from)});
    escaped += !hit || length(hit->position - vec_cast<float>(center)) > 3 ? 1u : 0u;
  }
  return escaped;
}

TEST(BruteForce, NoRayLeavesAClosedSurfaceThroughItsEdgesAndCorners) {
  for (const bool ball : {false, true}) {
    for (const Vec3d& center : {Vec3d{0.1, 0.2, 0.3}, Vec3d{17, -15, 11}}) {
      const std::string what = fmt::format("{} at {}", ball ? "ball" : "box", center.x);
      const std::size_t embrees = leaks(made_with(closed(ball, center), Accelerator::embree),
                                        center, check_seed("leaks/" + what));
      EXPECT_EQ(leaks(made_with(closed(ball, center), Accelerator::brute_force), center,
                      check_seed("leaks/" + what)),
                0u)
          << what << "; through Embree's " << embrees;
      fmt::print("{}: {} of 40000 leave through Embree's\n", what, embrees);
    }
  }
}

}  // namespace
}  // namespace plumbline::tests
