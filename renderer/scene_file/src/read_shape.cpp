#include <fmt/format.h>

#include <cmath>

#include "read_parts.h"

namespace plumbline::renderer {
namespace {

constexpr Property<Kind::nested> kBsdf{"bsdf", "diffuse"};
constexpr Property<Kind::nested> kEmitter{"emitter", "none"};
constexpr Property<Kind::point> kCenter{"center", "0"};
constexpr Property<Kind::number> kRadius{"radius", "1", kPositive};
constexpr Property<Kind::boolean> kFaceNormals{"face_normals", "false"};
constexpr Property<Kind::boolean> kFlipNormals{"flip_normals", "false"};

/// The properties of a shape: its own among those that all have.
std::vector<PropertyRow> with_common(const std::vector<PropertyRow>& own) {
  std::vector<PropertyRow> rows = {kBsdf, kEmitter};
  rows.insert(rows.end(), own.begin(), own.end());
  rows.insert(rows.end(), {kFlipNormals, kToWorld});
  return rows;
}

void check_point(const Object& object, const PropertyRow& property, const Vec3d& point) {
  if (!is_in_range(point)) {
    object.fail(property, fmt::format("puts a coordinate beyond {:g}", kMaxLength));
  }
}

void check_length(const Object& object, const PropertyRow& property, double length) {
  if (!(length >= 1 / kMaxLength && length <= kMaxLength)) {
    object.fail(property, fmt::format("makes a length of {:g}: lengths go from {:g} to {:g}",
                                      length, 1 / kMaxLength, kMaxLength));
  }
}

/// Normals map by the inverse transpose: a mirroring keeps which side of space the front faces,
/// while edge × edge changes sign.
bool mirrors(const Affine& to_world) { return to_world.determinant() < 0; }

Geometry read_sphere(const Object& object) {
  const Affine& m = object[kToWorld];
  if (!perpendicular(m.x, m.y) || !perpendicular(m.y, m.z) || !perpendicular(m.z, m.x) ||
      !same_length(m.x, m.y) || !same_length(m.x, m.z)) {
    object.fail(kToWorld, "would make an ellipsoid: scale a sphere alike along all axes");
  }
  const SphereShape sphere{m.point(object[kCenter]), object[kRadius] * length(m.x),
                           object[kFlipNormals]};
  check_point(object, kCenter, sphere.center);
  check_length(object, kRadius, sphere.radius);
  return sphere;
}

/// [-1, 1]² in the plane z = 0, facing +z.
Geometry read_rectangle(const Object& object) {
  const Affine& m = object[kToWorld];
  if (!perpendicular(m.x, m.y)) {
    object.fail(kToWorld, "shears the rectangle: its edges must stay perpendicular");
  }
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) check_point(object, kToWorld, m.point({s, t, 0}));
  }
  check_length(object, kToWorld, 2 * length(m.x));
  check_length(object, kToWorld, 2 * length(m.y));
  return RectangleShape{m.point({-1, -1, 0}), m.x * 2.0, m.y * 2.0,
                        object[kFlipNormals] != mirrors(m)};
}

/// Unit disk in the plane z = 0, facing +z.
Geometry read_disk(const Object& object) {
  const Affine& m = object[kToWorld];
  if (!perpendicular(m.x, m.y) || !same_length(m.x, m.y)) {
    object.fail(kToWorld, "would make an ellipse: scale a disk alike along x and y");
  }
  check_point(object, kToWorld, m.origin);
  check_length(object, kToWorld, length(m.x));
  const Vec3d normal = normalize(cross(normalize(m.x), normalize(m.y)));
  return DiskShape{m.origin, object[kFlipNormals] != mirrors(m) ? -normal : normal, length(m.x)};
}

Geometry read_obj(const Object& object) {
  if (!object[kFaceNormals]) {
    object.fail(kFaceNormals,
                "smooth normals are not supported: an obj needs "
                "<boolean name=\"face_normals\" value=\"true\"/>");
  }
  MeshShape mesh = read_mesh(object);
  mesh.flip_normals = object[kFlipNormals];
  return mesh;
}

}  // namespace

const ObjectTypes<Geometry> kShapeTypes = {
    {"sphere", with_common({kCenter, kRadius}), read_sphere},
    {"rectangle", with_common({}), read_rectangle},
    {"disk", with_common({}), read_disk},
    {"obj", with_common({kFilename, kFaceNormals}), read_obj},
};

bool is_in_range(const Vec3d& point) {
  return std::abs(point.x) <= kMaxLength && std::abs(point.y) <= kMaxLength &&
         std::abs(point.z) <= kMaxLength;
}

std::optional<Element> read_shape(const Element& element, BsdfReader& bsdfs,
                                  ShapeDescription& shape) {
  const auto& type = kShapeTypes.of(element);
  const Object object(element, type);
  shape.geometry = type.read(object);
  for (const Element& emitter : object[kEmitter]) kAreaEmitterTypes.read(emitter, shape);
  const std::vector<Element>& given = object[kBsdf];
  if (!given.empty() && given.front().tag() == "ref") {
    given.front().text("id");  // a parameter in it has to stand above it, like everywhere
    return given.front();
  }
  shape.bsdf = given.empty() ? bsdfs.fallback() : bsdfs.read(given.front());
  return std::nullopt;
}

}  // namespace plumbline::renderer
