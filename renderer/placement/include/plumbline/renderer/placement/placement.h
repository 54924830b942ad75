#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <vector>

#include <plumbline/renderer/core/scene/camera.h>
#include <plumbline/renderer/core/scene/exact_shape.h>
#include <plumbline/renderer/placement/shapes.h>

namespace plumbline::renderer {

/// What there is of a scene that has a place.
struct PlacedParts {
  const std::vector<ShapeDescription>& shapes;
  const std::vector<PointDescription>& points;
  const CameraDescription& camera;
  const std::filesystem::path& file;  ///< for messages
};

/// Where the scene lies in the renderer's space, x ↦ (x − center)·scale, and what of it single
/// precision cannot hold there.
struct Placement {
  Vec3d center;
  double scale = 1;  ///< a power of two
  /// Surfaces, by number, each with the one whose place it shares: the first there, or itself.
  std::map<std::size_t, std::size_t> exact;
};

// Shapes as surfaces; of a mesh, its triangles.
ExactShape surface_of(const SphereShape& sphere);
ExactShape surface_of(const RectangleShape& rectangle);
ExactShape surface_of(const DiskShape& disk);
ExactShape surface_of(const MeshShape& mesh, const std::array<std::uint32_t, 3>& triangle);

/// Calls with each surface of a shape: itself, or each triangle of a mesh.
void for_each_surface(const ShapeDescription& shape,
                      const std::function<void(const ExactShape&)>& function);

/// Surfaces are numbered through in the order of the scene.
///
/// @param middle  of the scene, its centre if the picture is right with it
/// @throws InputError naming two shapes that single precision cannot hold in one picture, or two in
///         one place of which the hidden one emits
Placement place(const PlacedParts& scene, const Vec3d& middle);

}  // namespace plumbline::renderer
