#include <cmath>
#include <limits>

#include <plumbline/renderer/placement/placement.h>

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
};

Extent extent_of(const SceneDescription& scene) {
  Extent extent;
  const CameraDescription& camera = scene.camera;
  for (const ShapeDescription& shape : scene.shapes) {
    for_each_surface(shape, [&](const ExactShape& surface) {
      if (surface.is_flat()) {
        const auto [low, high] = surface.box();
        return extent.add_box(camera, low, high);
      }
      const Vec3d offset = surface.origin() - camera.origin;
      extent.add(std::abs(length(offset) - surface.radius()),
                 dot(offset, camera.forward) + surface.radius());
    });
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
