#pragma once

#include <any>
#include <functional>
#include <map>

#include "values.h"

/// Objects of a scene file (`<shape>`, `<film>`, …), read by the row of their type: parsing,
/// checks, messages and the tables of docs/scene_format.md all come from the rows.
namespace plumbline::renderer {

/// What a property is, which elements give one, and what their text means. A default has the object
/// for its element.
template <class T>
struct Kind {
  std::vector<std::string> tags;
  T (*parse)(Node at, std::string_view text, const Range& range);
};

inline const Kind<double> kFloat{{"float"}, parse_number<double>};
inline const Kind<int> kInteger{{"integer"}, parse_number<int>};
inline const Kind<bool> kBoolean{{"boolean"}, parse_boolean};
inline const Kind<std::string> kString{{"string"}, parse_string};
inline const Kind<Rgbd> kRgb{{"rgb", "spectrum"}, parse_rgb};
inline const Kind<Vec3d> kPoint{{"point"}, parse_vector};
inline const Kind<Vec3d> kVector{{"vector"}, parse_vector};
inline const Kind<Affine> kTransform{{"transform"}, parse_transform};

inline constexpr const char* kRequired = nullptr;
/// In place of the default of what is taken only where it changes nothing: it has no value.
inline constexpr char kWithoutEffect[] = "without effect";  // an array: it is known by its address

struct PropertyRow {
  std::string name;
  std::vector<std::string> tags;  ///< of the elements that give it
  const char* absent;             ///< the default as a file would write it; or kRequired
  Range range;                    ///< of nested objects: how many there may be
  std::function<std::any(Node at, std::string_view text, const Range& range)> parse;  ///< or nested
};

/// A row that knows the type of its value.
template <class T>
struct Property : PropertyRow {
  Property(const Kind<T>& kind, const char* its_name, const char* its_default, Range its_range = {})
      : PropertyRow{its_name, kind.tags, its_default, std::move(its_range), kind.parse} {}
};

/// Objects with one of these tags.
struct Nested : PropertyRow {
  Nested(const std::vector<std::string>& its_tags, const char* its_default, Range number)
      : PropertyRow{its_tags.front(), its_tags, its_default, std::move(number), {}} {}
};

struct Reading;
class Object;

/// A type of object.
struct ObjectType {
  std::vector<PropertyRow> properties;
  void (*read)(const Object& object, Reading& in);  ///< puts what it makes of one into the scene
};

/// The values of an object: of every property of its type, given or not.
class Object {
 public:
  /// One of a type that is not known: nothing of it can be asked for.
  explicit Object(Node node) : node_(node) {}

  /// @throws Refusal at the first child that is wrong or that the type has no row for, else for the
  ///         first property that is missing: a misspelt name is the likelier cause of that. Where
  ///         all problems are to be found, it is not good instead, and may lack values
  Object(Node node, const ObjectType& type, Reading& in);

  Node node() const { return node_; }
  bool is_known() const { return !given_.empty(); }
  bool is_good() const { return good_; }

  template <class T>
  const T& operator[](const Property<T>& property) const {
    return std::any_cast<const T&>(values_.at(property.name));
  }

  const std::vector<Node>& operator[](const Nested& objects) const {
    return given_.at(objects.name);
  }

  /// Whether the file gives it.
  bool has(const PropertyRow& property) const { return !given_.at(property.name).empty(); }

  /// Where an error of a property is: at the object if the file does not give it.
  Node at(const PropertyRow& property) const {
    return has(property) ? given_.at(property.name).front() : node_;
  }

  /// Refuses a property that is not good.
  template <class... Args>
  void require(bool good, const PropertyRow& property, fmt::format_string<Args...> why,
               Args&&... args) const {
    if (!good) fail(at(property), why, std::forward<Args>(args)...);
  }

 private:
  friend Object read_object(Node node, const Named<ObjectType>& types, Reading& in);
  void add(Node child, const PropertyRow& row);
  void complete(const PropertyRow& row);
  [[noreturn]] void refuse_child(Node child, const ObjectType& type) const;

  Node node_;
  bool good_ = false;
  std::map<std::string, std::vector<Node>> given_;  ///< elements of each property
  std::map<std::string, std::any> values_;
};

/// Reads an object by the row of its type.
///
/// @return  its values; not good, while all problems are to be found, where nothing came of it
/// @throws Refusal for a type that is none of these
Object read_object(Node node, const Named<ObjectType>& types, Reading& in);

/// Reads the default of nested objects: one of that type without a property.
void read_default(const Nested& objects, const Named<ObjectType>& types, Reading& in);

}  // namespace plumbline::renderer
