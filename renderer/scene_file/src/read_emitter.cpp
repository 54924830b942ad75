#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/exr.h>

#include "read_parts.h"

namespace plumbline::renderer {
namespace {

constexpr double kMaxRadiance = 1e30;  // sums of it stay finite in single precision

bool in_range(double value) { return value >= 0 && value <= kMaxRadiance; }

Rgbd emission(Properties& properties, const std::string& name) {
  const Rgbd value = properties.rgb(name);
  if (!in_range(value.r) || !in_range(value.g) || !in_range(value.b)) {
    properties.fail(name, fmt::format("must lie between 0 and {:g}", kMaxRadiance));
  }
  return value;
}

Properties open(const Element& element, const std::vector<std::string>& types) {
  element.allow_attributes({"type", "id", "name"});
  element.type(types);
  element.file().register_id(element);
  return Properties(element);
}

PointDescription read_point(Properties& properties) {
  const Vec3d position = properties.point("position", {0, 0, 0});
  const Rgbd intensity = emission(properties, "intensity");
  properties.finish();
  if (!is_in_range(position)) {
    properties.fail("position", fmt::format("puts a coordinate beyond {:g}", kMaxLength));
  }
  return {position, intensity};
}

SunDescription read_sun(Properties& properties) {
  const Vec3d travels = properties.vector("direction");
  const double half_angle = properties.number("half_angle", SunAndSky::kSunHalfAngle);
  const Rgbd radiance = emission(properties, "radiance");
  properties.finish();
  const double norm = length(travels);
  if (!(norm > 0 && std::isfinite(norm))) {
    properties.fail("direction", "must have a length that is neither zero nor infinite");
  }
  if (!(half_angle >= 1e-3 && half_angle <= 90)) {
    properties.fail("half_angle", "must lie between 0.001 and 90 degrees");
  }
  return {-travels / norm, half_angle * pi<double>() / 180, radiance};
}

Image read_map(const Properties& properties, const std::filesystem::path& file) {
  Image image;
  try {
    image = read_exr(file);
  } catch (const InputError& error) {
    properties.fail("filename", error.what());
  }
  for (const Rgbf& p : image.pixels) {
    for (const float channel : {p.r, p.g, p.b}) {
      if (in_range(static_cast<double>(channel))) continue;
      properties.fail("filename",
                      fmt::format("{} holds a pixel that does not lie between 0 and {:g}",
                                  file.string(), kMaxRadiance));
    }
  }
  return image;
}

EnvironmentMap read_environment_map(Properties& properties, const SceneFile& file) {
  const std::string name = properties.string("filename");
  const double scale = properties.number("scale", 1);
  const bool compensation = properties.boolean("mis_compensation", false);
  const Affine to_world = properties.transform("to_world");
  properties.finish();
  if (name.empty()) properties.fail("filename", "names no file");
  if (!(scale >= 0 && scale <= 1e6)) properties.fail("scale", "must lie between 0 and 1e+06");
  if (!is_rigid(to_world)) {
    properties.fail("to_world", "an environment may be turned and mirrored, not scaled or sheared");
  }
  Image image = read_map(properties, file.path().parent_path() / name);
  return {std::make_shared<EnvironmentTable>(image.width, image.height, std::move(image.pixels),
                                             compensation),
          {vec_cast<float>(normalize(to_world.x)), vec_cast<float>(normalize(to_world.y)),
           vec_cast<float>(normalize(to_world.z))},
          static_cast<float>(scale)};
}

}  // namespace

void read_area_emitter(const Element& element, ShapeDescription& shape) {
  Properties properties = open(element, {"area"});
  shape.radiance = emission(properties, "radiance");
  const std::string sampling = properties.string("sampling", "area");
  shape.light_two_sided = properties.boolean("two_sided", false);
  properties.finish();
  shape.light_by_solid_angle = sampling == "solid_angle";
  if (sampling != "area" && sampling != "solid_angle") {
    properties.fail("sampling", "must be area or solid_angle");
  }
  if (shape.light_by_solid_angle && !std::holds_alternative<RectangleShape>(shape.geometry) &&
      !std::holds_alternative<MeshShape>(shape.geometry)) {
    properties.fail("sampling", "only a rectangle or an obj can be sampled by solid_angle");
  }
  if (shape.light_two_sided && !std::holds_alternative<RectangleShape>(shape.geometry)) {
    properties.fail("two_sided", "only a rectangle can emit from both sides");
  }
}

void read_scene_emitter(const Element& element, SceneDescription& scene) {
  Properties properties = open(element, {"constant", "envmap", "point", "sun"});
  const std::string type = element.text("type");
  if (type == "point") {
    scene.points.push_back(read_point(properties));
  } else if (type == "sun") {
    if (scene.sun) element.fail("a scene has one sun only");
    scene.sun = read_sun(properties);
  } else if (type == "constant") {
    if (scene.environment) element.fail("a scene has one constant <emitter> only");
    scene.environment = emission(properties, "radiance");
    properties.finish();
  } else {
    if (scene.environment_map) element.fail("a scene has one envmap <emitter> only");
    scene.environment_map = read_environment_map(properties, element.file());
  }
  if (scene.environment_map && (scene.environment || scene.sun)) {
    element.fail("an envmap is all the light from far away: no constant and no sun beside it");
  }
}

}  // namespace plumbline::renderer
