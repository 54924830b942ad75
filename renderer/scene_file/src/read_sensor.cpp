#include <cmath>

#include "parts.h"

namespace plumbline::renderer {
namespace {

const Property kMaxDepth{kInteger, "max_depth", "-1", at_least(-1, ", which is unlimited")};
const Property kRrDepth{kInteger, "rr_depth", "5", at_least(1)};
const Property kFov{kFloat, "fov", kRequired,
                    Range{.low = 0, .high = 180, .more = " degrees", .open = true}};
const Property kFovAxis{kString, "fov_axis", "x",
                        one_of({"x", "y", "diagonal", "smaller", "larger"})};
const Property kNearClip{kFloat, "near_clip", kWithoutEffect, at_least(0)};
const Property kFarClip{kFloat, "far_clip", kWithoutEffect, kPositive};
const Property kFocusDistance{kFloat, "focus_distance", kWithoutEffect, kPositive};
const Nested kFilm{{"film"}, kRequired, between(1, 1)};
const Nested kSampler{{"sampler"}, "independent", between(0, 1)};
const Property kWidth{kInteger, "width", "768"};
const Property kHeight{kInteger, "height", "576"};
const Property kPixelFormat{kString, "pixel_format", "rgb", one_of({"rgb"})};
const Property kComponentFormat{kString, "component_format", "float32", one_of({"float32"})};
const Property kFileFormat{kString, "file_format", "openexr", one_of({"openexr"})};
const Nested kFilter{
    {"rfilter"},
    kRequired,
    between(1, 1, ": write <rfilter type=\"box\"/>, Mitsuba's default is another")};
const Property kSampleCount{kInteger, "sample_count", "4", at_least(1)};

/// Tangent of the smallest angle of a pixel: 16 times the rounding of a direction.
constexpr double kFinestPixel = 0x1p-20;

void read_path(const Object& object, Reading& in) {
  in.scene.integrator = {object[kMaxDepth], object[kRrDepth]};
}

void read_sampler(const Object& object, Reading& in) {
  in.scene.samples_per_pixel = object[kSampleCount];
}

void read_film(const Object& object, Reading& in) {
  const FilmSize size{object[kWidth], object[kHeight]};
  const std::string wrong = film_size_error(size);
  object.require(wrong.empty(), kWidth, "{}", wrong);
  read_object(object[kFilter].front(), kFilterTypes, in);
  if (!in.size) in.size = size;
}

/// tan of half the horizontal field of view, from the one along `axis`.
///
/// @param tangent  tan of half the field of view along `axis`
/// @param aspect   width over height
double horizontal_tangent(const std::string& axis, double tangent, double aspect) {
  const bool wide = aspect > 1;
  if (axis == "y" || (axis == "smaller" && wide) || (axis == "larger" && !wide)) {
    return tangent * aspect;
  }
  // The film's diagonal is √(width² + height²) in units in which the width is 1.
  if (axis == "diagonal") return tangent / std::sqrt(1 + 1 / (aspect * aspect));
  return tangent;
}

void read_perspective(const Object& object, Reading& in) {
  const Affine& to_world = object[kToWorld];
  object.require(is_rigid(to_world), kToWorld,
                 "a camera may be turned and moved, not scaled or sheared");
  object.require(is_in_range(to_world.origin), kToWorld, "the camera is too far away");
  read_object(object[kFilm].front(), kFilmTypes, in);
  if (!object.has(kSampler)) read_default(kSampler, kSamplerTypes, in);
  for (const Node sampler : object[kSampler]) read_object(sampler, kSamplerTypes, in);
  if (object.has(kNearClip)) in.clips.near = {object.at(kNearClip), object[kNearClip]};
  if (object.has(kFarClip)) in.clips.far = {object.at(kFarClip), object[kFarClip]};
  if (!in.size) return;  // the film is not good
  const double tangent = std::tan(object[kFov] * pi<double>() / 360);
  const double aspect = static_cast<double>(in.size->width) / in.size->height;
  const double pixel = 2 * horizontal_tangent(object[kFovAxis], tangent, aspect) / in.size->width;
  object.require(pixel >= kFinestPixel, kFov,
                 "makes pixels {:.2g} radians wide: single precision tells directions apart down "
                 "to {:.2g}",
                 pixel, kFinestPixel);
  in.scene.camera = {.origin = to_world.origin,
                     .left = normalize(to_world.x),
                     .up = normalize(to_world.y),
                     .forward = normalize(to_world.z),
                     .tan_half_fov_x = horizontal_tangent(object[kFovAxis], tangent, aspect),
                     .width = in.size->width,
                     .height = in.size->height};
}

}  // namespace

const Named<ObjectType> kIntegratorTypes = {
    {"path", {{kMaxDepth, kRrDepth}, read_path}},
    {"direct", {{}, [](const Object&, Reading& in) { in.scene.integrator = {.max_depth = 2}; }}},
};
const Named<ObjectType> kSensorTypes = {
    {"perspective",
     {{kFov, kFovAxis, kToWorld, kFilm, kSampler, kNearClip, kFarClip, kFocusDistance},
      read_perspective}},
};
const Named<ObjectType> kFilmTypes = {
    {"hdrfilm",
     {{kWidth, kHeight, kPixelFormat, kComponentFormat, kFileFormat, kFilter}, read_film}},
};
const Named<ObjectType> kFilterTypes = {
    {"box", {{}, [](const Object&, Reading&) {}}},  // each pixel averages its own square
};
const Named<ObjectType> kSamplerTypes = {{"independent", {{kSampleCount}, read_sampler}}};

std::string film_size_error(const FilmSize& size) {
  if (size.width >= 1 && size.width <= kMaxImageSide && size.height >= 1 &&
      size.height <= kMaxImageSide && std::int64_t{size.width} * size.height <= kMaxImagePixels) {
    return {};
  }
  return fmt::format("a film of {}x{} is not supported: sides go from 1 to {}, pixels up to {}",
                     size.width, size.height, kMaxImageSide, kMaxImagePixels);
}

}  // namespace plumbline::renderer
