#include "transform.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "named.h"
#include "values.h"

namespace plumbline::renderer {
namespace {

bool is_finite(const Vec3d& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Unit vector; a zero vector is the element's error.
Vec3d direction(const Element& element, const Vec3d& v, const char* what) {
  const double norm = length(v);
  if (!(norm > 0 && std::isfinite(norm))) {
    element.fail(fmt::format("{}: {}", element.label(), what));
  }
  return v / norm;
}

Affine read_translate(const Element& element) {
  element.allow_attributes({"x", "y", "z", "value"});
  Affine result;
  result.origin = parse_xyz(element, 0);
  return result;
}

Affine read_scale(const Element& element) {
  element.allow_attributes({"x", "y", "z", "value"});
  const Vec3d s = parse_xyz(element, 1);
  return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}};
}

/// Right-handed rotation about an axis through the origin (Rodrigues).
Affine read_rotate(const Element& element) {
  element.allow_attributes({"x", "y", "z", "value", "angle"});
  const Vec3d axis = direction(element, parse_xyz(element, 0), "the axis has no direction");
  const double angle = parse_number(element, element.text("angle")) * pi<double>() / 180;
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](const Vec3d& v) {
    return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
  };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), {}};
}

/// 3×3 or 4×4, row by row.
Affine read_matrix(const Element& element) {
  element.allow_attributes({"value"});
  const std::vector<double> m = parse_numbers(element, element.text("value"));
  if (m.size() == 9) return {{m[0], m[3], m[6]}, {m[1], m[4], m[7]}, {m[2], m[5], m[8]}, {}};
  if (m.size() != 16) {
    element.fail(fmt::format("<matrix> needs 9 or 16 numbers, not {}", m.size()));
  }
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
    element.fail("<matrix> must have the last row 0 0 0 1: projections are not supported");
  }
  return {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
}

/// To world from a camera at `origin` that looks along +z towards `target`, +x to its left.
Affine read_lookat(const Element& element) {
  element.allow_attributes({"origin", "target", "up"});
  const Vec3d origin = parse_triple(element, "origin");
  const Vec3d forward = direction(element, parse_triple(element, "target") - origin,
                                  "\"target\" and \"origin\" are the same point");
  const Vec3d up = direction(element, parse_triple(element, "up"), "\"up\" has no direction");
  const Vec3d left = cross(up, forward);
  if (!(length(left) > kShapeTolerance)) {
    element.fail("<lookat>: \"up\" points along the line of sight");
  }
  return {normalize(left), cross(forward, normalize(left)), forward, origin};
}

Affine read_operation(const Element& element) {
  static const Named<Affine (*)(const Element&)> operations = {{"translate", read_translate},
                                                               {"rotate", read_rotate},
                                                               {"scale", read_scale},
                                                               {"matrix", read_matrix},
                                                               {"lookat", read_lookat}};
  element.allow_no_children();
  const std::string tag = element.tag();
  if (const auto* read = operations.find(tag)) return (*read)(element);
  element.fail(fmt::format("<{}> is not a transform operation; {}", tag.substr(0, 60),
                           operations.hint(tag)));
}

}  // namespace

Affine read_transform(const Element& element) {
  Affine result;
  for (const Element& operation : element.children()) {
    result = read_operation(operation) * result;
  }
  const double determinant = result.determinant();
  if (!is_finite(result.x) || !is_finite(result.y) || !is_finite(result.z) ||
      !is_finite(result.origin) || !std::isfinite(determinant)) {
    element.fail(fmt::format("{} overflows", element.label()));
  }
  // Relative to the longest that the columns allow (Hadamard): free of the scene's scale.
  const double largest = length(result.x) * length(result.y) * length(result.z);
  if (!(std::abs(determinant) > 1e-12 * largest)) {
    element.fail(fmt::format("{} is singular: it flattens space", element.label()));
  }
  return result;
}

bool perpendicular(const Vec3d& a, const Vec3d& b) {
  return std::abs(dot(a, b)) <= kShapeTolerance * length(a) * length(b);
}

bool same_length(const Vec3d& a, const Vec3d& b) {
  return std::abs(length(a) - length(b)) <= kShapeTolerance * length(a);
}

bool is_rigid(const Affine& m) {
  return perpendicular(m.x, m.y) && perpendicular(m.y, m.z) && perpendicular(m.z, m.x) &&
         same_length({1, 0, 0}, m.x) && same_length({1, 0, 0}, m.y) && same_length({1, 0, 0}, m.z);
}

}  // namespace plumbline::renderer
