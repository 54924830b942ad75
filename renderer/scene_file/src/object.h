#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "property.h"
#include "scene_file.h"

/// Objects of a scene file (`<shape>`, `<film>`, …), read by the row of their type.
namespace plumbline::renderer {

struct ObjectRow {
  std::string name;  ///< of the type
  std::vector<PropertyRow> properties;
};

/// The values of an object: of every property of its type, given or not.
class Object {
 public:
  /// @throws InputError at the first property that is wrong in itself, else at the first child that
  ///         the type has no row for, else for the first that is missing: a misspelt name is the
  ///         likelier cause of that
  Object(const Element& element, const ObjectRow& type);

  /// @param property  one of the type's rows
  template <Kind K>
  const ValueOf<K>& operator[](const Property<K>& property) const {
    return std::get<static_cast<std::size_t>(K)>(values_.at(property.name));
  }

  /// What a property is where it is not given, of this type or of another.
  template <Kind K>
  ValueOf<K> absent(const Property<K>& property) const {
    return std::get<static_cast<std::size_t>(K)>(absent_property(property, element_));
  }

  /// Whether the file gives it.
  bool has(const PropertyRow& property) const { return given_.count(property.name) > 0; }

  const Element& element() const { return element_; }

  /// Refuses the object, or the value of a property, which is the object's error where absent.
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail(const PropertyRow& property, const std::string& message) const;

 private:
  void read(const PropertyRow& row, const std::vector<Element>& given);
  void read_nested(const PropertyRow& row, const std::vector<Element>& given);
  [[noreturn]] void refuse(const Element& child, const ObjectRow& type) const;

  Element element_;
  std::map<std::string_view, Element> given_;  ///< properties
  std::map<std::string_view, Value> values_;
  std::string missing_;  ///< what to say if nothing else is wrong
};

/// A type with the function that makes something of an object of it. There is none without.
template <class Result, class... Context>
struct ObjectType : ObjectRow {
  using Read = Result(const Object&, Context...);

  ObjectType(std::string type, std::vector<PropertyRow> rows, Read& reader)
      : ObjectRow{std::move(type), std::move(rows)}, read(reader) {}

  Read& read;
};

/// The types that an element may have in one place of the file.
template <class Result, class... Context>
class ObjectTypes {
 public:
  using Type = ObjectType<Result, Context...>;

  ObjectTypes(std::initializer_list<Type> types) : types_(types) {
    for (const ObjectRow& row : rows()) names_.push_back(row.name);
  }

  std::vector<ObjectRow> rows() const { return {types_.begin(), types_.end()}; }

  /// @throws InputError for a type that is none of these
  const Type& of(const Element& element) const { return types_[element.type(names_)]; }

  Result read(const Element& element, Context... context) const {
    const Type& type = of(element);
    return type.read(Object(element, type), context...);
  }

 private:
  std::vector<Type> types_;
  std::vector<std::string> names_;
};

}  // namespace plumbline::renderer
