#include "object.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include <plumbline/renderer/scene_file/nearest_name.h>

#include "text_file.h"

namespace plumbline::renderer {
namespace {

/// Those of Mitsuba's that we do not take count as properties too, for the message.
constexpr std::array<std::string_view, 10> kPropertyTags = {
    "boolean",  "float",  "integer", "point",     "rgb",
    "spectrum", "string", "texture", "transform", "vector"};

template <class Range, class T>
bool contains(const Range& range, const T& value) {
  return std::find(range.begin(), range.end(), value) != range.end();
}

bool is_property(const Element& element) { return contains(kPropertyTags, element.tag()); }

std::string with_hint(const std::string& message, const std::string& name,
                      const std::vector<std::string>& known) {
  const std::string hint = name_hint(name, known);
  return hint.empty() ? message : fmt::format("{}; {}", message, hint);
}

}  // namespace

Object::Object(const Element& element, const ObjectRow& type) : element_(element) {
  for (const Element& child : element.children()) {
    if (!is_property(child)) {
      nested_.push_back(child);
      continue;
    }
    const std::string name = child.text("name");
    if (!given_.emplace(name, child).second) {
      child.fail(fmt::format("{} has a second property {}", element.label(), in_quotes(name)));
    }
  }
  for (const PropertyRow& row : type.properties) {
    row.kind == Kind::nested ? read_nested(row) : read(row);
  }
  for (const Element& child : element.children()) {
    const bool known =
        std::any_of(type.properties.begin(), type.properties.end(), [&](const PropertyRow& row) {
          return row.kind == Kind::nested ? contains(row.tags(), child.tag())
                                          : is_property(child) && child.text("name") == row.name;
        });
    if (!known) refuse(child, type);
  }
  if (!missing_.empty()) element.fail(element.label() + missing_);
}

void Object::read(const PropertyRow& row) {
  const auto found = given_.find(row.name);
  const std::vector<std::string> tags = row.tags();
  if (found == given_.end()) {
    if (row.absent != kRequired) {
      values_.emplace(row.name, absent_property(row, element_));
    } else if (missing_.empty()) {
      missing_ = fmt::format(" needs <{} name=\"{}\">", tags.front(), row.name);
    }
    return;
  }
  const Element& property = found->second;
  if (!contains(tags, property.tag())) {
    property.fail(fmt::format("{} of {} must be a <{}>", property.label(), element_.label(),
                              fmt::join(tags, "> or <")));
  }
  values_.emplace(row.name, parse_property(row, property));
}

void Object::read_nested(const PropertyRow& row) {
  const std::vector<std::string> tags = row.tags();
  const std::string what = fmt::format("<{}>", fmt::join(tags, "> or <"));
  std::vector<Element> found;
  for (const Element& object : nested_) {
    if (contains(tags, object.tag())) found.push_back(object);
  }
  const auto count = static_cast<double>(found.size());
  const Range& range = row.range;
  if (range.high < Range{}.high) {
    if (missing_.empty() && !(count >= range.low && count <= range.high)) {
      missing_ =
          fmt::format(": nests {} BSDFs: {}",
                      range.low == range.high ? fmt::format("{:g}", range.high)
                                              : fmt::format("{:g} or {:g}", range.low, range.high),
                      what);
    }
  } else if (count > 1) {
    found[1].fail(fmt::format("{} may hold one {} only", element_.label(), what));
  } else if (count == 0 && row.absent == kRequired && missing_.empty()) {
    missing_ = fmt::format(" needs {}", what);
  }
  values_.emplace(row.name, std::move(found));
}

void Object::refuse(const Element& child, const ObjectRow& type) const {
  std::vector<std::string> names, tags;
  for (const PropertyRow& row : type.properties) {
    if (row.kind != Kind::nested) names.emplace_back(row.name);
    for (const std::string& tag : row.tags()) {
      if (!contains(tags, tag)) tags.push_back(tag);
    }
  }
  const std::string tag = child.tag();
  if (is_property(child) && !names.empty()) {
    const std::string name = child.text("name");
    child.fail(with_hint(fmt::format("{} has no property {}", element_.label(), in_quotes(name)),
                         name, names));
  }
  child.fail(with_hint(fmt::format("{} may not hold <{}>", element_.label(), tag.substr(0, 60)),
                       tag, tags));
}

void Object::fail(const std::string& message) const {
  element_.fail(fmt::format("{}: {}", element_.label(), message));
}

void Object::fail(const PropertyRow& property, const std::string& message) const {
  const auto found = given_.find(property.name);
  const Element& at = found == given_.end() ? element_ : found->second;
  at.fail(fmt::format("{}: {}", at.label(), message));
}

}  // namespace plumbline::renderer
