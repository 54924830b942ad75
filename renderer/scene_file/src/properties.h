#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/renderer/core/math.h>

#include "scene_file.h"
#include "transform.h"

namespace plumbline::renderer {

/// The children of an object (`<shape>`, `<film>`, …): typed properties by name, and nested
/// objects. What nobody asked for is refused by finish(), so that a misspelt name is never ignored.
///
/// A required property that is missing is reported by finish() too, after the misspelt ones, which
/// are the likelier cause; until then its value is a default-constructed one.
class Properties {
 public:
  explicit Properties(const Element& object);

  double number(const std::string& name);
  double number(const std::string& name, double absent);
  int integer(const std::string& name, int absent);
  bool boolean(const std::string& name, bool absent);
  std::string string(const std::string& name);
  std::string string(const std::string& name, const std::string& absent);
  Rgbd rgb(const std::string& name);
  Rgbd rgb(const std::string& name, const Rgbd& absent);
  Vec3d point(const std::string& name, const Vec3d& absent);
  Vec3d vector(const std::string& name);
  Affine transform(const std::string& name);  ///< identity where absent

  /// Tag of the property with that name: "float"; empty if there is none.
  std::string tag_of(const std::string& name) const;

  /// Nested objects with that tag, in document order.
  std::vector<Element> objects(const std::string& tag);

  /// The nested object with that tag, of which there may be one only.
  std::optional<Element> object(const std::string& tag);

  /// Like object(), but finish() refuses its absence.
  std::optional<Element> required_object(const std::string& tag);

  /// @throws InputError at the first child that nobody asked for, else for the first that is
  /// missing
  void finish() const;

  /// Refuses the value of a property, or the object if it has no such property.
  [[noreturn]] void fail(const std::string& name, const std::string& message) const;

 private:
  struct Child {
    Element element;
    std::string name;  ///< empty for nested objects
    bool used = false;
  };

  const Element* find(const std::string& tag, const std::string& name);
  const Element* require(const std::string& tag, const std::string& name);
  void refuse(const Child& child) const;

  Element object_;
  std::vector<Child> children_;
  std::map<std::string, std::size_t> by_name_;
  std::vector<std::string> known_names_, known_tags_;  ///< those asked for
  std::string missing_;                                ///< the first required child not found
};

}  // namespace plumbline::renderer
