#include <plumbline/renderer/scene_file/load_scene.h>

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/nearest_name.h>

#include "read_parts.h"
#include "text_file.h"

namespace plumbline::renderer {
namespace {

/// Reads the children of <scene> in document order, so that a parameter holds from its <default>
/// on.
class SceneReader {
 public:
  SceneReader(SceneFile& file, std::optional<FilmSize> size, SceneDescription& scene)
      : file_(file), size_(size), scene_(scene), shapes_(scene.shapes, bsdfs_) {}

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
    shapes_.resolve_references();
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
    const std::string tag = element.tag();
    if (tag == "default") return read_default(element);
    if (tag == "integrator") return read_the_integrator(element);
    if (tag == "sensor") return read_the_sensor(element);
    if (tag == "bsdf") return read_shared_bsdf(element);
    if (tag == "shape") return shapes_.read(element);
    if (tag == "emitter") return read_scene_emitter(element, scene_);
    element.fail(fmt::format(
        "<scene> may not hold <{}>; {}", tag.substr(0, 60),
        name_hint(tag, {"default", "integrator", "sensor", "bsdf", "shape", "emitter"})));
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

  void read_the_integrator(const Element& element) {
    if (has_integrator_) element.fail("a scene has one <integrator> only");
    has_integrator_ = true;
    scene_.integrator = kIntegratorTypes.read(element);
  }

  void read_the_sensor(const Element& element) {
    if (has_sensor_) element.fail("a scene has one <sensor> only");
    has_sensor_ = true;
    kSensorTypes.read(element, size_, scene_);
  }

  void read_shared_bsdf(const Element& element) {
    if (!element.has("id")) {
      element.fail(fmt::format("{} needs an id, or no shape can refer to it", element.label()));
    }
    bsdfs_.read(element);
  }

  SceneFile& file_;
  std::optional<FilmSize> size_;
  SceneDescription& scene_;
  BsdfReader bsdfs_;
  ShapeReader shapes_;
  bool has_integrator_ = false, has_sensor_ = false;
};

/// What an element may be, wherever it stands.
std::vector<ObjectRow> types_of(std::string_view tag) {
  if (tag == "bsdf") return kBsdfTypes.rows();
  if (tag == "film") return kFilmTypes.rows();
  if (tag == "integrator") return kIntegratorTypes.rows();
  if (tag == "rfilter") return kFilterTypes.rows();
  if (tag == "sampler") return kSamplerTypes.rows();
  if (tag == "sensor") return kSensorTypes.rows();
  if (tag == "shape") return kShapeTypes.rows();
  if (tag != "emitter") return {};
  std::vector<ObjectRow> emitters = kAreaEmitterTypes.rows();
  for (const ObjectRow& row : kSceneEmitterTypes.rows()) emitters.push_back(row);
  return emitters;
}

}  // namespace

std::vector<std::string> supported_types(std::string_view tag) {
  std::vector<std::string> names;
  for (const ObjectRow& type : types_of(tag)) names.push_back(type.name);
  return names;
}

std::vector<SupportedProperty> supported_properties(std::string_view tag) {
  std::vector<SupportedProperty> properties;
  for (const ObjectRow& type : types_of(tag)) {
    for (const PropertyRow& row : type.properties) {
      properties.push_back(
          {type.name, row.name,
           row.kind == Kind::nested ? "object" : fmt::format("{}", fmt::join(row.tags(), " or ")),
           row.absent == kRequired ? "required" : row.absent, row.range_text()});
    }
  }
  return properties;
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
