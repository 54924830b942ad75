#include <algorithm>
#include <cmath>

#include "parts.h"

namespace plumbline::renderer {
namespace {

const Nested kBsdf{{"bsdf", "ref"}, "diffuse", between(0, 1)};
const Nested kEmitter{{"emitter"}, "none", between(0, 1)};
const Property kCenter{kPoint, "center", "0"};
const Property kRadius{kFloat, "radius", "1", kPositive};
const Property kFaceNormals{kBoolean, "face_normals", "false"};
const Property kFlipNormals{kBoolean, "flip_normals", "false"};

void check_point(const Object& object, const PropertyRow& property, const Vec3d& point) {
  object.require(is_in_range(point), property, "puts a coordinate beyond {:g}", kMaxLength);
}

void check_length(const Object& object, const PropertyRow& property, double length) {
  constexpr double kMinLength = 1 / kMaxLength;
  object.require(length >= kMinLength && length <= kMaxLength, property,
                 "makes a length of {:g}: lengths go from {:g} to {:g}", length, kMinLength,
                 kMaxLength);
}

/// Double precision has to tell the shape's own points apart from where it stands.
void check_digits(const Object& object, const PropertyRow& property, const Vec3d& center,
                  double size) {
  object.require(length(center) <= kMaxDistance * size, property,
                 "is {:.2g} times its own size away from the origin: double precision keeps its "
                 "shape up to {:g} times",
                 length(center) / size, kMaxDistance);
}

/// Normals map by the inverse transpose: a mirroring keeps which side of space the front faces,
/// while edge × edge changes sign.
bool mirrors(const Affine& to_world) { return to_world.determinant() < 0; }

void read_sphere(const Object& object, Reading& in) {
  const Affine& m = object[kToWorld];
  object.require(is_orthogonal(m) && same_length(m.x, m.y) && same_length(m.x, m.z), kToWorld,
                 "would make an ellipsoid: scale a sphere alike along all axes");
  const SphereShape sphere{m.point(object[kCenter]), object[kRadius] * length(m.x),
                           object[kFlipNormals]};
  check_point(object, kCenter, sphere.center);
  check_length(object, kRadius, sphere.radius);
  check_digits(object, kCenter, sphere.center, sphere.radius);
  in.scene.shapes.back().geometry = sphere;
}

/// [-1, 1]² in the plane z = 0, facing +z.
void read_rectangle(const Object& object, Reading& in) {
  const Affine& m = object[kToWorld];
  object.require(perpendicular(m.x, m.y), kToWorld,
                 "shears the rectangle: its edges must stay perpendicular");
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) check_point(object, kToWorld, m.point({s, t, 0}));
  }
  check_length(object, kToWorld, 2 * length(m.x));
  check_length(object, kToWorld, 2 * length(m.y));
  check_digits(object, kToWorld, m.origin, std::min(length(m.x), length(m.y)));
  in.scene.shapes.back().geometry = RectangleShape{m.point({-1, -1, 0}), m.x * 2.0, m.y * 2.0,
                                                   object[kFlipNormals] != mirrors(m)};
}

/// Unit disk in the plane z = 0, facing +z.
void read_disk(const Object& object, Reading& in) {
  const Affine& m = object[kToWorld];
  object.require(perpendicular(m.x, m.y) && same_length(m.x, m.y), kToWorld,
                 "would make an ellipse: scale a disk alike along x and y");
  check_point(object, kToWorld, m.origin);
  check_length(object, kToWorld, length(m.x));
  check_digits(object, kToWorld, m.origin, length(m.x));
  const Vec3d normal = normalize(cross(normalize(m.x), normalize(m.y)));
  in.scene.shapes.back().geometry =
      DiskShape{m.origin, object[kFlipNormals] != mirrors(m) ? -normal : normal, length(m.x)};
}

void read_obj(const Object& object, Reading& in) {
  object.require(object[kFaceNormals], kFaceNormals,
                 "false, the default, asks for smooth normals, which are not supported: write "
                 "<boolean name=\"face_normals\" value=\"true\"/> for flat triangles");
  MeshShape mesh = read_mesh(object, in);
  Vec3d low = mesh.vertices.front(), high = low;
  for (const Vec3d& v : mesh.vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  check_digits(object, kFilename, (low + high) * 0.5, length(high - low) / 2);
  mesh.flip_normals = object[kFlipNormals];
  in.scene.shapes.back().geometry = std::move(mesh);
}

}  // namespace

const Named<ObjectType> kShapeTypes = {
    {"sphere", {{kBsdf, kEmitter, kCenter, kRadius, kFlipNormals, kToWorld}, read_sphere}},
    {"rectangle", {{kBsdf, kEmitter, kFlipNormals, kToWorld}, read_rectangle}},
    {"disk", {{kBsdf, kEmitter, kFlipNormals, kToWorld}, read_disk}},
    {"obj", {{kBsdf, kEmitter, kFilename, kFaceNormals, kFlipNormals, kToWorld}, read_obj}},
};

bool is_in_range(const Vec3d& point) {
  return std::abs(point.x) <= kMaxLength && std::abs(point.y) <= kMaxLength &&
         std::abs(point.z) <= kMaxLength;
}

void read_shape(Node node, Reading& in) {
  in.scene.shapes.emplace_back();
  const Object object = read_object(node, kShapeTypes, in);
  if (!object.is_known()) return;
  for (const Node emitter : object[kEmitter]) read_object(emitter, kAreaEmitterTypes, in);
  ShapeDescription& shape = in.scene.shapes.back();
  in.place(node, shape);
  shape.label = label(node);
  if (!object.has(kBsdf)) {
    if (!in.default_bsdf) {
      in.default_bsdf = static_cast<std::uint32_t>(in.bsdfs->size());
      read_default(kBsdf, kBsdfTypes, in);
    }
    shape.bsdf = *in.default_bsdf;
  } else if (const Node given = object[kBsdf].front(); given.name() == std::string_view("ref")) {
    in.references.emplace_back(in.scene.shapes.size() - 1, given);
  } else {
    shape.bsdf = read_bsdf(given, in);
  }
}

}  // namespace plumbline::renderer
