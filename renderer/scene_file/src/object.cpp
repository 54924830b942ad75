#include "parts.h"

namespace plumbline::renderer {
namespace {

/// Those of Mitsuba's that we do not take count as properties too, for the message.
bool is_property(Node node) {
  static const std::vector<std::string> tags = {"boolean",   "float",    "integer", "point",
                                                "rgb",       "spectrum", "string",  "texture",
                                                "transform", "vector"};
  return contains(tags, node.name());
}

bool gives(Node child, const PropertyRow& row) {
  return row.parse ? is_property(child) && attribute(child, "name") == row.name
                   : contains(row.tags, child.name());
}

/// What is wrong within an object of which nothing came.
void check_nested(Node node, Reading& in) {
  const Named<const Named<ObjectType>&> tables = {{"emitter", kAreaEmitterTypes},
                                                  {"film", kFilmTypes},
                                                  {"rfilter", kFilterTypes},
                                                  {"sampler", kSamplerTypes}};
  for (const Node child : node.children()) {
    if (child.name() == std::string_view("bsdf")) read_bsdf(child, in);
    for (const auto& [tag, types] : tables) {
      if (tag == child.name()) read_object(child, types, in);
    }
  }
}

/// "<bsdf> or <ref>"
std::string in_brackets(const std::vector<std::string>& tags) {
  return fmt::format("<{}>", fmt::join(tags, "> or <"));
}

}  // namespace

Object::Object(Node node, const ObjectType& type, Reading& in) : node_(node), good_(true) {
  for (const PropertyRow& row : type.properties) given_[row.name];
  for (const Node child : node.children()) {
    good_ &= attempt(in, [&] {
      const auto row = std::find_if(type.properties.begin(), type.properties.end(),
                                    [&](const PropertyRow& p) { return gives(child, p); });
      if (row == type.properties.end()) refuse_child(child, type);
      add(child, *row);
    });
  }
  for (const PropertyRow& row : type.properties) {
    good_ &= attempt(in, [&] { complete(row); });
  }
}

void Object::add(Node child, const PropertyRow& row) {
  std::vector<Node>& given = given_.at(row.name);
  given.push_back(child);
  if (!row.parse) {
    if (given.size() < 2 || row.range.high > 1) return;
    refuse(child, "{} may hold one {} only", label(node_), in_brackets(row.tags));
  }
  if (given.size() > 1) refuse(child, "{} has a second property \"{}\"", label(node_), row.name);
  if (!contains(row.tags, child.name())) {
    const std::string advice = advice_for(child.name());
    refuse(child, "{} of {} must be a {}{}{}", label(child), label(node_), in_brackets(row.tags),
           advice.empty() ? "" : ": ", advice);
  }
  values_[row.name] = row.parse(child, text_of(child), row.range);
}

void Object::complete(const PropertyRow& row) {
  const auto count = static_cast<double>(given_.at(row.name).size());
  const double low = row.range.low, high = row.range.high;
  if (!row.parse) {
    if (count >= low && count <= high) return;
    const std::string tags = in_brackets(row.tags);
    if (high == 1) refuse(node_, "{} needs {}{}", label(node_), tags, row.range.more);
    fail(node_, "nests {}{:g} BSDFs: {}", low < high ? fmt::format("{:g} or ", low) : "", high,
         tags);
  }
  if (count > 0 || row.absent == kWithoutEffect) return;
  if (row.absent == kRequired) {
    const std::vector<std::string>& choices = row.range.choices;
    const std::string value = choices.empty() ? "" : fmt::format(" value=\"{}\"", choices.front());
    refuse(node_, "{} needs <{} name=\"{}\"{}>", label(node_), row.tags.front(), row.name, value);
  }
  values_[row.name] = row.parse(node_, row.absent, row.range);
}

void Object::refuse_child(Node child, const ObjectType& type) const {
  std::vector<std::string> names, tags;
  for (const PropertyRow& row : type.properties) {
    if (row.parse) names.push_back(row.name);
    for (const std::string& tag : row.tags) {
      if (!contains(tags, tag)) tags.push_back(tag);
    }
  }
  if (!is_property(child) || names.empty()) {
    refuse_unsupported(child, fmt::format("{} may not hold {}", label(node_), tag_of(child)),
                       child.name(), tags);
  }
  const std::string name = attribute(child, "name");
  refuse_unsupported(child, fmt::format("{} has no property {}", label(node_), in_quotes(name)),
                     name, names);
}

Object read_object(Node node, const Named<ObjectType>& types, Reading& in) {
  Object object(node);
  const bool good = attempt(in, [&] {
    const std::string name = attribute(node, "type");
    const ObjectType& type =
        look_up(types, name, node,
                fmt::format("{} of type {} is not supported", tag_of(node), in_quotes(name)));
    object = Object(node, type, in);
    object.good_ &= attempt(in, [&] { allow_attributes(node, {"type", "id", "name"}); });
    if (object.good_) type.read(object, in);
  });
  object.good_ &= good;
  if (!object.good_) check_nested(node, in);
  return object;
}

void read_default(const Nested& objects, const Named<ObjectType>& types, Reading& in) {
  const ObjectType& type = look_up(types, objects.absent, {}, "no type");
  type.read(Object({}, type, in), in);
}

}  // namespace plumbline::renderer
