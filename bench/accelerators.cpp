#include "accelerators.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/brute_force/brute_force.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/core/sampling/warps.h>
#include <plumbline/renderer/core/scene/geometry.h>
#include "clock.h"
#include "publish.h"
#include "scenes.h"
#include "statistics.h"

namespace plumbline::bench {
namespace {

using renderer::Accelerator;
using renderer::Scene;
using renderer::Vec3d;
using renderer::embree::kPacket;

Vec3d random_point(renderer::Pcg32& random) {
  const renderer::Vec2f u = random.next_2d();
  return {static_cast<double>(u.x), static_cast<double>(u.y),
          static_cast<double>(random.next_1d())};
}

Vec3d random_edge(renderer::Pcg32& random) { return random_point(random) - random_point(random); }

enum class Kind { triangles, rectangles, spheres };
constexpr std::array kKinds{Kind::triangles, Kind::rectangles, Kind::spheres};
constexpr std::array kKindNames{"triangles", "rectangles", "spheres"};

/// So many in the unit cube, the smaller the more there are: rays hit something in most cases.
renderer::SceneDescription scattered(Kind kind, std::size_t count) {
  renderer::SceneDescription scene;
  scene.bsdfs = renderer::make_bsdfs({renderer::Lambertian{{0.5f, 0.5f, 0.5f}}});
  scene.camera = {{0.5, 0.5, -2}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, 8, 8};
  renderer::Pcg32 random(7, count, 0);
  const double size = 1 / std::cbrt(static_cast<double>(count));
  renderer::MeshShape mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d at = random_point(random);
    const Vec3d u = normalize(random_edge(random)) * size, w = random_edge(random);
    const Vec3d v = normalize(cross(u, w)) * size;
    if (kind == Kind::spheres) {
      scene.shapes.push_back({renderer::SphereShape{at, size / 3, false}, 0, {}});
    } else if (kind == Kind::rectangles) {
      scene.shapes.push_back({renderer::RectangleShape{at, u, v, false}, 0, {}});
    } else {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const Vec3d& corner : {at, at + u, at + v}) mesh.vertices.push_back(corner);
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  }
  if (kind == Kind::triangles) scene.shapes.push_back({std::move(mesh), 0, {}});
  return scene;
}

/// Rays of one octant in each packet, from anywhere: as bounces are sorted by the batched backend.
std::vector<RTCRayHit16> packets_of_octants(std::size_t count) {
  std::vector<RTCRayHit16> packets(count);
  renderer::Pcg32 random(1, 0, 0);
  for (RTCRayHit16& packet : packets) {
    packet = {};
    const Vec3d signs = random_edge(random);
    for (std::size_t k = 0; k < kPacket; ++k) {
      const Vec3d o = random_point(random) - Vec3d{0.5, 0.5, 0.5};
      const renderer::Vec3f d = square_to_uniform_sphere(random.next_2d());
      packet.ray.org_x[k] = static_cast<float>(o.x);
      packet.ray.org_y[k] = static_cast<float>(o.y);
      packet.ray.org_z[k] = static_cast<float>(o.z);
      packet.ray.dir_x[k] = signs.x < 0 ? -std::abs(d.x) : std::abs(d.x);
      packet.ray.dir_y[k] = signs.y < 0 ? -std::abs(d.y) : std::abs(d.y);
      packet.ray.dir_z[k] = signs.z < 0 ? -std::abs(d.z) : std::abs(d.z);
      packet.ray.tnear[k] = renderer::kNearest;
      packet.ray.mask[k] = ~0u;
    }
  }
  return packets;
}

/// Time for each ray [ns], all packets asked once.
double ns_per_ray(const Scene& scene, std::vector<RTCRayHit16>& packets, bool nearest) {
  alignas(64) int valid[kPacket];
  for (int& lane : valid) lane = -1;
  const auto ask_all = [&] {
    for (RTCRayHit16& packet : packets) {
      for (std::size_t k = 0; k < kPacket; ++k) {
        packet.ray.tfar[k] = nearest ? std::numeric_limits<float>::infinity() : 0.5f;
        packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      }
      if (nearest) {
        scene.geometry().intersect(valid, packet, renderer::embree::Coherence::coherent);
      } else {
        scene.geometry().occluded(valid, packet.ray);
      }
    }
  };
  return 1e9 * seconds_of(ask_all) / static_cast<double>(packets.size() * kPacket);
}

struct Pair {
  Scene tree, brute_force;
};

Pair made_with_both(renderer::SceneDescription description) {
  description.accelerator = Accelerator::embree;
  Scene tree = make_scene(description);
  description.accelerator = Accelerator::brute_force;
  return {std::move(tree), make_scene(description)};
}

/// Of the tree's time over that of brute force, both in turn.
template <class Time>
Estimate compare(int repetitions, const Pair& scenes, const Time& time) {
  std::vector<double> ratios;
  for (int i = 0; i < repetitions; ++i) {
    const double tree = time(scenes.tree);
    ratios.push_back(tree / time(scenes.brute_force));
  }
  return median_with_interval(std::move(ratios));
}

void measure_rays(reports::ResultLog& log, int repetitions) {
  reports::Table table;
  table.group = "Accelerators";
  table.title = "Rays against all primitives, and through a tree";
  table.caption = fmt::format(
      "Embree's time over that of brute force, packets of sixteen rays of one octant: CPU time on "
      "one thread, medians of {} repetitions in turn with 95 % intervals. --accelerator auto takes "
      "brute force up to {} primitives.",
      repetitions, renderer::kMostForBruteForce);
  table.columns = {"primitives"};
  for (const char* kind : kKindNames) {
    table.columns.push_back(fmt::format("{}, nearest hit", kind));
    table.columns.push_back(fmt::format("{}, any hit", kind));
  }
  std::vector<RTCRayHit16> packets = packets_of_octants(512);
  for (const std::size_t count : {4u, 8u, 16u, 24u, 32u, 48u, 64u, 96u, 128u, 192u, 256u}) {
    std::vector<std::string> row{std::to_string(count)};
    for (const Kind kind : kKinds) {
      const Pair scenes = made_with_both(scattered(kind, count));
      for (const bool nearest : {true, false}) {
        row.push_back(text_of(compare(repetitions, scenes, [&](const Scene& scene) {
          return ns_per_ray(scene, packets, nearest);
        })));
      }
    }
    table.rows.push_back(std::move(row));
  }
  publish(log, table);
}

void measure_renders(reports::ResultLog& log, int repetitions) {
  reports::Table table;
  table.group = "Accelerators";
  table.title = "Renders of tiny scenes without a tree";
  table.caption = fmt::format(
      "render() with Embree over render() with brute force, mis with Sobol points, 96 × 96 pixels, "
      "4 samples each: CPU time on one thread, medians of {} repetitions in turn with 95 % "
      "intervals.",
      repetitions);
  table.columns = {"scene", "primitives", "batched", "scalar"};
  for (const char* name : {"cornell", "veach", "mixed"}) {
    const auto description = load_at_size(name, 96, 96);
    const Pair scenes = made_with_both(description);
    std::vector<std::string> row{name, std::to_string(scenes.tree.geometry().primitive_count())};
    for (const auto backend : {renderer::Backend::batched, renderer::Backend::scalar}) {
      renderer::RenderOptions options;
      options.path.max_depth = description.integrator.max_depth;
      options.path.rr_depth = description.integrator.rr_depth;
      options.sampler = renderer::SamplerType::sobol;
      options.samples_per_pixel = 4;
      options.backend = backend;
      options.threads = 1;  // this one
      row.push_back(text_of(compare(repetitions, scenes, [&](const Scene& scene) {
        return seconds_of([&] { render(scene, options); });
      })));
    }
    table.rows.push_back(std::move(row));
  }
  publish(log, table);
}

}  // namespace

void measure_accelerators(reports::ResultLog& log, bool full) {
  const int repetitions = full ? 31 : 9;
  measure_renders(log, repetitions);
  measure_rays(log, repetitions);
}

}  // namespace plumbline::bench
