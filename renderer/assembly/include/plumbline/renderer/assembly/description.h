#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <plumbline/renderer/core/bsdf/bsdf_table.h>
#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/scene/camera.h>
#include <plumbline/renderer/core/scene/scene.h>

/// What a scene file says, in double and in world space: the parser's output and the input of
/// `make_scene`.
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
};

/// A light without surface, alike in all directions.
struct PointDescription {
  Vec3d position;
  Rgbd intensity;  ///< [W/sr]
};

/// A disk of light infinitely far away, on top of the constant environment.
struct SunDescription {
  Vec3d direction;        ///< unit, towards its centre
  double half_angle = 0;  ///< [rad], in (0, π/2]
  Rgbd radiance;          ///< [W/(m² sr)]
};

struct FilmSize {
  int width = 0, height = 0;  ///< [pixels]
};

/// `depth` counts as in Mitsuba 3: 1 is directly visible emission, 2 adds direct light, −1 is
/// unlimited.
struct IntegratorDescription {
  int max_depth = -1;
  int rr_depth = 5;  ///< Russian roulette from this depth on (Mitsuba's default)
};

struct SceneDescription {
  std::filesystem::path file;
  std::map<std::string, std::string> parameters;  ///< every <default> with the value in force
  CameraDescription camera;
  IntegratorDescription integrator;
  int samples_per_pixel = 16;
  std::vector<ShapeDescription> shapes;
  std::shared_ptr<const BsdfTable> bsdfs;  ///< what `ShapeDescription::bsdf` counts in
  std::optional<Rgbd> environment;         ///< constant environment radiance [W/(m² sr)]
  std::optional<SunDescription> sun;
  std::optional<EnvironmentMap> environment_map;  ///< excludes the two above
  std::vector<PointDescription> points;
  LightSelection light_selection = LightSelection::uniform;
};

/// All geometry is moved in double so that the centre of its bounding box is the origin, and only
/// then rounded to float: a scene at 1e5 keeps the digits that it would otherwise lose.
///
/// @throws InputError where Embree refuses the geometry, std::invalid_argument without BSDFs
Scene make_scene(const SceneDescription& description);

}  // namespace plumbline::renderer
