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

/// Puts parameters into an element, and registers its id.
void prepare(Node node, Reading& in) {
  put_parameters_in(node, in);
  if (node.attribute("id") && node.name() != std::string_view("ref")) {
    const std::string id = attribute(node, "id");
    if (id.empty()) refuse(node, "{} has an empty id", label(node));
    const auto [place, added] = in.ids.emplace(id, node);
    const Node first = place->second;
    if (!added) {
      const Source& source = *in.sources[in.source_of(first.root())];
      const std::string other = first.root() == node.root() ? "" : " of " + source.file.string();
      refuse(node, "id {} is taken by the {} on line {}{}", in_quotes(id), tag_of(first),
             line_at(source.text, first.offset_debug()), other);
    }
  }
}

/// Prepares an element and those in it.
/// @return false where all problems are to be found, and there was one
bool prepare_all(Node node, Reading& in) {
  bool good = attempt(in, [&] { prepare(node, in); });
  for (const Node child : node.children()) good &= prepare_all(child, in);
  return good;
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

template <const Named<ObjectType>& types>
void read_once(Node node, Reading& in) {
  if (!in.once.insert(node.name()).second) {
    refuse(node, "a scene has one {} only", tag_of(node));
  }
  read_object(node, types, in);
}

/// Files are looked for in its folder first from there on, as in Mitsuba.
void read_path(Node node, Reading& in) {
  allow_only_attributes(node, {"value"});
  const std::filesystem::path folder = find_file(attribute(node, "value"), in);
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    fail(node, "{} is not a folder", folder.string());
  }
  in.folders.push_back(folder);
}

void read_include(Node node, Reading& in);

/// What a <scene> may hold.
const Named<void (*)(Node, Reading&)> kElements = {
    {"default", read_parameter},
    {"include", read_include},
    {"integrator", read_once<kIntegratorTypes>},
    {"path", read_path},
    {"sensor", read_once<kSensorTypes>},
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
  const std::string start = version.substr(0, 2);
  const bool is_old = start == "0." || start == "1.";
  if ((start != "2." && start != "3." && !is_old) ||
      version.find_first_not_of("0123456789.") != std::string::npos) {
    refuse(root, "scene version {} is not supported; write 3.0.0", in_quotes(version));
  }
  if (!is_old) return;  // what is read of version 2 has the names and the meaning of 3
  refuse(root,
         "scene version {} is not supported: write 3.0.0, and names as it has them: to_world for "
         "toWorld, and so for all in camelCase (max_depth, sample_count, fov_axis, flip_normals, "
         "int_ior, ext_ior, alpha_u, near_clip), and lookat for lookAt",
         in_quotes(version));
}

/// Reads and parses a file.
/// @throws InputError "file:line: why" for what is wrong in it
const Source& add_source(const std::filesystem::path& file, Reading& in) {
  in.sources.push_back(std::make_unique<Source>());
  Source& source = *in.sources.back();
  source.file = file;
  in.scene.files.push_back(file);
  source.text = read_text_file(file, kMaxSceneBytes - in.bytes);
  in.bytes += source.text.size();
  try {
    parse_xml(source.text, source.xml);
  } catch (const Refusal& refusal) {
    throw refusal.in(source.file, source.text);
  }
  return source;
}

/// The elements of a file. Where all problems are to be found, one in each does not hide the next.
void read_elements(const Source& source, Reading& in) {
  const Node root = source.xml.document_element();
  attempt(in, [&] { check_root(root); });
  in.including.push_back(std::filesystem::weakly_canonical(source.file));
  for (const Node node : root.children()) {
    attempt(in, [&] {
      const auto message = fmt::format("{} may not hold {}", tag_of(root), tag_of(node));
      const auto read = look_up(kElements, node.name(), node, message);
      if (read == read_parameter || prepare_all(node, in)) read(node, in);
    });
  }
  in.including.pop_back();
}

/// Reads another scene file in the place of the element.
void read_include(Node node, Reading& in) {
  allow_only_attributes(node, {"filename"});
  const std::filesystem::path file = find_file(attribute(node, "filename"), in);
  if (std::ranges::count(in.including, std::filesystem::weakly_canonical(file)) > 0) {
    fail(node, "{} includes itself", file.string());
  }
  if (in.including.size() > kMaxIncludeNesting || in.sources.size() > kMaxIncludes) {
    fail(node, "more than {} files, or {} within each other, are included", kMaxIncludes,
         kMaxIncludeNesting);
  }
  const Source* source = nullptr;
  try {
    source = &add_source(file, in);
  } catch (const InputError& error) {
    fail(node, "{}", error.what());
  }
  read_elements(*source, in);
}

void read_scene(Reading& in) {
  const Source& source = add_source(in.scene.file, in);
  read_elements(source, in);
  SceneDescription& scene = in.scene;
  for (const auto& [shape, ref] : in.references) {
    attempt(in, [&, &at = shape, &to = ref] { scene.shapes[at].bsdf = resolve_bsdf(to, in); });
  }
  scene.bsdfs = in.bsdfs;
  attempt(in, [&] {
    const Node root = source.xml.document_element();
    if (in.once.count("sensor") == 0) refuse(root, "the scene has no <sensor>");
    if (scene.shapes.empty() && !scene.environment && !scene.environment_map && !scene.sun) {
      refuse(root, "the scene has neither a <shape> nor an <emitter>");
    }
  });
  attempt(in, [&] { check_overrides(in); });
  if (!in.problems || in.problems->empty()) attempt(in, [&] { check_clipping(in); });
}

}  // namespace

std::size_t Reading::source_of(Node document) const {
  const auto found = std::find_if(sources.begin(), sources.end(),
                                  [&](const auto& source) { return source->xml == document; });
  return document && found != sources.end() ? static_cast<std::size_t>(found - sources.begin()) : 0;
}

InputError Reading::error_of(const Refusal& refusal) const {
  const Source& source = *sources[source_of(refusal.document)];
  return refusal.in(source.file, source.text);
}

std::filesystem::path find_file(const std::string& name, const Reading& in) {
  std::error_code ignored;
  for (auto folder = in.folders.rbegin(); folder != in.folders.rend(); ++folder) {
    if (std::filesystem::exists(*folder / name, ignored)) return *folder / name;
  }
  return in.scene.file.parent_path() / name;
}

std::filesystem::path file_of(const Object& object, const Reading& in) {
  if (object[kFilename].empty()) fail(object.at(kFilename), "names no file");
  return find_file(object[kFilename], in);
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
  Reading in{overrides, size, std::nullopt};
  in.scene.file = file;
  try {
    read_scene(in);
    return std::move(in.scene);
  } catch (const Refusal& refusal) {
    throw in.error_of(refusal);
  }
}

std::vector<std::string> check_scene(const std::filesystem::path& file,
                                     const std::map<std::string, std::string>& overrides) {
  Reading in{overrides, std::nullopt, std::set<Problem>()};
  in.scene.file = file;
  attempt(in, [&] { read_scene(in); });
  std::vector<std::string> lines;
  for (const Problem& problem : *in.problems) lines.push_back(std::get<std::string>(problem));
  return lines;
}

}  // namespace plumbline::renderer
