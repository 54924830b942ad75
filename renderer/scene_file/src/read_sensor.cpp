#include <fmt/format.h>

#include <cmath>
#include <string>

#include "read_parts.h"

namespace plumbline::renderer {
namespace {

constexpr int kMitsubaSampleCount = 4;

int read_sampler(const Element& element) {
  element.allow_attributes({"type", "id", "name"});
  element.type();
  element.file().register_id(element);
  Properties properties(element);
  const int sample_count = properties.integer("sample_count", kMitsubaSampleCount);
  properties.finish();
  if (sample_count < 1) properties.fail("sample_count", "must be at least 1");
  return sample_count;
}

FilmSize read_film(const Element& element) {
  element.allow_attributes({"type", "id", "name"});
  element.type();
  element.file().register_id(element);
  Properties properties(element);
  const FilmSize size{properties.integer("width", 768), properties.integer("height", 576)};
  const std::string pixels = properties.string("pixel_format", "rgb");
  const std::string components = properties.string("component_format", "float32");
  const std::optional<Element> filter = properties.required_object("rfilter");
  properties.finish();
  if (pixels != "rgb") properties.fail("pixel_format", "only \"rgb\" is supported");
  if (components != "float32") {
    properties.fail("component_format", "only \"float32\" is supported");
  }
  const std::string wrong = film_size_error(size);
  if (!wrong.empty()) properties.fail("width", wrong);
  filter->allow_attributes({"type", "id", "name"});
  filter->type();
  filter->file().register_id(*filter);
  Properties(*filter).finish();
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

}  // namespace

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

void read_sensor(const Element& element, std::optional<FilmSize> size, SceneDescription& scene) {
  element.allow_attributes({"type", "id", "name"});
  element.type();
  element.file().register_id(element);
  Properties properties(element);
  const double fov = properties.number("fov");
  const std::string axis = properties.string("fov_axis", "x");
  const Affine to_world = properties.transform("to_world");
  const std::optional<Element> film = properties.required_object("film");
  const std::optional<Element> sampler = properties.object("sampler");
  properties.finish();

  if (!(fov > 0 && fov < 180)) {
    properties.fail("fov", "must lie between 0 and 180 degrees, both excluded");
  }
  if (axis != "x" && axis != "y" && axis != "diagonal" && axis != "smaller" && axis != "larger") {
    properties.fail("fov_axis", "must be x, y, diagonal, smaller or larger");
  }
  if (!is_rigid(to_world)) {
    properties.fail("to_world", "a camera may be turned and moved, not scaled or sheared");
  }
  if (!is_in_range(to_world.origin)) properties.fail("to_world", "the camera is too far away");
  const FilmSize in_file = read_film(*film);
  const FilmSize used = size.value_or(in_file);
  scene.samples_per_pixel = sampler ? read_sampler(*sampler) : kMitsubaSampleCount;

  const double tangent = std::tan(fov * pi<double>() / 360);
  scene.camera = {.origin = to_world.origin,
                  .left = normalize(to_world.x),
                  .up = normalize(to_world.y),
                  .forward = normalize(to_world.z),
                  .tan_half_fov_x = horizontal_tangent(
                      axis, tangent, static_cast<double>(used.width) / used.height),
                  .width = used.width,
                  .height = used.height};
}

IntegratorDescription read_integrator(const Element& element) {
  element.allow_attributes({"type", "id", "name"});
  const std::string type = element.type();
  element.file().register_id(element);
  Properties properties(element);
  IntegratorDescription integrator;
  if (type == "direct") {
    integrator.max_depth = 2;
    properties.finish();
    return integrator;
  }
  integrator.max_depth = properties.integer("max_depth", integrator.max_depth);
  integrator.rr_depth = properties.integer("rr_depth", integrator.rr_depth);
  properties.finish();
  if (integrator.max_depth < -1) {
    properties.fail("max_depth", "must be -1 (unlimited) or at least 0");
  }
  if (integrator.rr_depth < 1) properties.fail("rr_depth", "must be at least 1");
  return integrator;
}

}  // namespace plumbline::renderer
