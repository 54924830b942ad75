#include <plumbline/renderer/scene_file/load_scene.h>

#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/errors.h>

#include "document.h"
#include "parts.h"

namespace plumbline::renderer {
namespace {

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
    {"default", [](Node, Reading&) {}},  // by Document::prepare
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

void read_scene(Document& document, Reading& in) {
  const Node root = document.root();
  check_root(root);
  for (const Node node : root.children()) {
    const auto message = fmt::format("<scene> may not hold {}", tag_of(node));
    const auto read = look_up(kElements, node.name(), node, message);
    document.prepare(node);
    read(node, in);
  }
  SceneDescription& scene = in.scene;
  for (const auto& [shape, ref] : in.references) scene.shapes[shape].bsdf = resolve_bsdf(ref, in);
  scene.bsdfs = in.bsdfs;
  scene.parameters = document.parameters();
  if (!root.child("sensor")) refuse(root, "the scene has no <sensor>");
  if (scene.shapes.empty() && !scene.environment && !scene.environment_map && !scene.sun) {
    refuse(root, "the scene has neither a <shape> nor an <emitter>");
  }
  document.check_overrides();
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
    Document document(text, overrides);
    Reading in{document.ids(), size};
    in.scene.file = file;
    read_scene(document, in);
    return std::move(in.scene);
  } catch (const Refusal& refusal) {
    const auto at = static_cast<std::size_t>(refusal.offset);
    const std::string line = refusal.offset < 0 ? "" : fmt::format(":{}", line_at(text, at));
    throw InputError(fmt::format("{}{}: {}", file.string(), line, refusal.what()));
  }
}

}  // namespace plumbline::renderer
