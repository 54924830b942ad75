#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/renderer/core/math.h>

/// Shapes of scene files in world space, by the words of docs/scene_format.md and in double: what
/// the loader, the geometry and the lights are held against. Rays are moved into the shape's own
/// space, where it is the unit shape, and normals come back by the inverse transpose.
namespace plumbline::tests {

/// An invertible affine map: the columns of its matrix.
struct Placement {
  renderer::Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};

  renderer::Vec3d vector(const renderer::Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
  renderer::Vec3d point(const renderer::Vec3d& p) const { return origin + vector(p); }
  double determinant() const { return dot(cross(x, y), z); }

  /// By Cramer's rule.
  renderer::Vec3d inverse_vector(const renderer::Vec3d& v) const {
    return renderer::Vec3d{dot(cross(y, z), v), dot(cross(z, x), v), dot(cross(x, y), v)} /
           determinant();
  }

  /// The unit normal that `n` becomes, by the inverse transpose.
  renderer::Vec3d normal(const renderer::Vec3d& n) const {
    return normalize((cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z) / determinant());
  }

  /// "<transform …>" with 17 digits, which a double is read back from.
  std::string xml() const;
};

enum class Model { sphere, rectangle, disk, mesh };

/// One point of a shape on a ray.
struct Meeting {
  std::size_t part;        ///< triangle of a mesh; else 0
  double distance;         ///< [m]
  renderer::Vec3d normal;  ///< unit, of the front
};

/// A unit shape with a transform.
class PlacedShape {
 public:
  /// Centre and radius of the sphere before its transform, off their defaults.
  static constexpr renderer::Vec3d kCenter{0.25, -0.125, 0.5};
  static constexpr double kRadius = 0.75;
  /// Triangles of the mesh, and their corners: a bent quadrilateral.
  static constexpr std::array<renderer::Vec3d, 4> kCorners{
      {{-1, -1, 0}, {1, -1, 0.25}, {1, 1, -0.25}, {-1, 1, 0.5}}};
  static constexpr std::array<std::array<std::size_t, 3>, 2> kTriangles{{{0, 1, 2}, {0, 2, 3}}};
  /// The mesh as a file.
  static std::string obj();

  PlacedShape(Model model, const Placement& placement, bool flip_normals)
      : model_(model), placement_(placement), flip_normals_(flip_normals) {}

  Model model() const { return model_; }
  const Placement& placement() const { return placement_; }
  bool flip_normals() const { return flip_normals_; }

  std::size_t parts() const { return model_ == Model::mesh ? kTriangles.size() : 1; }

  /// Where the ray ref + t·wi, t > 0, meets the shape, the nearest first.
  ///
  /// @param edge  by how much the shape is larger than it is, in units of its own space: a point
  ///              that is met for ±edge alike is not near an edge or limb
  std::vector<Meeting> meetings(const renderer::Vec3d& ref, const renderer::Vec3d& wi,
                                double edge = 0) const;

  /// Surface of a part [m²].
  double area(std::size_t part) const;
  double area() const;

  /// Solid angle of a part from ref [sr], the front alike the back; of a sphere from outside.
  double solid_angle(std::size_t part, const renderer::Vec3d& ref) const;

  /// Of a sphere in world space.
  renderer::Vec3d center() const { return placement_.point(kCenter); }
  double radius() const { return kRadius * length(placement_.x); }

  /// The smallest extent of a part [m]: what errors of its corners turn its normal by.
  double size(std::size_t part) const;

 private:
  std::vector<renderer::Vec3d> outline(std::size_t part) const;

  Model model_;
  Placement placement_;
  bool flip_normals_;
};

}  // namespace plumbline::tests
