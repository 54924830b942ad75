#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "parameters.h"

namespace plumbline::renderer {

class SceneFile;

/// An element of a scene file that knows where it stands: its attributes with parameters put in,
/// and the way in which everything about it is refused.
class Element {
 public:
  Element(SceneFile& file, pugi::xml_node node) : file_(&file), node_(node) {}

  std::string tag() const { return node_.name(); }
  bool has(const char* attribute) const { return !node_.attribute(attribute).empty(); }

  /// Value of an attribute that must be there, with parameters put in.
  std::string text(const char* attribute) const;

  /// Which of these its `type` is. Registers its id: this is what reading an object begins with.
  std::size_t type(const std::vector<std::string>& supported) const;

  /// Refuses every attribute that is not named here.
  void allow_attributes(const std::vector<std::string>& allowed) const;

  std::vector<Element> children() const;

  /// Refuses children of any kind.
  void allow_no_children() const;

  /// As a person would look for it: `<float name="radius">`, `<shape type="sphere">`, `<film>`.
  std::string label() const;

  /// In the file [bytes].
  std::size_t offset() const { return static_cast<std::size_t>(node_.offset_debug()); }

  /// @throws InputError "file:line: message"
  [[noreturn]] void fail(const std::string& message) const;

  SceneFile& file() const { return *file_; }

 private:
  SceneFile* file_;
  pugi::xml_node node_;
};

/// A well-formed XML file of bounded size and depth, without anything that reaches outside it
/// (document types, entities, processing instructions).
class SceneFile {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
  static constexpr int kMaxDepth = 32;
  static constexpr int kMaxAttributes = 32;

  /// @throws InputError "file:line: what and why"
  SceneFile(const std::filesystem::path& path, const std::map<std::string, std::string>& overrides);

  Element root();
  const std::filesystem::path& path() const { return path_; }
  Parameters& parameters() { return parameters_; }

  /// Remembers the element's id, if it has one. Ids are unique in a file.
  void register_id(const Element& element);

  /// The tag of the element with that id; empty if there is none.
  std::string tag_of_id(const std::string& id) const;

  /// @throws InputError "file:line: message"
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;

 private:
  void parse();
  void check_structure();
  void check_node(pugi::xml_node node, int depth) const;

  std::filesystem::path path_;
  std::string text_;  // as read: pugixml works on a copy of its own, lines are counted here
  pugi::xml_document document_;
  Parameters parameters_;
  struct Place {
    std::string tag;
    std::size_t offset;
  };
  std::map<std::string, Place> ids_;
};

}  // namespace plumbline::renderer
