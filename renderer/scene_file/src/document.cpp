#include "document.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <set>
#include <system_error>

#include <plumbline/renderer/core/errors.h>

namespace plumbline::renderer {
namespace {

constexpr int kMaxDepth = 32, kMaxAttributes = 32;
constexpr std::string_view kNameCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";

void check_kind(Node node) {
  if (node.type() == pugi::node_doctype) {
    refuse(node,
           "<!DOCTYPE> is refused: a scene file declares no entities and reads no other document");
  }
  if (node.type() == pugi::node_pi) {
    refuse(node, "processing instruction {} is not supported", in_quotes(node.name()));
  }
  if (node.type() != pugi::node_element) {
    refuse(node, "text {} outside of an attribute", in_quotes(node.value()));
  }
}

void check_attributes(Node node) {
  std::set<std::string_view> names;
  for (const pugi::xml_attribute attribute : node.attributes()) {
    if (names.size() == kMaxAttributes) {
      refuse(node, "an element has more than {} attributes", kMaxAttributes);
    }
    if (!names.insert(attribute.name()).second) {
      refuse(node, "attribute {} is given twice", in_quotes(attribute.name()));
    }
  }
}

void check_children(Node parent, int depth) {
  for (const Node node : parent.children()) {
    check_kind(node);
    if (depth == 0 && node.previous_sibling()) refuse(node, "a file holds one <scene> only");
    if (depth == kMaxDepth) refuse(node, "elements are nested deeper than {}", kMaxDepth);
    check_attributes(node);
    check_children(node, depth + 1);
  }
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  const auto require = [&](bool good, const std::string& why) {
    if (!good) throw InputError(fmt::format("{}: {}", file.string(), why));
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  require(status.type() != std::filesystem::file_type::not_found, "there is no such file");
  require(!error, error.message());
  require(!std::filesystem::is_directory(status), "is a directory, not a file");
  require(std::filesystem::is_regular_file(status), "is not a regular file");
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  require(!error, error.message());
  require(bytes > 0, "is empty");
  require(
      bytes <= max_bytes,
      fmt::format("has {} bytes, more than the {} that such a file may have", bytes, max_bytes));
  std::ifstream in(file, std::ios::binary);
  require(in.is_open(), fmt::format("cannot be opened: {}", std::strerror(errno)));
  std::string text(bytes, '\0');
  in.read(text.data(), static_cast<std::streamsize>(bytes));
  require(in.good(), "cannot be read to its end");
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
    throw InputError(fmt::format("{}:{}: holds a zero byte, so it is not UTF-8 text", file.string(),
                                 line_at(text, zero)));
  }
  return text;
}

std::size_t line_at(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

Document::Document(std::string_view text, std::map<std::string, std::string> overrides)
    : text_(text), overrides_(std::move(overrides)) {
  // Document types and processing instructions are kept only to be refused with their line.
  // UTF-8 is stated: a guessed encoding would convert the text and shift all offsets.
  constexpr unsigned kOptions =
      pugi::parse_default | pugi::parse_doctype | pugi::parse_pi | pugi::parse_fragment;
  const auto parsed = xml_.load_buffer(text.data(), text.size(), kOptions, pugi::encoding_utf8);
  if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!parsed) {
    throw Refusal(parsed.offset, fmt::format("is not well-formed XML: {}", parsed.description()));
  }
  check_children(xml_, 0);
  if (!root()) refuse(xml_, "holds no XML element; a <scene> was expected");
}

void Document::prepare(Node node) {
  const bool declares = node.parent() == root() && node.name() == std::string_view("default");
  declares ? declare(node) : put_parameters_in(node);
  register_id(node);
  for (const Node child : node.children()) prepare(child);
}

void Document::declare(Node node) {
  allow_only_attributes(node, {"name", "value"});
  const std::string name = attribute(node, "name");
  if (name.empty() || name.find_first_not_of(kNameCharacters) != std::string::npos ||
      (name[0] >= '0' && name[0] <= '9')) {
    refuse(node, "{} is no name for a parameter: letters, digits and _, not starting with a digit",
           in_quotes(name));
  }
  put_parameters_in(node);
  const auto override = overrides_.find(name);
  const std::string value = attribute(node, "value");
  if (!parameters_.emplace(name, override == overrides_.end() ? value : override->second).second) {
    refuse(node, "parameter {} is declared twice", in_quotes(name));
  }
}

void Document::put_parameters_in(Node node) {
  for (pugi::xml_attribute attribute : node.attributes()) {
    const std::string_view text = attribute.value();
    if (text.find('$') == std::string_view::npos) continue;
    if (!attribute.set_value(with_parameters(node, text).c_str())) throw std::bad_alloc();
  }
}

/// The text with every $name replaced. The values put in are not looked at again.
std::string Document::with_parameters(Node node, std::string_view text) {
  std::size_t dollar = text.find('$');
  std::string result(text.substr(0, dollar));
  while (dollar != std::string_view::npos) {
    text.remove_prefix(dollar + 1);
    const std::string name(text.substr(0, text.find_first_not_of(kNameCharacters)));
    if (name.empty()) fail(node, "a $ must be followed by a parameter's name");
    const auto found = parameters_.find(name);
    if (found == parameters_.end()) {
      refuse_name(node,
                  fmt::format("{}: no <default> before this line declares ${}", label(node), name),
                  name, names_of(parameters_));
    }
    overrides_.erase(name);
    put_in_ += found->second.size();
    if (put_in_ > kMaxSceneBytes) {  // parameters of parameters double with every line
      fail(node, "parameters have put in more than {} bytes up to here", kMaxSceneBytes);
    }
    text.remove_prefix(name.size());
    dollar = text.find('$');
    result.append(found->second).append(text.substr(0, dollar));
  }
  return result;
}

void Document::register_id(Node node) {
  if (!node.attribute("id") || node.name() == std::string_view("ref")) return;
  const std::string id = attribute(node, "id");
  if (id.empty()) refuse(node, "{} has an empty id", label(node));
  const auto [place, added] = ids_.emplace(id, node);
  if (added) return;
  const Node first = place->second;
  refuse(node, "id {} is taken by the {} on line {}", in_quotes(id), tag_of(first),
         line_at(text_, static_cast<std::size_t>(first.offset_debug())));
}

void Document::check_overrides() const {
  if (overrides_.empty()) return;
  const std::string& name = overrides_.begin()->first;
  const std::string quoted = in_quotes(name);
  if (parameters_.empty()) {
    refuse({}, "has no <default> parameters, so {} cannot be set", quoted);
  }
  if (parameters_.count(name) == 0) {
    refuse_name({}, fmt::format("no parameter {}", quoted), name, names_of(parameters_));
  }
  refuse({}, "parameter {} is set, but nothing in the file uses it", quoted);
}

}  // namespace plumbline::renderer
