#include <plumbline/renderer/scene_file/load_scene.h>

#include <new>

#include "parts.h"

namespace plumbline::renderer {
namespace {

/// Of the names of parameters.
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
  int count = 0;
  for (const pugi::xml_attribute attribute : node.attributes()) {
    if (++count > kMaxElementAttributes) {
      refuse(node, "an element has more than {} attributes", kMaxElementAttributes);
    }
    if (node.attribute(attribute.name()) != attribute) {  // which is the first of that name
      refuse(node, "attribute {} is given twice", in_quotes(attribute.name()));
    }
  }
}

void check_children(Node parent, int depth) {
  for (const Node node : parent.children()) {
    check_kind(node);
    if (depth == 0 && node.previous_sibling()) refuse(node, "a file holds one <scene> only");
    if (depth == kMaxElementNesting) {
      refuse(node, "elements are nested deeper than {}", kMaxElementNesting);
    }
    check_attributes(node);
    check_children(node, depth + 1);
  }
}

/// A well-formed XML file of bounded depth, without anything that reaches outside it (document
/// types, entities, processing instructions).
void parse_xml(std::string_view text, pugi::xml_document& xml) {
  // Document types and processing instructions are kept only to be refused with their line.
  // UTF-8 is stated: a guessed encoding would convert the text and shift all offsets.
  constexpr unsigned kOptions =
      pugi::parse_default | pugi::parse_doctype | pugi::parse_pi | pugi::parse_fragment;
  const auto parsed = xml.load_buffer(text.data(), text.size(), kOptions, pugi::encoding_utf8);
  if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!parsed) refuse(parsed.offset, "is not well-formed XML: {}", parsed.description());
  check_children(xml, 0);
  if (!xml.document_element()) refuse(xml, "holds no XML element; a <scene> was expected");
}

/// The text with every $name replaced. The values put in are not looked at again.
std::string with_parameters(Node node, std::string_view text, Reading& in) {
  const std::map<std::string, std::string>& parameters = in.scene.parameters;
  std::size_t dollar = text.find('$');
  std::string result(text.substr(0, dollar));
  while (dollar != std::string_view::npos) {
    text.remove_prefix(dollar + 1);
    const std::string name(text.substr(0, text.find_first_not_of(kNameCharacters)));
    if (name.empty()) fail(node, "a $ must be followed by a parameter's name");
    const auto found = parameters.find(name);
    if (found == parameters.end()) {
      refuse_name(node,
                  fmt::format("{}: no <default> before this line declares ${}", label(node), name),
                  name, names_of(parameters));
    }
    in.overrides.erase(name);
    in.put_in += found->second.size();
    if (result.size() + found->second.size() > kMaxValueBytes) {
      fail(node, "${} makes the value longer than {} bytes", name, kMaxValueBytes);
    }
    if (in.put_in > kMaxSceneBytes) {
      fail(node, "parameters have put in more than {} bytes up to here", kMaxSceneBytes);
    }
    text.remove_prefix(name.size());
    dollar = text.find('$');
    result.append(found->second).append(text.substr(0, dollar));
  }
  return result;
}

void put_parameters_in(Node node, Reading& in) {
  for (pugi::xml_attribute attribute : node.attributes()) {
    const std::string_view text = attribute.value();
    if (text.find('$') == std::string_view::npos) continue;
    if (!attribute.set_value(with_parameters(node, text, in).c_str())) throw std::bad_alloc();
  }
}

/// Reads a <default>, which holds from there on.
void read_parameter(Node node, Reading& in) {
  allow_only_attributes(node, {"name", "value"});
  const std::string name = attribute(node, "name");
  if (name.empty() || name.find_first_not_of(kNameCharacters) != std::string::npos ||
      (name[0] >= '0' && name[0] <= '9')) {
    refuse(node, "{} is no name for a parameter: letters, digits and _, not starting with a digit",
           in_quotes(name));
  }
  put_parameters_in(node, in);
  const auto [parameter, is_new] = in.scene.parameters.emplace(name, attribute(node, "value"));
  if (!is_new) refuse(node, "parameter {} is declared twice", in_quotes(name));
  const auto override = in.overrides.find(name);
  if (override != in.overrides.end()) parameter->second = override->second;
}

void check_overrides(const Reading& in) {
  if (in.overrides.empty()) return;
  const std::string& name = in.overrides.begin()->first;
  const std::map<std::string, std::string>& parameters = in.scene.parameters;
  if (parameters.empty()) {
    refuse(kNowhere, "has no <default> parameters, so {} cannot be set", in_quotes(name));
  }
  if (parameters.count(name) == 0) {
    refuse_name({}, fmt::format("no parameter {}", in_quotes(name)), name, names_of(parameters));
  }
  refuse(kNowhere, "parameter {} is set, but nothing in the file uses it", in_quotes(name));
}

/// Puts parameters into an element and those in it, and registers their ids.
void prepare(Node node, Reading& in) {
  put_parameters_in(node, in);
  if (node.attribute("id") && node.name() != std::string_view("ref")) {
    const std::string id = attribute(node, "id");
    if (id.empty()) refuse(node, "{} has an empty id", label(node));
    const auto [place, added] = in.ids.emplace(id, node);
    const Node first = place->second;
    if (!added) {
      refuse(node, "id {} is taken by the {} on line {}", in_quotes(id), tag_of(first),
             line_at(in.text, first.offset_debug()));
    }
  }
  for (const Node child : node.children()) prepare(child, in);
}

void read_shared_bsdf(Node node, Reading& in) {
  if (!node.attribute("id")) {
    refuse(node, "{} needs an id, or no shape can refer to it", label(node));
  }
  read_bsdf(node, in);
}

void read_emitter(Node node, Reading& in) {
  read_object(node, kSceneEmitterTypes, in);
  if (in.scene.environment_map && (in.scene.environment || in.scene.sun)) {
    refuse(node, "an envmap is all the light from far away: no constant and no sun beside it");
  }
}

/// What a <scene> may hold.
const Named<void (*)(Node, Reading&)> kElements = {
    {"default", read_parameter},
    {"integrator", [](Node node, Reading& in) { read_object(node, kIntegratorTypes, in); }},
    {"sensor", [](Node node, Reading& in) { read_object(node, kSensorTypes, in); }},
    {"bsdf", read_shared_bsdf},
    {"shape", read_shape},
    {"emitter", read_emitter},
};

void check_root(Node root) {
  if (root.name() != std::string_view("scene")) {
    refuse(root, "the outermost element is {}, not <scene>", tag_of(root));
  }
  allow_attributes(root, {"version"});
  const std::string version = attribute(root, "version");
  if (version.substr(0, 2) != "3." ||
      version.find_first_not_of("0123456789.") != std::string::npos) {
    refuse(root,
           "scene version {} is not supported; supported: 3.0.0 and what follows with a leading 3",
           in_quotes(version));
  }
  for (const char* once : {"integrator", "sensor"}) {
    if (const Node second = root.child(once).next_sibling(once)) {
      refuse(second, "a scene has one <{}> only", once);
    }
  }
}

void read_scene(Reading& in) {
  pugi::xml_document xml;
  parse_xml(in.text, xml);
  const Node root = xml.document_element();
  check_root(root);
  for (const Node node : root.children()) {
    const auto message = fmt::format("<scene> may not hold {}", tag_of(node));
    const auto read = look_up(kElements, node.name(), node, message);
    if (read != read_parameter) prepare(node, in);
    read(node, in);
  }
  SceneDescription& scene = in.scene;
  for (const auto& [shape, ref] : in.references) scene.shapes[shape].bsdf = resolve_bsdf(ref, in);
  scene.bsdfs = in.bsdfs;
  if (!root.child("sensor")) refuse(root, "the scene has no <sensor>");
  if (scene.shapes.empty() && !scene.environment && !scene.environment_map && !scene.sun) {
    refuse(root, "the scene has neither a <shape> nor an <emitter>");
  }
  check_overrides(in);
}

}  // namespace

std::filesystem::path file_of(const Object& object, const Reading& in) {
  if (object[kFilename].empty()) fail(object.at(kFilename), "names no file");
  return in.scene.file.parent_path() / object[kFilename];
}

std::vector<SupportedType> supported_types(std::string_view tag) {
  const Named<const Named<ObjectType>&> tables = {
      {"bsdf", kBsdfTypes},       {"emitter", kAreaEmitterTypes},   {"emitter", kSceneEmitterTypes},
      {"film", kFilmTypes},       {"integrator", kIntegratorTypes}, {"rfilter", kFilterTypes},
      {"sampler", kSamplerTypes}, {"sensor", kSensorTypes},         {"shape", kShapeTypes}};
  std::vector<SupportedType> supported;
  for (const auto& [element, types] : tables) {
    if (element != tag) continue;
    for (const auto& [name, type] : types) {
      supported.push_back({name, {}});
      for (const PropertyRow& row : type.properties) {
        supported.back().properties.push_back(
            {row.name, row.parse ? fmt::format("{}", fmt::join(row.tags, " or ")) : "object",
             row.absent == kRequired ? "required" : row.absent, row.range.text()});
      }
    }
  }
  return supported;
}

SceneDescription load_scene(const std::filesystem::path& file,
                            const std::map<std::string, std::string>& overrides,
                            std::optional<FilmSize> size) {
  const std::string wrong = size ? film_size_error(*size) : "";
  if (!wrong.empty()) throw InputError(wrong);
  const std::string text = read_text_file(file, kMaxSceneBytes);
  try {
    Reading in{text, overrides, size};
    in.scene.file = file;
    read_scene(in);
    return std::move(in.scene);
  } catch (const Refusal& refusal) {
    throw refusal.in(file, text);
  }
}

}  // namespace plumbline::renderer
