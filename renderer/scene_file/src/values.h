#pragma once

#include <charconv>
#include <limits>
#include <system_error>

#include <plumbline/renderer/core/math.h>

#include "source.h"

/// What the text of an element means, taken whole: anything left over is an error of the element's.
namespace plumbline::renderer {

/// What a value must keep to: every channel of a colour and every coordinate.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  const char* more = "";                  ///< behind the bounds in a message: unit, reason
  bool open = false;                      ///< the bounds themselves are out
  std::vector<std::string> choices = {};  ///< of a string

  /// Refuses the element for a number beyond the bounds.
  void check(Node at, double number) const;

  /// For a person: "0 to 1"; empty where everything is taken.
  std::string text() const;
};

inline Range between(double low, double high, const char* more = "") { return {low, high, more}; }
inline Range at_least(double low, const char* more = "") { return {.low = low, .more = more}; }
inline Range one_of(std::vector<std::string> names) { return {.choices = std::move(names)}; }
inline const Range kPositive = {.low = 0, .open = true};

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

/// Whether two vectors are perpendicular, or equally long: up to the rounding of matrices that are
/// written with six digits.
bool perpendicular(const Vec3d& a, const Vec3d& b);
bool same_length(const Vec3d& a, const Vec3d& b);

/// Whether a map keeps the axes perpendicular: no shear.
bool is_orthogonal(const Affine& m);

/// Whether a map only turns, mirrors and moves: no scale, no shear.
bool is_rigid(const Affine& m);

/// The direction of a vector; one without is refused with `why`.
Vec3d unit_vector(Node at, const Vec3d& v, const char* why);

/// The whole of a text as a number.
///
/// @return what is wrong with it; errc() if nothing
template <class T>
std::errc parse_whole(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end != text.data() + text.size()) return std::errc::invalid_argument;
  return error;
}

/// What a property says: its `value`, or what its element has in place of that.
std::string text_of(Node property);

/// A finite decimal number that a double holds, or a whole one that an int holds.
template <class T>
T parse_number(Node at, std::string_view text, const Range& range = {});

bool parse_boolean(Node at, std::string_view text, const Range& range);

/// The text itself.
std::string parse_string(Node at, std::string_view text, const Range& range);

/// One number for all coordinates or channels, or three.
Vec3d parse_vector(Node at, std::string_view text, const Range& range = {});
Rgbd parse_rgb(Node at, std::string_view text, const Range& range);

/// The operations of a <transform>, the first in the file applied first.
/// The identity where the text, a default, says so.
///
/// @throws Refusal for an unknown operation, and for a result that is singular or not finite
Affine parse_transform(Node at, std::string_view text, const Range& range);

}  // namespace plumbline::renderer
