#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/renderer/core/light/light.h>
#include "placed_shape.h"

namespace plumbline::tests {

/// A shape of a scene with what it emits.
struct PlacedEmitter {
  PlacedShape shape;
  renderer::Rgbd radiance{};  ///< [W/(m² sr)], black: no light
  bool two_sided = false;
  bool by_solid_angle = false;

  bool emits() const { return !is_black(radiance); }

  /// Whether the side that a ray along wi meets emits.
  bool emits_towards(const Meeting& meeting, const renderer::Vec3d& wi) const {
    return emits() && (two_sided || dot(meeting.normal, wi) < 0);
  }

  std::string xml() const;
};

/// The first thing on a ray.
struct FirstMet {
  std::size_t emitter;
  Meeting meeting;
};

/// Emitters around the origin, a point light and a constant environment, with what is known of
/// each before anything is rendered. Lights are numbered as the loader finds them: parts of
/// emitting shapes, the point, the environment.
struct PlacedScene {
  std::vector<PlacedEmitter> emitters;
  renderer::Vec3d point{0, -12, 1};
  renderer::Rgbd intensity{4, 2, 1};                ///< [W/sr]
  renderer::Rgbd environment{0.002, 0.001, 0.004};  ///< [W/(m² sr)]

  /// Beside `target` two lights that make selection matter, and two small black spheres beyond them
  /// that keep the origin where it is: scenes are moved to the centre of their bounding box.
  explicit PlacedScene(const PlacedEmitter& target);

  std::string xml() const;
  double radius() const;  ///< of the sphere around the bounding box [m]

  std::optional<FirstMet> first(const renderer::Vec3d& ref, const renderer::Vec3d& wi,
                                double edge = 0) const;

  /// Whether a ray passes all edges and limbs by a thousandth of the shape: beyond that, directions
  /// in float may end on the other side.
  bool clear(const renderer::Vec3d& ref, const renderer::Vec3d& wi) const;

  /// Numbers of lights.
  std::uint32_t light_of(std::size_t emitter, std::size_t part) const;
  std::uint32_t point_light() const;
  std::uint32_t environment_light() const { return point_light() + 1; }

  /// Probability of choosing a light: shapes alike, by surface or by power; parts of one by
  /// surface.
  double pmf(renderer::LightSelection selection, std::uint32_t light) const;
};

}  // namespace plumbline::tests
