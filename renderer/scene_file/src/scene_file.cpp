#include "scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <set>
#include <stdexcept>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/nearest_name.h>

#include "text_file.h"

namespace plumbline::renderer {

std::string Element::text(const char* attribute) const {
  const pugi::xml_attribute found = node_.attribute(attribute);
  if (!found) fail(fmt::format("{} needs the attribute \"{}\"", label(), attribute));
  try {
    return file_->parameters().substitute(found.value());
  } catch (const std::invalid_argument& error) {
    fail(fmt::format("{}: {}", label(), error.what()));
  }
}

std::size_t Element::type(const std::vector<std::string>& supported) const {
  allow_attributes({"type", "id", "name"});
  const std::string value = text("type");
  const auto found = std::find(supported.begin(), supported.end(), value);
  if (found == supported.end()) {
    fail(fmt::format("<{}> of type {} is not supported; {}", tag(), in_quotes(value),
                     name_hint(value, supported)));
  }
  file_->register_id(*this);
  return static_cast<std::size_t>(found - supported.begin());
}

void Element::allow_attributes(const std::vector<std::string>& allowed) const {
  for (const pugi::xml_attribute attribute : node_.attributes()) {
    const std::string name = attribute.name();
    if (std::find(allowed.begin(), allowed.end(), name) != allowed.end()) continue;
    fail(fmt::format("{} has no attribute {}; {}", label(), in_quotes(name),
                     name_hint(name, allowed)));
  }
}

std::vector<Element> Element::children() const {
  std::vector<Element> result;
  for (const pugi::xml_node child : node_.children()) result.emplace_back(*file_, child);
  return result;
}

void Element::allow_no_children() const {
  if (const pugi::xml_node child = node_.first_child()) {
    Element(*file_, child).fail(fmt::format("{} may hold nothing", label()));
  }
}

std::string Element::label() const {
  for (const char* key : {"name", "type", "id"}) {
    if (has(key)) {
      return fmt::format("<{} {}={}>", tag(), key, in_quotes(node_.attribute(key).value()));
    }
  }
  return fmt::format("<{}>", tag().substr(0, 60));
}

void Element::fail(const std::string& message) const { file_->fail(offset(), message); }

SceneFile::SceneFile(const std::filesystem::path& path,
                     const std::map<std::string, std::string>& overrides)
    : path_(path), text_(read_text_file(path, kMaxBytes)), parameters_(overrides) {
  parse();
  check_structure();
}

Element SceneFile::root() { return {*this, document_.document_element()}; }

void SceneFile::parse() {
  // Document types and processing instructions are kept only to be refused with their line.
  // UTF-8 is stated: a guessed encoding would convert the text and shift all offsets.
  constexpr unsigned kOptions =
      pugi::parse_default | pugi::parse_doctype | pugi::parse_pi | pugi::parse_fragment;
  const pugi::xml_parse_result result =
      document_.load_buffer(text_.data(), text_.size(), kOptions, pugi::encoding_utf8);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!result) {
    fail(static_cast<std::size_t>(result.offset),
         fmt::format("is not well-formed XML: {}", result.description()));
  }
}

void SceneFile::check_structure() {
  struct Walker : pugi::xml_tree_walker {  // goes without recursion: depth costs no stack
    explicit Walker(const SceneFile& its_file) : file(its_file) {}
    bool for_each(pugi::xml_node& node) override {
      file.check_node(node, depth());
      if (depth() == 0 && ++elements_at_top > 1) {
        file.fail(static_cast<std::size_t>(node.offset_debug()), "a file holds one <scene> only");
      }
      return true;
    }
    const SceneFile& file;
    int elements_at_top = 0;
  } walker(*this);
  document_.traverse(walker);
  if (walker.elements_at_top == 0) fail(0, "holds no XML element; a <scene> was expected");
}

void SceneFile::check_node(pugi::xml_node node, int depth) const {
  const auto refuse = [&](const std::string& message) {
    fail(static_cast<std::size_t>(node.offset_debug()), message);
  };
  if (node.type() == pugi::node_doctype) {
    refuse("<!DOCTYPE> is refused: a scene file declares no entities and reads no other document");
  }
  if (node.type() == pugi::node_pi) {
    refuse(fmt::format("processing instruction {} is not supported", in_quotes(node.name())));
  }
  if (node.type() != pugi::node_element) {
    refuse(fmt::format("text {} outside of an attribute", in_quotes(node.value())));
  }
  if (depth >= kMaxDepth) refuse(fmt::format("elements are nested deeper than {}", kMaxDepth));
  int attributes = 0;
  std::set<std::string_view> names;
  for (const pugi::xml_attribute attribute : node.attributes()) {
    if (++attributes > kMaxAttributes) {
      refuse(fmt::format("an element has more than {} attributes", kMaxAttributes));
    }
    if (!names.insert(attribute.name()).second) {
      refuse(fmt::format("attribute {} is given twice", in_quotes(attribute.name())));
    }
  }
}

void SceneFile::register_id(const Element& element) {
  if (!element.has("id")) return;
  const std::string id = element.text("id");
  if (id.empty()) element.fail(fmt::format("{} has an empty id", element.label()));
  const auto [place, added] = ids_.emplace(id, Place{element.tag(), element.offset()});
  if (!added) {
    element.fail(fmt::format("id {} is taken by the <{}> on line {}", in_quotes(id),
                             place->second.tag, line_at(text_, place->second.offset)));
  }
}

std::string SceneFile::tag_of_id(const std::string& id) const {
  const auto found = ids_.find(id);
  return found == ids_.end() ? std::string() : found->second.tag;
}

void SceneFile::fail(std::size_t offset, const std::string& message) const {
  throw InputError(fmt::format("{}:{}: {}", path_.string(), line_at(text_, offset), message));
}

}  // namespace plumbline::renderer
