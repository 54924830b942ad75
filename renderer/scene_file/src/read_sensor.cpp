#include <fmt/format.h>

#include <cmath>
#include <string>

#include "read_parts.h"

namespace plumbline::renderer {
namespace {

constexpr Property<Kind::integer> kMaxDepth{"max_depth", "-1",
                                            at_least(-1, ", which is unlimited")};
constexpr Property<Kind::integer> kRrDepth{"rr_depth", "5", at_least(1)};
constexpr Property<Kind::number> kFov{
    "fov", kRequired, {.low = 0, .high = 180, .more = " degrees", .open = true}};
constexpr Property<Kind::string> kFovAxis{"fov_axis", "x",
                                          one_of("x", "y", "diagonal", "smaller", "larger")};
constexpr Property<Kind::nested> kFilm{"film", kRequired};
constexpr Property<Kind::nested> kSampler{"sampler", "independent"};
constexpr Property<Kind::integer> kWidth{"width", "768"};
constexpr Property<Kind::integer> kHeight{"height", "576"};
constexpr Property<Kind::string> kPixelFormat{"pixel_format", "rgb", one_of("rgb")};
constexpr Property<Kind::string> kComponentFormat{"component_format", "float32", one_of("float32")};
constexpr Property<Kind::nested> kFilter{"rfilter", kRequired};
constexpr Property<Kind::integer> kSampleCount{"sample_count", "4", at_least(1)};

IntegratorDescription read_path(const Object& object) {
  return {object[kMaxDepth], object[kRrDepth]};
}

IntegratorDescription read_direct(const Object&) { return {.max_depth = 2}; }

int read_sampler(const Object& object) { return object[kSampleCount]; }

void read_filter(const Object&) {}  // each pixel averages its own square

FilmSize read_film(const Object& object) {
  const FilmSize size{object[kWidth], object[kHeight]};
  const std::string wrong = film_size_error(size);
  if (!wrong.empty()) object.fail(kWidth, wrong);
  kFilterTypes.read(object[kFilter].front());
  return size;
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

void read_perspective(const Object& object, std::optional<FilmSize> size, SceneDescription& scene) {
  const Affine& to_world = object[kToWorld];
  if (!is_rigid(to_world)) {
    object.fail(kToWorld, "a camera may be turned and moved, not scaled or sheared");
  }
  if (!is_in_range(to_world.origin)) object.fail(kToWorld, "the camera is too far away");
  const FilmSize in_file = kFilmTypes.read(object[kFilm].front());
  const FilmSize used = size.value_or(in_file);
  const std::vector<Element>& samplers = object[kSampler];
  scene.samples_per_pixel =
      samplers.empty() ? object.absent(kSampleCount) : kSamplerTypes.read(samplers.front());
  const double tangent = std::tan(object[kFov] * pi<double>() / 360);
  scene.camera = {.origin = to_world.origin,
                  .left = normalize(to_world.x),
                  .up = normalize(to_world.y),
                  .forward = normalize(to_world.z),
                  .tan_half_fov_x = horizontal_tangent(
                      object[kFovAxis], tangent, static_cast<double>(used.width) / used.height),
                  .width = used.width,
                  .height = used.height};
}

}  // namespace

const ObjectTypes<IntegratorDescription> kIntegratorTypes = {
    {"path", {kMaxDepth, kRrDepth}, read_path},
    {"direct", {}, read_direct},
};

const ObjectTypes<void, std::optional<FilmSize>, SceneDescription&> kSensorTypes = {
    {"perspective", {kFov, kFovAxis, kToWorld, kFilm, kSampler}, read_perspective},
};

const ObjectTypes<FilmSize> kFilmTypes = {
    {"hdrfilm", {kWidth, kHeight, kPixelFormat, kComponentFormat, kFilter}, read_film},
};

const ObjectTypes<void> kFilterTypes = {{"box", {}, read_filter}};

const ObjectTypes<int> kSamplerTypes = {{"independent", {kSampleCount}, read_sampler}};

std::string film_size_error(const FilmSize& size) {
  constexpr int kMaxSide = 1 << 16;
  constexpr long long kMaxPixels = 1LL << 26;  // at 56 bytes each, 3.5 GB of moments
  if (size.width >= 1 && size.width <= kMaxSide && size.height >= 1 && size.height <= kMaxSide &&
      static_cast<long long>(size.width) * size.height <= kMaxPixels) {
    return {};
  }
  return fmt::format("a film of {}x{} is not supported: sides go from 1 to {}, pixels up to {}",
                     size.width, size.height, kMaxSide, kMaxPixels);
}

}  // namespace plumbline::renderer
