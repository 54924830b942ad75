#include <cmath>
#include <limits>

#include "parts.h"

namespace plumbline::renderer {
namespace {

/// How near shapes come to a camera, and how deep they lie behind its plane [m].
struct Extent {
  double nearest = std::numeric_limits<double>::infinity();
  double deepest = -std::numeric_limits<double>::infinity();

  void add(double distance, double depth) {
    nearest = std::min(nearest, distance);
    deepest = std::max(deepest, depth);
  }

  /// A box around points: what is in it is no nearer and no deeper.
  void add_box(const CameraDescription& camera, const Vec3d& low, const Vec3d& high) {
    double squared = 0, depth = 0;
    for (const auto axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
      const double below = low.*axis - camera.origin.*axis;
      const double above = high.*axis - camera.origin.*axis;
      const double apart = std::max({below, 0.0, -above});
      squared += apart * apart;
      depth += std::max(below * camera.forward.*axis, above * camera.forward.*axis);
    }
    add(std::sqrt(squared), depth);
  }

  void add_points(const CameraDescription& camera, std::initializer_list<Vec3d> points) {
    Vec3d low = *points.begin(), high = low;
    for (const Vec3d& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    add_box(camera, low, high);
  }
};

Extent extent_of(const SceneDescription& scene) {
  Extent extent;
  const CameraDescription& camera = scene.camera;
  for (const ShapeDescription& shape : scene.shapes) {
    if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry)) {
      const Vec3d offset = sphere->center - camera.origin;
      extent.add(std::abs(length(offset) - sphere->radius),
                 dot(offset, camera.forward) + sphere->radius);
    } else if (const auto* r = std::get_if<RectangleShape>(&shape.geometry)) {
      extent.add_points(camera, {r->origin, r->origin + r->edge_u, r->origin + r->edge_v,
                                 r->origin + r->edge_u + r->edge_v});
    } else if (const auto* disk = std::get_if<DiskShape>(&shape.geometry)) {
      const auto reach = [&](double n) {
        return disk->radius * std::sqrt(std::max(1 - n * n, 0.0));
      };
      const Vec3d half{reach(disk->normal.x), reach(disk->normal.y), reach(disk->normal.z)};
      extent.add_box(camera, disk->center - half, disk->center + half);
    } else if (const auto* mesh = std::get_if<MeshShape>(&shape.geometry)) {
      for (const auto& [a, b, c] : mesh->triangles) {
        extent.add_points(camera, {mesh->vertices[a], mesh->vertices[b], mesh->vertices[c]});
      }
    }
  }
  return extent;
}

}  // namespace

void check_clipping(const Reading& in) {
  const auto& [near, far] = in.clips;
  if (!near && !far) return;
  const CameraDescription& camera = in.scene.camera;
  const Extent extent = extent_of(in.scene);
  // The far end of what the near plane cuts off is a corner of the image.
  const double x = camera.tan_half_fov_x, y = x * camera.height / camera.width;
  const double corner = std::sqrt(1 + x * x + y * y);
  if (near && near->second * corner > extent.nearest) {
    fail(near->first, "may cut off shapes, and nothing is clipped here: write at most {:.4g}",
         extent.nearest / corner * (1 - 1e-3));
  }
  if (far && far->second < extent.deepest) {
    fail(far->first, "cuts off shapes, and nothing is clipped here: write at least {:.4g}",
         extent.deepest * (1 + 1e-3));
  }
}

}  // namespace plumbline::renderer
