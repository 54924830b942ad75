#include "properties.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include <plumbline/renderer/scene_file/nearest_name.h>

#include "text_file.h"
#include "values.h"

namespace plumbline::renderer {
namespace {

constexpr std::array<std::string_view, 10> kPropertyTags = {
    "boolean",  "float",  "integer", "point",     "rgb",
    "spectrum", "string", "texture", "transform", "vector"};

bool is_property(const Element& element) {
  return std::find(kPropertyTags.begin(), kPropertyTags.end(), element.tag()) !=
         kPropertyTags.end();
}

void add_unique(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

/// The `value` of a simple property, and nothing else in it.
std::string simple_value(const Element& element) {
  element.allow_attributes({"name", "value"});
  element.allow_no_children();
  return element.text("value");
}

}  // namespace

Properties::Properties(const Element& object) : object_(object) {
  for (const Element& element : object.children()) {
    Child child{element, {}};
    if (is_property(element)) {
      child.name = element.text("name");
      if (!by_name_.emplace(child.name, children_.size()).second) {
        element.fail(
            fmt::format("{} has a second property {}", object_.label(), in_quotes(child.name)));
      }
    }
    children_.push_back(child);
  }
}

const Element* Properties::find(const std::string& tag, const std::string& name) {
  add_unique(known_names_, name);
  add_unique(known_tags_, tag);
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return nullptr;
  Child& child = children_[found->second];
  if (child.element.tag() != tag) {
    child.element.fail(
        fmt::format("{} of {} must be a <{}>", child.element.label(), object_.label(), tag));
  }
  child.used = true;
  return &child.element;
}

const Element* Properties::require(const std::string& tag, const std::string& name) {
  const Element* found = find(tag, name);
  if (!found && missing_.empty()) missing_ = fmt::format("<{} name=\"{}\">", tag, name);
  return found;
}

double Properties::number(const std::string& name) {
  const Element* element = require("float", name);
  return element ? parse_number(*element, simple_value(*element)) : 0;
}

double Properties::number(const std::string& name, double absent) {
  const Element* element = find("float", name);
  return element ? parse_number(*element, simple_value(*element)) : absent;
}

int Properties::integer(const std::string& name, int absent) {
  const Element* element = find("integer", name);
  return element ? parse_integer(*element, simple_value(*element)) : absent;
}

bool Properties::boolean(const std::string& name, bool absent) {
  const Element* element = find("boolean", name);
  if (!element) return absent;
  const std::string value = simple_value(*element);
  if (value != "true" && value != "false") {
    element->fail(fmt::format("{}: {} is neither \"true\" nor \"false\"", element->label(),
                              in_quotes(value)));
  }
  return value == "true";
}

std::string Properties::string(const std::string& name) {
  const Element* element = require("string", name);
  return element ? simple_value(*element) : std::string();
}

std::string Properties::string(const std::string& name, const std::string& absent) {
  const Element* element = find("string", name);
  return element ? simple_value(*element) : absent;
}

Rgbd Properties::rgb(const std::string& name) {
  const Element* element = require("rgb", name);
  return element ? parse_rgb(*element, simple_value(*element)) : Rgbd{};
}

Rgbd Properties::rgb(const std::string& name, const Rgbd& absent) {
  return find("rgb", name) ? rgb(name) : absent;
}

Vec3d Properties::point(const std::string& name, const Vec3d& absent) {
  const Element* element = find("point", name);
  if (!element) return absent;
  element->allow_attributes({"name", "x", "y", "z", "value"});
  element->allow_no_children();
  return parse_xyz(*element, 0);
}

Vec3d Properties::vector(const std::string& name) {
  const Element* element = require("vector", name);
  if (!element) return {};
  element->allow_attributes({"name", "x", "y", "z", "value"});
  element->allow_no_children();
  return parse_xyz(*element, 0);
}

Affine Properties::transform(const std::string& name) {
  const Element* element = find("transform", name);
  if (!element) return {};
  element->allow_attributes({"name"});
  return read_transform(*element);
}

std::string Properties::tag_of(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? std::string() : children_[found->second].element.tag();
}

std::vector<Element> Properties::objects(const std::string& tag) {
  add_unique(known_tags_, tag);
  std::vector<Element> result;
  for (Child& child : children_) {
    if (child.element.tag() != tag) continue;
    child.used = true;
    result.push_back(child.element);
  }
  return result;
}

std::optional<Element> Properties::object(const std::string& tag) {
  const std::vector<Element> found = objects(tag);
  if (found.size() > 1) {
    found[1].fail(fmt::format("{} may hold one <{}> only", object_.label(), tag));
  }
  return found.empty() ? std::nullopt : std::optional(found.front());
}

std::optional<Element> Properties::required_object(const std::string& tag) {
  const std::optional<Element> found = object(tag);
  if (!found && missing_.empty()) missing_ = fmt::format("<{}>", tag);
  return found;
}

void Properties::finish() const {
  for (const Child& child : children_) {
    if (!child.used) refuse(child);
  }
  if (!missing_.empty()) object_.fail(fmt::format("{} needs {}", object_.label(), missing_));
}

void Properties::refuse(const Child& child) const {
  const std::string tag = child.element.tag();
  const bool known_tag =
      std::find(known_tags_.begin(), known_tags_.end(), tag) != known_tags_.end();
  if (known_tag || (is_property(child.element) && !known_names_.empty())) {
    const std::string hint = name_hint(child.name, known_names_);
    child.element.fail(fmt::format("{} has no property {}{}{}", object_.label(),
                                   in_quotes(child.name), hint.empty() ? "" : "; ", hint));
  }
  const std::string hint = name_hint(tag, known_tags_);
  child.element.fail(fmt::format("{} may not hold <{}>{}{}", object_.label(), tag.substr(0, 60),
                                 hint.empty() ? "" : "; ", hint));
}

void Properties::fail(const std::string& name, const std::string& message) const {
  const auto found = by_name_.find(name);
  const Element& at = found == by_name_.end() ? object_ : children_[found->second].element;
  at.fail(fmt::format("{}: {}", at.label(), message));
}

}  // namespace plumbline::renderer
