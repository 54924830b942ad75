#include <plumbline/renderer/scene_file/load_scene.h>

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/errors.h>

#include "named.h"
#include "read_parts.h"
#include "text_file.h"

namespace plumbline::renderer {
namespace {

/// Reads the children of <scene> in document order, so that a parameter holds from its <default>
/// on.
class SceneReader {
 public:
  SceneReader(SceneFile& file, std::optional<FilmSize> size, SceneDescription& scene)
      : file_(file), size_(size), scene_(scene) {}

  void read() {
    const Element root = file_.root();
    if (root.tag() != "scene") {
      root.fail(
          fmt::format("the outermost element is <{}>, not <scene>", root.tag().substr(0, 60)));
    }
    root.allow_attributes({"version"});
    check_version(root);
    check_override_names(root);
    for (const Element& child : root.children()) read_child(child);
    for (const auto& [shape, ref] : references_) scene_.shapes[shape].bsdf = bsdfs_.resolve(ref);
    scene_.bsdfs = bsdfs_.take();
    if (!has_sensor_) root.fail("the scene has no <sensor>");
    if (scene_.shapes.empty() && !scene_.environment && !scene_.environment_map && !scene_.sun) {
      root.fail("the scene has neither a <shape> nor an <emitter>");
    }
  }

 private:
  static void check_version(const Element& root) {
    const std::string version = root.text("version");
    if (version.substr(0, 2) != "3." ||
        version.find_first_not_of("0123456789.") != std::string::npos) {
      root.fail(
          fmt::format("scene version {} is not supported; supported: 3.0.0 and what follows "
                      "with a leading 3",
                      in_quotes(version)));
    }
  }

  void check_override_names(const Element& root) const {
    std::vector<std::string> declared;
    for (const Element& child : root.children()) {
      if (child.tag() == "default" && child.has("name")) declared.push_back(child.text("name"));
    }
    file_.parameters().check_names(declared);
  }

  void read_child(const Element& element) {
    static const Named<void (SceneReader::*)(const Element&)> kinds = {
        {"default", &SceneReader::read_default}, {"integrator", &SceneReader::read_integrator},
        {"sensor", &SceneReader::read_sensor},   {"bsdf", &SceneReader::read_bsdf},
        {"shape", &SceneReader::read_shape},     {"emitter", &SceneReader::read_emitter}};
    const std::string tag = element.tag();
    if (const auto* read = kinds.find(tag)) return (this->**read)(element);
    element.fail(fmt::format("<scene> may not hold <{}>; {}", tag.substr(0, 60), kinds.hint(tag)));
  }

  void read_default(const Element& element) {
    element.allow_attributes({"name", "value"});
    element.allow_no_children();
    const std::string name = element.text("name");
    if (!Parameters::is_name(name)) {
      element.fail(fmt::format(
          "{} is no name for a parameter: letters, digits and _, not starting with a digit",
          in_quotes(name)));
    }
    if (!file_.parameters().declare(name, element.text("value"))) {
      element.fail(fmt::format("parameter {} is declared twice", in_quotes(name)));
    }
  }

  void read_integrator(const Element& element) {
    if (has_integrator_) element.fail("a scene has one <integrator> only");
    has_integrator_ = true;
    scene_.integrator = kIntegratorTypes.read(element);
  }

  void read_sensor(const Element& element) {
    if (has_sensor_) element.fail("a scene has one <sensor> only");
    has_sensor_ = true;
    kSensorTypes.read(element, size_, scene_);
  }

  void read_bsdf(const Element& element) {
    if (!element.has("id")) {
      element.fail(fmt::format("{} needs an id, or no shape can refer to it", element.label()));
    }
    bsdfs_.read(element);
  }

  void read_shape(const Element& element) {
    ShapeDescription shape;
    const auto ref = renderer::read_shape(element, bsdfs_, shape);
    if (ref) references_.emplace_back(scene_.shapes.size(), *ref);
    scene_.shapes.push_back(std::move(shape));
  }

  void read_emitter(const Element& element) {
    kSceneEmitterTypes.read(element, scene_);
    if (scene_.environment_map && (scene_.environment || scene_.sun)) {
      element.fail("an envmap is all the light from far away: no constant and no sun beside it");
    }
  }

  SceneFile& file_;
  std::optional<FilmSize> size_;
  SceneDescription& scene_;
  BsdfReader bsdfs_;
  std::vector<std::pair<std::size_t, Element>> references_;  ///< shapes with their <ref>s
  bool has_integrator_ = false, has_sensor_ = false;
};

}  // namespace

std::vector<SupportedType> supported_types(std::string_view tag) {
  const std::vector<std::pair<std::string_view, std::vector<ObjectRow>>> tables = {
      {"bsdf", kBsdfTypes.rows()},
      {"emitter", kAreaEmitterTypes.rows()},
      {"emitter", kSceneEmitterTypes.rows()},
      {"film", kFilmTypes.rows()},
      {"integrator", kIntegratorTypes.rows()},
      {"rfilter", kFilterTypes.rows()},
      {"sampler", kSamplerTypes.rows()},
      {"sensor", kSensorTypes.rows()},
      {"shape", kShapeTypes.rows()}};
  std::vector<SupportedType> types;
  for (const auto& [element, rows] : tables) {
    for (const ObjectRow& type : element == tag ? rows : std::vector<ObjectRow>{}) {
      types.push_back({type.name, {}});
      for (const PropertyRow& row : type.properties) {
        types.back().properties.push_back(
            {row.name,
             row.kind == Kind::nested ? "object" : fmt::format("{}", fmt::join(row.tags(), " or ")),
             row.absent == kRequired ? "required" : row.absent, row.range_text()});
      }
    }
  }
  return types;
}

SceneDescription load_scene(const std::filesystem::path& file,
                            const std::map<std::string, std::string>& overrides,
                            std::optional<FilmSize> size) {
  if (size) {
    const std::string wrong = film_size_error(*size);
    if (!wrong.empty()) throw InputError(wrong);
  }
  SceneFile source(file, overrides);
  SceneDescription scene;
  scene.file = file;
  try {
    SceneReader(source, size, scene).read();
    source.parameters().check_used();
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
  scene.parameters = source.parameters().values();
  return scene;
}

}  // namespace plumbline::renderer
