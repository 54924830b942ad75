#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/core/scene/description.h>

#include "properties.h"
#include "scene_file.h"

/// The parts of a scene file, each read by one function from its element.
namespace plumbline::renderer {

/// <sensor>: camera, film size and samples per pixel go into the scene.
///
/// @param size  film size in place of the file's
void read_sensor(const Element& element, std::optional<FilmSize> size, SceneDescription& scene);

/// @return why a film of that size is refused; empty if it is not
std::string film_size_error(const FilmSize& size);

/// <integrator>
IntegratorDescription read_integrator(const Element& element);

/// The <emitter> of a shape whose geometry has been read.
void read_area_emitter(const Element& element, ShapeDescription& shape);

/// An <emitter> of the scene: constant, envmap, point or sun.
void read_scene_emitter(const Element& element, SceneDescription& scene);

/// Geometry of a shape of any type. Everything but geometry must have been taken from
/// `properties`.
decltype(ShapeDescription::geometry) read_geometry(const std::string& type, Properties& properties);

/// An obj file's triangles, moved to world space.
///
/// @param shape  the element to blame where the file cannot be read
MeshShape read_mesh(const Properties& shape, const std::filesystem::path& file,
                    const Affine& to_world);

/// The scene's BSDFs and who refers to them by id. Nested ones come before those that hold them.
class BsdfReader {
 public:
  /// Reads a <bsdf> and those in it, and registers their ids.
  /// @return its index
  std::uint32_t read(const Element& element);

  /// What shapes without a BSDF get: diffuse, reflectance 0.5.
  std::uint32_t fallback();

  /// @param ref    a <ref>; in a shape it may stand before what it refers to, so this waits until
  ///               all is read
  /// @param id     its id
  /// @param where  for the message: where it was looked for
  /// @throws InputError if there is no BSDF with that id
  std::uint32_t resolve(const Element& ref, const std::string& id, const char* where = "") const;

  /// All that were read; once.
  std::shared_ptr<const BsdfSet> take() { return make_bsdfs(std::move(bsdfs_)); }

 private:
  /// What those that nest a BSDF need to know of it.
  struct Known {
    BsdfParts parts;
    int depth = 0;          ///< levels of BSDFs below it
    double ext_ior = 1;     ///< index outside
    double int_ior = 1e30;  ///< index inside, of a dielectric
  };

  Bsdf read_type(const std::string& type, Properties& properties, Known& known);
  std::vector<std::uint32_t> read_nested(Properties& properties, std::size_t least,
                                         std::size_t most, Known& known);
  Bsdf read_two_sided(Properties& properties, Known& known);
  Bsdf read_mixture(Properties& properties, Known& known);
  Bsdf read_thin_film(Properties& properties);
  std::uint32_t add(Bsdf bsdf, Known known);

  std::vector<Bsdf> bsdfs_;
  std::vector<Known> known_;  ///< of each of `bsdfs_`
  std::map<std::string, std::uint32_t> by_id_;
  std::optional<std::uint32_t> fallback_;
};

/// Shapes as they come; their <ref>s are resolved at the end.
class ShapeReader {
 public:
  ShapeReader(std::vector<ShapeDescription>& shapes, BsdfReader& bsdfs)
      : shapes_(shapes), bsdfs_(bsdfs) {}

  void read(const Element& element);
  void resolve_references();

 private:
  struct Reference {
    std::size_t shape;
    Element element;
    std::string id;
  };

  std::vector<ShapeDescription>& shapes_;
  BsdfReader& bsdfs_;
  std::vector<Reference> references_;
};

/// Largest coordinate and length [m]; 1/kMaxLength is the smallest length. Squares of both are
/// normal numbers in single precision.
inline constexpr double kMaxLength = 1e18;

/// Whether single precision can work with a point.
bool is_in_range(const Vec3d& point);

}  // namespace plumbline::renderer
