#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include <plumbline/renderer/core/bsdf/fresnel.h>
#include <plumbline/renderer/core/math.h>

#include "scene_file.h"
#include "transform.h"

/// What a scene file may say of an object, as rows: parsing, checks, messages and the tables of
/// docs/scene_format.md all come from them.
namespace plumbline::renderer {

/// What a property is. The alternative of Value with the same number holds one.
enum class Kind {
  number,
  integer,
  boolean,
  string,
  rgb,
  point,
  vector,
  transform,
  index,   ///< of refraction: a <float>, or a <string> that names a material
  metal,   ///< a <string> that names one
  file,    ///< a <string>: a path from the scene file's folder
  nested,  ///< objects whose tag is the row's name; where a <bsdf> may stand, a <ref> to one may
};

using Value = std::variant<double, int, bool, std::string, Rgbd, Vec3d, Vec3d, Affine, double,
                           ConductorFresnel, std::filesystem::path, std::vector<Element>>;

template <Kind K>
using ValueOf = std::variant_alternative_t<static_cast<std::size_t>(K), Value>;

/// What a value must keep to, every channel of a colour and every coordinate. Of nested objects it
/// is their number, where there may be more than one.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  const char* more = "";                 ///< behind the bounds in a message: the unit, the reason
  bool open = false;                     ///< the bounds themselves are out
  std::array<const char*, 5> choices{};  ///< of a string; nullptr behind the last
};

constexpr Range between(double low, double high, const char* more = "") {
  return {.low = low, .high = high, .more = more};
}
constexpr Range at_least(double low, const char* more = "") { return {.low = low, .more = more}; }
inline constexpr Range kPositive{.low = 0, .open = true};
template <class... Names>
constexpr Range one_of(Names... names) {
  return {.choices = {names...}};
}

inline constexpr const char* kRequired = nullptr;

struct PropertyRow {
  const char* name;
  Kind kind;
  const char* absent;  ///< the default as a file would write it; or kRequired
  Range range;

  /// Tags of the elements that give it.
  std::vector<std::string> tags() const;

  /// The range for a person: "0 to 1"; empty if there is none.
  std::string range_text() const;
};

/// A row that knows the type of its value.
template <Kind K>
struct Property : PropertyRow {
  constexpr Property(const char* its_name, const char* its_default, Range its_range = {})
      : PropertyRow{its_name, K, its_default, its_range} {}
};

/// The value of a property, of any kind but nested.
///
/// @throws InputError at the element, for what is not of that kind or out of range
Value parse_property(const PropertyRow& row, const Element& element);

/// The value of a property that `object` does not give and need not.
Value absent_property(const PropertyRow& row, const Element& object);

}  // namespace plumbline::renderer
