#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <limits>
#include <pugixml.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/math.h>

/// Elements of a scene file: how everything about them is refused, and their attributes as text and
/// as numbers, taken whole: anything left over is an error of the element's.
namespace plumbline::renderer {

using Node = pugi::xml_node;

/// What is wrong with a scene file, for load_scene to put "file:line:" before it.
struct Refusal : std::runtime_error {
  Refusal(std::ptrdiff_t at, const std::string& why) : std::runtime_error(why), offset(at) {}

  std::ptrdiff_t offset;  ///< in the file [bytes]; negative: nowhere in particular
};

/// @throws Refusal at the element
template <class... Args>
[[noreturn]] void refuse(Node at, fmt::format_string<Args...> why, Args&&... args) {
  throw Refusal(at.offset_debug(), fmt::format(why, std::forward<Args>(args)...));
}

/// As a person would look for it: `<float name="radius">`, `<shape type="sphere">`, `<film>`.
std::string label(Node node);

/// Refuses an element by its label: `<float name="radius">: must be positive`.
template <class... Args>
[[noreturn]] void fail(Node at, fmt::format_string<Args...> why, Args&&... args) {
  refuse(at, "{}: {}", label(at), fmt::format(why, std::forward<Args>(args)...));
}

/// Refuses an element for a name in it, with a hint which of the known ones may be meant.
[[noreturn]] void refuse_name(Node at, const std::string& message, std::string_view name,
                              const std::vector<std::string>& known);

/// The text in quotes for a message: cut where it is long, control characters shown as '?'.
std::string in_quotes(std::string_view text);

/// The element's name between < and >, cut where it is long.
std::string tag_of(Node node);

/// Value of an attribute that must be there.
std::string attribute(Node node, const char* name);

/// Refuses every attribute that is not named here.
void allow_attributes(Node node, const std::vector<std::string>& allowed);

/// Refuses every child too.
void allow_only_attributes(Node node, const std::vector<std::string>& allowed);

/// Things by name, in the order in which a message lists them.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

/// Names of a Named or a map.
template <class Pairs>
std::vector<std::string> names_of(const Pairs& pairs) {
  std::vector<std::string> names;
  for (const auto& [name, unused] : pairs) names.push_back(name);
  return names;
}

/// The thing of that name; where there is none, the element is refused with the message.
template <class T>
const T& look_up(const Named<T>& things, std::string_view name, Node at,
                 const std::string& message) {
  for (const auto& [known, thing] : things) {
    if (known == name) return thing;
  }
  refuse_name(at, message, name, names_of(things));
}

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

/// The whole of a text as a number.
///
/// @return what is wrong with it; errc() if nothing
template <class T>
std::errc parse_whole(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end != text.data() + text.size()) return std::errc::invalid_argument;
  return error;
}

/// A finite decimal number that a double holds, or a whole one that an int holds.
template <class T>
T parse_number(Node at, std::string_view text, const Range& range = {});

bool parse_boolean(Node at, std::string_view text, const Range& range);

/// The text itself.
std::string parse_string(Node at, std::string_view text, const Range& range);

/// Numbers separated by spaces, or by commas with or without spaces.
std::vector<double> parse_numbers(Node at, std::string_view text, const Range& range = {});

/// One number for all coordinates, or three.
Vec3d parse_vector(Node at, std::string_view text, const Range& range = {});

/// One number for all channels, or three.
Rgbd parse_rgb(Node at, std::string_view text, const Range& range);

/// An element's `value`, or any of its `x`, `y`, `z` as the text of a vector.
///
/// @param absent  what a coordinate is that is not given
std::string vector_text(Node at, const char* absent);

/// The direction of a vector; one without is refused with `why`.
Vec3d unit_vector(Node at, const Vec3d& v, const char* why);

}  // namespace plumbline::renderer
