#include "surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace plumbline::renderer {

std::vector<Vec3d> corners_of(const ExactShape& surface) {
  const Vec3d &o = surface.origin(), &u = surface.u(), &v = surface.v();
  switch (surface.outline()) {
    case ExactShape::Outline::sphere:
      return {};
    case ExactShape::Outline::triangle:
      return {o, o + u, o + v};
    case ExactShape::Outline::parallelogram:
      return {o, o + u, o + u + v, o + v};
    case ExactShape::Outline::disk:
      break;
  }
  constexpr int kCorners = 64;
  std::vector<Vec3d> corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * pi<double>() * i / kCorners;
    corners.push_back(o + u * std::cos(angle) + v * std::sin(angle));
  }
  return corners;
}

double size_of(const ExactShape& surface) {
  if (!surface.is_flat()) return surface.radius();
  const double shorter = std::min(length(surface.u()), length(surface.v()));
  return surface.outline() == ExactShape::Outline::disk ? shorter : shorter / 2;
}

double reach_of(const ExactShape& surface) {
  if (!surface.is_flat()) return surface.radius();
  const double longer = std::max(length(surface.u()), length(surface.v()));
  return surface.outline() == ExactShape::Outline::disk ? longer : longer / 2;
}

double at_least_from(const ExactShape& surface, const Vec3d& p) {
  const Vec3d from_origin = p - surface.origin();
  if (!surface.is_flat()) return std::abs(length(from_origin) - surface.radius());
  const auto [low, high] = surface.box();
  const Vec3d beside{std::max({low.x - p.x, p.x - high.x, 0.0}),
                     std::max({low.y - p.y, p.y - high.y, 0.0}),
                     std::max({low.z - p.z, p.z - high.z, 0.0})};
  return std::max(length(beside), std::abs(dot(surface.normal(), from_origin)));
}

void for_each_surface(const ShapeDescription& shape,
                      const std::function<void(const ExactShape&)>& function) {
  if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry)) {
    function(surface_of(*sphere));
  } else if (const auto* r = std::get_if<RectangleShape>(&shape.geometry)) {
    function(surface_of(*r));
  } else if (const auto* disk = std::get_if<DiskShape>(&shape.geometry)) {
    function(surface_of(*disk));
  } else {
    const auto& mesh = std::get<MeshShape>(shape.geometry);
    for (const auto& triangle : mesh.triangles) function(surface_of(mesh, triangle));
  }
}

ExactShape surface_of(const SphereShape& sphere) { return {sphere.center, sphere.radius}; }

ExactShape surface_of(const RectangleShape& r) {
  return {ExactShape::Outline::parallelogram, r.origin, r.edge_u, r.edge_v};
}

ExactShape surface_of(const MeshShape& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3d& corner = mesh.vertices[triangle[0]];
  return {ExactShape::Outline::triangle, corner, mesh.vertices[triangle[1]] - corner,
          mesh.vertices[triangle[2]] - corner};
}

ExactShape surface_of(const DiskShape& disk) {
  const Frame<double> frame(disk.normal);
  return {ExactShape::Outline::disk, disk.center, frame.to_world({disk.radius, 0, 0}),
          frame.to_world({0, disk.radius, 0})};
}

std::string of_file(const std::filesystem::path& included) {
  return included.empty() ? "" : " of " + included.string();
}

std::string name_of(const PlacedParts& scene, std::size_t shape) {
  const ShapeDescription& s = scene.shapes[shape];
  if (s.line == 0) return fmt::format("shape {}", shape + 1);
  return fmt::format("{} on line {}", s.label, s.line) + of_file(s.file);
}

std::string place_in_file(const PlacedParts& scene, std::size_t shape) {
  const ShapeDescription& s = scene.shapes[shape];
  if (s.line == 0) return name_of(scene, shape);
  return fmt::format("{}:{}: {}", (s.file.empty() ? scene.file : s.file).string(), s.line, s.label);
}

}  // namespace plumbline::renderer
