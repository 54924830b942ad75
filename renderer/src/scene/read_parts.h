#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/renderer/scene/description.h>

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

/// The radiance of an <emitter> of the one type that its place allows ("area" or "constant").
Rgbd read_emitter(const Element& element, const std::string& type);

/// Geometry of a shape of any type. Everything but geometry must have been taken from
/// `properties`.
decltype(ShapeDescription::geometry) read_geometry(const std::string& type, Properties& properties);

/// An obj file's triangles, moved to world space.
///
/// @param shape  the element to blame where the file cannot be read
MeshShape read_mesh(const Properties& shape, const std::filesystem::path& file,
                    const Affine& to_world);

/// The scene's BSDFs and who refers to them by id.
class BsdfTable {
 public:
  explicit BsdfTable(std::vector<Bsdf>& bsdfs) : bsdfs_(bsdfs) {}

  /// Reads a <bsdf> and registers its id.
  /// @return its index
  std::uint32_t read(const Element& element);

  /// What shapes without a BSDF get: diffuse, reflectance 0.5.
  std::uint32_t fallback();

  /// @param ref  a <ref>; it may stand before what it refers to, so this waits until all is read
  /// @param id   its id
  /// @throws InputError if there is no BSDF with that id
  std::uint32_t resolve(const Element& ref, const std::string& id) const;

 private:
  std::vector<Bsdf>& bsdfs_;
  std::map<std::string, std::uint32_t> by_id_;
  std::optional<std::uint32_t> fallback_;
};

/// Shapes as they come; their <ref>s are resolved at the end.
class ShapeReader {
 public:
  ShapeReader(std::vector<ShapeDescription>& shapes, BsdfTable& bsdfs)
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
  BsdfTable& bsdfs_;
  std::vector<Reference> references_;
};

/// Largest coordinate and length [m]; 1/kMaxLength is the smallest length. Squares of both are
/// normal numbers in single precision.
inline constexpr double kMaxLength = 1e18;

/// Whether single precision can work with a point.
bool is_in_range(const Vec3d& point);

}  // namespace plumbline::renderer
