#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <pugixml.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/errors.h>

/// Text files and the elements in them: what they hold, and how all that is wrong with them is
/// refused where it stands.
namespace plumbline::renderer {

inline constexpr std::ptrdiff_t kNowhere = -1;

/// What is wrong with a text file, at a place in it.
struct Refusal : std::runtime_error {
  Refusal(std::ptrdiff_t at, const std::string& why, pugi::xml_node its_document = {})
      : std::runtime_error(why), offset(at), document(its_document) {}

  /// "file:line: why", for the user.
  InputError in(const std::filesystem::path& file, std::string_view text) const;

  std::ptrdiff_t offset;    ///< in the text [bytes]; or kNowhere in particular
  pugi::xml_node document;  ///< that the text was parsed to, if it was
};

/// @throws Refusal at the offset
template <class... Args>
[[noreturn]] void refuse(std::ptrdiff_t at, fmt::format_string<Args...> why, Args&&... args) {
  throw Refusal(at, fmt::format(why, std::forward<Args>(args)...));
}

/// @return line that holds the offset, counted from 1
std::size_t line_at(std::string_view text, std::ptrdiff_t offset);

/// The whole of a regular text file. Pipes and devices are refused: they may never end.
///
/// @throws InputError "file: why" where it is missing, not a regular file, not readable, empty,
///         larger than `max_bytes`, or holds a zero byte
std::string read_text_file(const std::filesystem::path& file, std::uintmax_t max_bytes);

using Node = pugi::xml_node;

/// The text in quotes for a message: cut where it is long, control characters shown as '?'.
std::string in_quotes(std::string_view text);

/// The element's name between < and >, cut where it is long.
std::string tag_of(Node node);

/// As a person would look for it: `<float name="radius">`, `<shape type="sphere">`, `<film>`.
std::string label(Node node);

/// @throws Refusal at the element
template <class... Args>
[[noreturn]] void refuse(Node at, fmt::format_string<Args...> why, Args&&... args) {
  throw Refusal(at.offset_debug(), fmt::format(why, std::forward<Args>(args)...), at.root());
}

/// Refuses an element by its label: `<float name="radius">: must be positive`.
template <class... Args>
[[noreturn]] void fail(Node at, fmt::format_string<Args...> why, Args&&... args) {
  refuse(at, "{}: {}", label(at), fmt::format(why, std::forward<Args>(args)...));
}

/// Refuses an element for a name in it, with a hint which of the known ones may be meant.
[[noreturn]] void refuse_name(Node at, const std::string& message, std::string_view name,
                              const std::vector<std::string>& known);

/// What to write in place of something that Mitsuba has and we do not; empty where nothing is
/// known.
std::string advice_for(std::string_view name);

/// Refuses an element for what Mitsuba may have, with advice or a hint.
[[noreturn]] void refuse_unsupported(Node at, const std::string& message, std::string_view name,
                                     const std::vector<std::string>& known);

/// Value of an attribute that must be there.
std::string attribute(Node node, const char* name);

/// Refuses every attribute that is not named here.
void allow_attributes(Node node, const std::vector<std::string>& allowed);

/// Refuses every child too.
void allow_only_attributes(Node node, const std::vector<std::string>& allowed);

template <class T>
bool contains(const std::vector<std::string>& items, const T& item) {
  return std::find(items.begin(), items.end(), item) != items.end();
}

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
  refuse_unsupported(at, message, name, names_of(things));
}

}  // namespace plumbline::renderer
