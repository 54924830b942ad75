#pragma once

#include <plumbline/renderer/core/math.h>

#include "node.h"

namespace plumbline::renderer {

/// Affine map p ↦ x·p.x + y·p.y + z·p.z + origin: the columns of its matrix.
struct Affine {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3d origin{0, 0, 0};

  Vec3d vector(const Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d point(const Vec3d& p) const { return origin + vector(p); }
  double determinant() const { return dot(cross(x, y), z); }

  /// `a` after `b`.
  friend Affine operator*(const Affine& a, const Affine& b) {
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.origin)};
  }
};

/// The operations of a <transform>, the first in the file applied first.
/// The identity where the text, a default, says so.
///
/// @throws Refusal for an unknown operation, and for a result that is singular or not finite
Affine parse_transform(Node at, std::string_view text, const Range& range);

/// What tells lengths and angles apart from rounded ones: matrices are written with six digits.
inline constexpr double kShapeTolerance = 1e-5;

/// Whether two vectors are perpendicular to kShapeTolerance.
bool perpendicular(const Vec3d& a, const Vec3d& b);

/// Whether two vectors are equally long to kShapeTolerance.
bool same_length(const Vec3d& a, const Vec3d& b);

/// Whether a map keeps the axes perpendicular: no shear.
bool is_orthogonal(const Affine& m);

/// Whether a map only turns, mirrors and moves: no scale, no shear.
bool is_rigid(const Affine& m);

}  // namespace plumbline::renderer
