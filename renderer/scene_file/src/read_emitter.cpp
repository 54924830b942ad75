#include <algorithm>

#include <plumbline/renderer/image_io/exr.h>

#include "parts.h"

namespace plumbline::renderer {
namespace {

constexpr double kMaxRadiance =
    1e15;  // squares of ten thousand times it are finite in single precision
constexpr double kMaxIntensity = 1e30;  // sums of it are
constexpr double kDarkest = 1e-30;      // products of less with what a BSDF reflects may vanish

const Property kRadiance{kRgb, "radiance", kRequired, between(0, kMaxRadiance)};
const Property kSampling{kString, "sampling", "area", one_of({"area", "solid_angle"})};
const Property kTwoSided{kBoolean, "two_sided", "false"};
const Property kScale{kFloat, "scale", "1", between(0, 1e6)};
const Property kCompensation{kBoolean, "mis_compensation", "false"};
const Property kPosition{kPoint, "position", "0", between(-kMaxLength, kMaxLength)};
const Property kIntensity{kRgb, "intensity", kRequired, between(0, kMaxIntensity)};
const Property kDirection{kVector, "direction", kRequired};
// The default is that of the disk of the sun as seen from the earth.
const Property kHalfAngle{kFloat, "half_angle", "0.2665", between(1e-3, 90, " degrees")};

/// Refuses a second emitter of a type that a scene has once.
void allow_one(const Object& object, bool is_there) {
  if (!is_there) return;
  refuse(object.node(), "a scene has one {} <emitter> only", attribute(object.node(), "type"));
}

/// Single precision would make black of it, or a variance that is not finite.
void check_dark(const Object& object, const Property<Rgbd>& property) {
  const Rgbd& c = object[property];
  for (const double channel : {c.r, c.g, c.b}) {
    object.require(channel == 0 || channel >= kDarkest, property,
                   "is neither 0 nor at least {:g}, and would be black in single precision",
                   kDarkest);
  }
}

void read_area(const Object& object, Reading& in) {
  ShapeDescription& shape = in.scene.shapes.back();
  check_dark(object, kRadiance);
  shape.radiance = object[kRadiance];
  shape.light_two_sided = object[kTwoSided];
  shape.light_by_solid_angle = object[kSampling] == "solid_angle";
  const bool rectangle = std::holds_alternative<RectangleShape>(shape.geometry);
  const bool mesh = std::holds_alternative<MeshShape>(shape.geometry);
  object.require(rectangle || mesh || !shape.light_by_solid_angle, kSampling,
                 "only a rectangle or an obj can be sampled by solid_angle");
  object.require(rectangle || !shape.light_two_sided, kTwoSided,
                 "only a rectangle can emit from both sides");
}

void read_constant(const Object& object, Reading& in) {
  allow_one(object, in.scene.environment.has_value());
  check_dark(object, kRadiance);
  in.scene.environment = object[kRadiance];
}

void read_point(const Object& object, Reading& in) {
  check_dark(object, kIntensity);
  in.scene.points.push_back({object[kPosition], object[kIntensity]});
  in.place(object.node(), in.scene.points.back());
}

void read_sun(const Object& object, Reading& in) {
  allow_one(object, in.scene.sun.has_value());
  check_dark(object, kRadiance);
  const Vec3d travels = unit_vector(object.at(kDirection), object[kDirection],
                                    "must have a length that is neither zero nor infinite");
  in.scene.sun = {-travels, object[kHalfAngle] * pi<double>() / 180, object[kRadiance]};
}

Image read_map(const Object& object, Reading& in) {
  const std::filesystem::path file = file_of(object, in);
  in.scene.files.push_back(file);
  Image image;
  try {
    image = read_exr(file);
  } catch (const InputError& error) {
    fail(object.at(kFilename), "{}", error.what());
  }
  for (const Rgbf& p : image.pixels) {
    for (const float channel : {p.r, p.g, p.b}) {
      const double scaled = static_cast<double>(channel) * std::max(object[kScale], 1.0);
      if (channel >= 0 && scaled <= kMaxRadiance) continue;
      fail(object.at(kFilename), "{} holds a pixel that, scaled, does not lie between 0 and {:g}",
           file.string(), kMaxRadiance);
    }
  }
  return image;
}

void read_environment_map(const Object& object, Reading& in) {
  allow_one(object, in.scene.environment_map.has_value());
  const Affine& to_world = object[kToWorld];
  object.require(is_rigid(to_world), kToWorld,
                 "an environment may be turned and mirrored, not scaled or sheared");
  Image image = read_map(object, in);
  in.scene.environment_map = {
      std::make_shared<EnvironmentTable>(image.width, image.height, std::move(image.pixels),
                                         object[kCompensation]),
      {vec_cast<float>(normalize(to_world.x)), vec_cast<float>(normalize(to_world.y)),
       vec_cast<float>(normalize(to_world.z))},
      static_cast<float>(object[kScale])};
}

}  // namespace

const Named<ObjectType> kAreaEmitterTypes = {
    {"area", {{kRadiance, kSampling, kTwoSided}, read_area}},
};

const Named<ObjectType> kSceneEmitterTypes = {
    {"constant", {{kRadiance}, read_constant}},
    {"envmap", {{kFilename, kScale, kToWorld, kCompensation}, read_environment_map}},
    {"point", {{kPosition, kIntensity}, read_point}},
    {"sun", {{kDirection, kHalfAngle, kRadiance}, read_sun}},
};

}  // namespace plumbline::renderer
