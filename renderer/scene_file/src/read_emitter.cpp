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

constexpr Property<Kind::rgb> kRadiance{"radiance", kRequired, between(0, kMaxRadiance)};
constexpr Property<Kind::string> kSampling{"sampling", "area", one_of("area", "solid_angle")};
constexpr Property<Kind::boolean> kTwoSided{"two_sided", "false"};
constexpr Property<Kind::number> kScale{"scale", "1", between(0, 1e6)};
constexpr Property<Kind::boolean> kCompensation{"mis_compensation", "false"};
constexpr Property<Kind::point> kPosition{"position", "0", between(-kMaxLength, kMaxLength)};
constexpr Property<Kind::rgb> kIntensity{"intensity", kRequired, between(0, kMaxRadiance)};
constexpr Property<Kind::vector> kDirection{"direction", kRequired};
// The default is that of the disk of the sun as seen from the earth.
constexpr Property<Kind::number> kHalfAngle{"half_angle", "0.2665", between(1e-3, 90, " degrees")};

/// Refuses a second emitter of a type that a scene has once.
void allow_one(const Object& object, bool is_there) {
  if (!is_there) return;
  object.element().fail(
      fmt::format("a scene has one {} <emitter> only", object.element().text("type")));
}

void read_area(const Object& object, ShapeDescription& shape) {
  shape.radiance = object[kRadiance];
  shape.light_two_sided = object[kTwoSided];
  shape.light_by_solid_angle = object[kSampling] == "solid_angle";
  const bool rectangle = std::holds_alternative<RectangleShape>(shape.geometry);
  if (shape.light_by_solid_angle && !rectangle &&
      !std::holds_alternative<MeshShape>(shape.geometry)) {
    object.fail(kSampling, "only a rectangle or an obj can be sampled by solid_angle");
  }
  if (shape.light_two_sided && !rectangle) {
    object.fail(kTwoSided, "only a rectangle can emit from both sides");
  }
}

void read_constant(const Object& object, SceneDescription& scene) {
  allow_one(object, scene.environment.has_value());
  scene.environment = object[kRadiance];
}

void read_point(const Object& object, SceneDescription& scene) {
  scene.points.push_back({object[kPosition], object[kIntensity]});
}

void read_sun(const Object& object, SceneDescription& scene) {
  allow_one(object, scene.sun.has_value());
  const Vec3d& travels = object[kDirection];
  const double norm = length(travels);
  if (!(norm > 0 && std::isfinite(norm))) {
    object.fail(kDirection, "must have a length that is neither zero nor infinite");
  }
  scene.sun = {-travels / norm, object[kHalfAngle] * pi<double>() / 180, object[kRadiance]};
}

Image read_map(const Object& object) {
  const std::filesystem::path& file = object[kFilename];
  Image image;
  try {
    image = read_exr(file);
  } catch (const InputError& error) {
    object.fail(kFilename, error.what());
  }
  for (const Rgbf& p : image.pixels) {
    for (const float channel : {p.r, p.g, p.b}) {
      if (channel >= 0 && static_cast<double>(channel) <= kMaxRadiance) continue;
      object.fail(kFilename, fmt::format("{} holds a pixel that does not lie between 0 and {:g}",
                                         file.string(), kMaxRadiance));
    }
  }
  return image;
}

void read_environment_map(const Object& object, SceneDescription& scene) {
  allow_one(object, scene.environment_map.has_value());
  const Affine& to_world = object[kToWorld];
  if (!is_rigid(to_world)) {
    object.fail(kToWorld, "an environment may be turned and mirrored, not scaled or sheared");
  }
  Image image = read_map(object);
  scene.environment_map = {
      std::make_shared<EnvironmentTable>(image.width, image.height, std::move(image.pixels),
                                         object[kCompensation]),
      {vec_cast<float>(normalize(to_world.x)), vec_cast<float>(normalize(to_world.y)),
       vec_cast<float>(normalize(to_world.z))},
      static_cast<float>(object[kScale])};
}

}  // namespace

const ObjectTypes<void, ShapeDescription&> kAreaEmitterTypes = {
    {"area", {kRadiance, kSampling, kTwoSided}, read_area},
};

const ObjectTypes<void, SceneDescription&> kSceneEmitterTypes = {
    {"constant", {kRadiance}, read_constant},
    {"envmap", {kFilename, kScale, kToWorld, kCompensation}, read_environment_map},
    {"point", {kPosition, kIntensity}, read_point},
    {"sun", {kDirection, kHalfAngle, kRadiance}, read_sun},
};

}  // namespace plumbline::renderer
