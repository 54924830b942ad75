#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/assembly/description.h>

#include "object.h"
#include "scene_file.h"

/// The parts of a scene file: the types of each element, and who keeps what was read.
namespace plumbline::renderer {

/// A BSDF and what those that nest it need to know of it.
struct ReadBsdf {
  Bsdf bsdf;
  double ext_ior = 1;     ///< index outside
  double int_ior = 1e30;  ///< index inside, of a dielectric
  BsdfParts parts = {};
  int depth = 0;  ///< levels of BSDFs below it
};

class BsdfReader;
using Geometry = decltype(ShapeDescription::geometry);

// What a scene file may hold, by element: every type with its properties and its reader.
extern const ObjectTypes<IntegratorDescription> kIntegratorTypes;
extern const ObjectTypes<void, std::optional<FilmSize>, SceneDescription&> kSensorTypes;
extern const ObjectTypes<FilmSize> kFilmTypes;
extern const ObjectTypes<void> kFilterTypes;
extern const ObjectTypes<int> kSamplerTypes;
extern const ObjectTypes<ReadBsdf, BsdfReader&> kBsdfTypes;
extern const ObjectTypes<Geometry> kShapeTypes;
extern const ObjectTypes<void, ShapeDescription&> kAreaEmitterTypes;
extern const ObjectTypes<void, SceneDescription&> kSceneEmitterTypes;

inline constexpr Property<Kind::file> kFilename{"filename", kRequired};
inline constexpr Property<Kind::transform> kToWorld{"to_world", "identity"};

/// @return why a film of that size is refused; empty if it is not
std::string film_size_error(const FilmSize& size);

/// A <shape> with what it holds.
///
/// @return its <ref> to a BSDF, which may stand before it: to be resolved when all is read
std::optional<Element> read_shape(const Element& element, BsdfReader& bsdfs,
                                  ShapeDescription& shape);

/// The triangles of an obj file, moved to world space. What is wrong with it is the error of the
/// shape's kFilename.
MeshShape read_mesh(const Object& shape);

/// The scene's BSDFs and who refers to them by id. Nested ones come before those that hold them.
class BsdfReader {
 public:
  /// Reads a <bsdf> and those in it, and registers their ids.
  /// @return its index
  std::uint32_t read(const Element& element);

  /// What shapes without a BSDF get: diffuse, reflectance 0.5.
  std::uint32_t fallback();

  /// @param where  for the message: where the BSDF of a <ref> was looked for
  /// @throws InputError if there is no BSDF with its id
  std::uint32_t resolve(const Element& ref, const char* where = "") const;

  /// Reads <bsdf>s, and finds those that <ref>s name above them.
  /// @return their indices
  std::vector<std::uint32_t> read_nested(const std::vector<Element>& elements);

  const ReadBsdf& operator[](std::uint32_t index) const { return bsdfs_[index]; }

  /// All that were read; once.
  std::shared_ptr<const BsdfSet> take();

 private:
  std::uint32_t add(ReadBsdf read);

  std::vector<ReadBsdf> bsdfs_;
  std::map<std::string, std::uint32_t> by_id_;
  std::optional<std::uint32_t> fallback_;
};

/// Largest coordinate and length [m]; 1/kMaxLength is the smallest length. Squares of both are
/// normal numbers in single precision.
inline constexpr double kMaxLength = 1e18;

/// Whether single precision can work with a point.
bool is_in_range(const Vec3d& point);

}  // namespace plumbline::renderer
