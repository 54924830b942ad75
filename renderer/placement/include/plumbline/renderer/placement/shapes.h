#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <plumbline/renderer/core/math.h>

/// Shapes and point lights as a scene file describes them, in double and in world space.
namespace plumbline::renderer {

/// Normals point outwards, or inwards with `flip_normals`. The front is where the normal points.
struct SphereShape {
  Vec3d center;
  double radius = 1;  ///< [m], > 0 and finite
  bool flip_normals = false;
};

/// Parallelogram origin + s·edge_u + t·edge_v, (s, t) in [0,1]²; front side along edge_u × edge_v,
/// or against it with `flip_normals`.
struct RectangleShape {
  Vec3d origin, edge_u, edge_v;  ///< edges perpendicular (the loader refuses shear)
  bool flip_normals = false;
};

/// Flat disk; front side along `normal` (flips are already applied).
struct DiskShape {
  Vec3d center;
  Vec3d normal;       ///< unit
  double radius = 1;  ///< [m]
};

/// Triangles with geometric normals: front side along (v1 − v0) × (v2 − v0), or against it with
/// `flip_normals`.
struct MeshShape {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`, in range
  bool flip_normals = false;
};

struct ShapeDescription {
  std::variant<SphereShape, RectangleShape, DiskShape, MeshShape> geometry;
  std::uint32_t bsdf = 0;             ///< index into SceneDescription::bsdfs
  std::optional<Rgbd> radiance;       ///< emission from the front side [W/(m² sr)]
  bool light_by_solid_angle = false;  ///< how a rectangle's or mesh's emission is sampled
  bool light_two_sided = false;       ///< a rectangle's other side emits alike
  std::size_t line = 0;               ///< in the file, from 1; 0: it stands in none
  std::string label = {};             ///< as messages name it: <shape type="sphere">
  std::filesystem::path file = {};    ///< that it stands in, if the scene's includes it
};

/// A light without surface, alike in all directions.
struct PointDescription {
  Vec3d position;
  Rgbd intensity;                   ///< [W/sr]
  std::size_t line = 0;             ///< in the file, from 1; 0: it stands in none
  std::filesystem::path file = {};  ///< that it stands in, if the scene's includes it
};

}  // namespace plumbline::renderer
