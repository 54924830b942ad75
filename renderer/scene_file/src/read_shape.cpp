#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "read_parts.h"
#include "text_file.h"

namespace plumbline::renderer {
namespace {

using Geometry = decltype(ShapeDescription::geometry);

void check_point(const Properties& properties, const std::string& name, const Vec3d& point) {
  if (!is_in_range(point)) {
    properties.fail(name, fmt::format("puts a coordinate beyond {:g}", kMaxLength));
  }
}

void check_length(const Properties& properties, const std::string& name, double length) {
  if (!(length >= 1 / kMaxLength && length <= kMaxLength)) {
    properties.fail(name, fmt::format("makes a length of {:g}: lengths go from {:g} to {:g}",
                                      length, 1 / kMaxLength, kMaxLength));
  }
}

/// Normals map by the inverse transpose: a mirroring keeps which side of space the front faces,
/// while edge × edge changes sign.
bool mirrors(const Affine& to_world) { return to_world.determinant() < 0; }

Geometry read_sphere(Properties& properties) {
  const Vec3d center = properties.point("center", {0, 0, 0});
  const double radius = properties.number("radius", 1);
  const bool flip = properties.boolean("flip_normals", false);
  const Affine m = properties.transform("to_world");
  properties.finish();
  if (!(radius > 0)) properties.fail("radius", "must be positive");
  if (!perpendicular(m.x, m.y) || !perpendicular(m.y, m.z) || !perpendicular(m.z, m.x) ||
      !same_length(m.x, m.y) || !same_length(m.x, m.z)) {
    properties.fail("to_world", "would make an ellipsoid: scale a sphere alike along all axes");
  }
  const SphereShape sphere{m.point(center), radius * length(m.x), flip};
  check_point(properties, "center", sphere.center);
  check_length(properties, "radius", sphere.radius);
  return sphere;
}

/// [-1, 1]² in the plane z = 0, facing +z.
Geometry read_rectangle(Properties& properties) {
  const bool flip = properties.boolean("flip_normals", false);
  const Affine m = properties.transform("to_world");
  properties.finish();
  if (!perpendicular(m.x, m.y)) {
    properties.fail("to_world", "shears the rectangle: its edges must stay perpendicular");
  }
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) check_point(properties, "to_world", m.point({s, t, 0}));
  }
  check_length(properties, "to_world", 2 * length(m.x));
  check_length(properties, "to_world", 2 * length(m.y));
  return RectangleShape{m.point({-1, -1, 0}), m.x * 2.0, m.y * 2.0, flip != mirrors(m)};
}

/// Unit disk in the plane z = 0, facing +z.
Geometry read_disk(Properties& properties) {
  const bool flip = properties.boolean("flip_normals", false);
  const Affine m = properties.transform("to_world");
  properties.finish();
  if (!perpendicular(m.x, m.y) || !same_length(m.x, m.y)) {
    properties.fail("to_world", "would make an ellipse: scale a disk alike along x and y");
  }
  check_point(properties, "to_world", m.origin);
  check_length(properties, "to_world", length(m.x));
  const Vec3d normal = normalize(cross(normalize(m.x), normalize(m.y)));
  return DiskShape{m.origin, flip != mirrors(m) ? -normal : normal, length(m.x)};
}

Geometry read_obj(Properties& properties, const SceneFile& file) {
  const std::string name = properties.string("filename");
  const bool flip = properties.boolean("flip_normals", false);
  const bool face_normals = properties.boolean("face_normals", false);
  const Affine to_world = properties.transform("to_world");
  properties.finish();
  if (name.empty()) properties.fail("filename", "names no file");
  if (!face_normals) {
    properties.fail("face_normals",
                    "smooth normals are not supported: an obj needs "
                    "<boolean name=\"face_normals\" value=\"true\"/>");
  }
  MeshShape mesh = read_mesh(properties, file.path().parent_path() / name, to_world);
  mesh.flip_normals = flip;
  return mesh;
}

}  // namespace

bool is_in_range(const Vec3d& point) {
  return std::abs(point.x) <= kMaxLength && std::abs(point.y) <= kMaxLength &&
         std::abs(point.z) <= kMaxLength;
}

void ShapeReader::read(const Element& element) {
  element.allow_attributes({"type", "id", "name"});
  const std::string type = element.type();
  element.file().register_id(element);
  Properties properties(element);
  const std::optional<Element> bsdf = properties.object("bsdf");
  const std::optional<Element> reference = properties.object("ref");
  const std::optional<Element> emitter = properties.object("emitter");
  if (bsdf && reference) reference->fail("a shape has one BSDF: a <bsdf> or a <ref>, not both");

  ShapeDescription shape;
  if (type == "sphere") shape.geometry = read_sphere(properties);
  if (type == "rectangle") shape.geometry = read_rectangle(properties);
  if (type == "disk") shape.geometry = read_disk(properties);
  if (type == "obj") shape.geometry = read_obj(properties, element.file());
  if (emitter) read_area_emitter(*emitter, shape);
  if (bsdf) {
    shape.bsdf = bsdfs_.read(*bsdf);
  } else if (reference) {
    references_.push_back({shapes_.size(), *reference, reference->text("id")});
  } else {
    shape.bsdf = bsdfs_.fallback();
  }
  shapes_.push_back(std::move(shape));
}

void ShapeReader::resolve_references() {
  for (const Reference& reference : references_) {
    shapes_[reference.shape].bsdf = bsdfs_.resolve(reference.element, reference.id);
  }
}

}  // namespace plumbline::renderer
