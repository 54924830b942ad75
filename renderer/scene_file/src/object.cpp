#include "object.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

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

bool gives(const Element& child, const PropertyRow& row) {
  return row.kind == Kind::nested ? contains(row.tags(), child.tag())
                                  : is_property(child) && child.text("name") == row.name;
}

std::string with_hint(const std::string& message, const std::string& name,
                      const std::vector<std::string>& known) {
  const std::string hint = name_hint(name, known);
  return hint.empty() ? message : fmt::format("{}; {}", message, hint);
}

}  // namespace

Object::Object(const Element& element, const ObjectRow& type) : element_(element) {
  const std::vector<Element> children = element.children();
  for (const PropertyRow& row : type.properties) {
    std::vector<Element> given;
    std::copy_if(children.begin(), children.end(), std::back_inserter(given),
                 [&](const Element& child) { return gives(child, row); });
    row.kind == Kind::nested ? read_nested(row, given) : read(row, given);
  }
  for (const Element& child : children) {
    if (std::none_of(type.properties.begin(), type.properties.end(),
                     [&](const PropertyRow& row) { return gives(child, row); })) {
      refuse(child, type);
    }
  }
  if (!missing_.empty()) element.fail(element.label() + missing_);
}

void Object::read(const PropertyRow& row, const std::vector<Element>& given) {
  const std::string tags = fmt::format("{}", fmt::join(row.tags(), "> or <"));
  if (given.empty() && row.absent == kRequired) {
    if (missing_.empty()) missing_ = fmt::format(" needs <{} name=\"{}\">", tags, row.name);
  } else if (given.empty()) {
    values_.emplace(row.name, absent_property(row, element_));
  } else {
    const Element& property = given.front();
    if (given.size() > 1) {
      given[1].fail(fmt::format("{} has a second property \"{}\"", element_.label(), row.name));
    }
    if (!contains(row.tags(), property.tag())) {
      property.fail(
          fmt::format("{} of {} must be a <{}>", property.label(), element_.label(), tags));
    }
    given_.emplace(row.name, property);
    values_.emplace(row.name, parse_property(row, property));
  }
}

void Object::read_nested(const PropertyRow& row, const std::vector<Element>& given) {
  const std::string tags = fmt::format("<{}>", fmt::join(row.tags(), "> or <"));
  const auto count = static_cast<double>(given.size());
  const Range& range = row.range;
  std::string wrong;
  if (range.high < Range{}.high) {
    const bool either = range.low < range.high;
    if (count < range.low || count > range.high) {
      wrong = fmt::format(": nests {}{:g} BSDFs: {}",
                          either ? fmt::format("{:g} or ", range.low) : "", range.high, tags);
    }
  } else if (count > 1) {
    given[1].fail(fmt::format("{} may hold one {} only", element_.label(), tags));
  } else if (count == 0 && row.absent == kRequired) {
    wrong = fmt::format(" needs {}", tags);
  }
  if (missing_.empty()) missing_ = wrong;
  values_.emplace(row.name, given);
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
