#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/renderer/core/bsdf/bsdf_table.h>
#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/scene/camera.h>
#include <plumbline/renderer/core/scene/scene.h>
#include <plumbline/renderer/placement/shapes.h>

/// What a scene file says, in double and in world space: the parser's output and the input of
/// `make_scene`.
namespace plumbline::renderer {

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

/// What finds where rays meet surfaces. They agree but for rounding (docs/conventions.md).
enum class Accelerator {
  automatic,   ///< brute_force where it can and is faster (kMostForBruteForce), else embree
  embree,      ///< Embree's tree
  brute_force  ///< sixteen rays at a time against all primitives
};

struct SceneDescription {
  std::filesystem::path file;
  std::vector<std::filesystem::path> files;       ///< all that were read: this, meshes, images
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
  Accelerator accelerator = Accelerator::automatic;
};

/// All geometry is moved in double so that the centre of its bounding box is the origin, and only
/// then rounded to float: a scene at 1e5 keeps the digits that it would otherwise lose. Where its
/// details would still be lost, the camera is the origin; where its lengths are far from a metre,
/// it is scaled by a power of two; and what single precision cannot hold even so is traced in
/// double (ExactShape).
///
/// @throws InputError naming the shapes that do not fit into one picture in single precision, or
///         where Embree refuses the geometry, or where brute force is asked for and something has
///         to be traced in double; std::invalid_argument without BSDFs
Scene make_scene(const SceneDescription& description);

/// What a scene was made with: never `automatic`.
Accelerator accelerator_of(const Scene& scene);

}  // namespace plumbline::renderer
