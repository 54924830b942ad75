#include "transform.h"

#include <cmath>
#include <string>
#include <vector>

namespace plumbline::renderer {
namespace {

Affine read_translate(Node at) {
  Affine result;
  result.origin = parse_vector(at, vector_text(at, "0"));
  return result;
}

Affine read_scale(Node at) {
  const Vec3d s = parse_vector(at, vector_text(at, "1"));
  return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}};
}

/// Right-handed rotation about an axis through the origin (Rodrigues).
Affine read_rotate(Node at) {
  const Vec3d axis =
      unit_vector(at, parse_vector(at, vector_text(at, "0")), "the axis has no direction");
  const double angle = parse_number<double>(at, attribute(at, "angle")) * pi<double>() / 180;
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](const Vec3d& v) {
    return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
  };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), {}};
}

/// 3×3 or 4×4, row by row.
Affine read_matrix(Node at) {
  const std::vector<double> m = parse_numbers(at, attribute(at, "value"));
  if (m.size() == 9) return {{m[0], m[3], m[6]}, {m[1], m[4], m[7]}, {m[2], m[5], m[8]}, {}};
  if (m.size() != 16) refuse(at, "<matrix> needs 9 or 16 numbers, not {}", m.size());
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
    refuse(at, "<matrix> must have the last row 0 0 0 1: projections are not supported");
  }
  return {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
}

/// To world from a camera at `origin` that looks along +z towards `target`, +x to its left.
Affine read_lookat(Node at) {
  const auto three = [&](const char* name) -> Vec3d {
    const std::vector<double> n = parse_numbers(at, attribute(at, name));
    if (n.size() != 3) fail(at, "\"{}\" needs three numbers, not {}", name, n.size());
    return {n[0], n[1], n[2]};
  };
  const Vec3d origin = three("origin");
  const Vec3d forward =
      unit_vector(at, three("target") - origin, "\"target\" and \"origin\" are the same point");
  const Vec3d left = cross(unit_vector(at, three("up"), "\"up\" has no direction"), forward);
  if (!(length(left) > kShapeTolerance)) fail(at, "\"up\" points along the line of sight");
  return {normalize(left), cross(forward, normalize(left)), forward, origin};
}

struct Operation {
  std::vector<std::string> attributes;
  Affine (*read)(Node at);
};

const Named<Operation> kOperations = {
    {"translate", {{"x", "y", "z", "value"}, read_translate}},
    {"rotate", {{"x", "y", "z", "value", "angle"}, read_rotate}},
    {"scale", {{"x", "y", "z", "value"}, read_scale}},
    {"matrix", {{"value"}, read_matrix}},
    {"lookat", {{"origin", "target", "up"}, read_lookat}},
};

}  // namespace

Affine parse_transform(Node at, std::string_view text, const Range& /*range*/) {
  if (!text.empty()) return {};  // the default
  Affine result;
  for (const Node node : at.children()) {
    const Operation& operation =
        look_up(kOperations, node.name(), node, tag_of(node) + " is not a transform operation");
    allow_only_attributes(node, operation.attributes);
    result = operation.read(node) * result;
  }
  const auto& [x, y, z] = result.origin;
  const double determinant = result.determinant();  // not finite if a column is not
  if (!std::isfinite(determinant) || !std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
    refuse(at, "{} overflows", label(at));
  }
  // Relative to the longest that the columns allow (Hadamard): free of the scene's scale.
  const double largest = length(result.x) * length(result.y) * length(result.z);
  if (!(std::abs(determinant) > 1e-12 * largest)) {
    refuse(at, "{} is singular: it flattens space", label(at));
  }
  return result;
}

bool perpendicular(const Vec3d& a, const Vec3d& b) {
  return std::abs(dot(a, b)) <= kShapeTolerance * length(a) * length(b);
}

bool same_length(const Vec3d& a, const Vec3d& b) {
  return std::abs(length(a) - length(b)) <= kShapeTolerance * length(a);
}

bool is_orthogonal(const Affine& m) {
  return perpendicular(m.x, m.y) && perpendicular(m.y, m.z) && perpendicular(m.z, m.x);
}

bool is_rigid(const Affine& m) {
  const Vec3d unit{1, 0, 0};
  return is_orthogonal(m) && same_length(unit, m.x) && same_length(unit, m.y) &&
         same_length(unit, m.z);
}

}  // namespace plumbline::renderer
