#pragma once

#include <cstdint>
#include <vector>

#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/core/scene/geometry.h>

namespace plumbline::tests {

/// Rays that are hard to answer among others: from a surface in any direction, within
/// 10⁻¹ … 10⁻⁶ of the plane of one, at an edge or corner or beside it by 10⁻² … 10⁻⁹, from outside.
class HardRays {
 public:
  /// @param geometry  kept, not copied
  HardRays(const renderer::SceneGeometry& geometry, std::uint64_t seed);

  renderer::Ray next();

  /// From a surface in any direction, as light travels.
  renderer::Ray ordinary();

 private:
  struct Place {
    renderer::Vec3d point, normal;
  };

  double uniform() { return static_cast<double>(random_.next_1d()); }
  /// Log-uniform.
  double size_between(double low, double high);
  renderer::Vec3d direction();
  Place place_on(unsigned kind, std::size_t index);
  Place somewhere();
  /// As rays of a render start, beside a surface on either side.
  renderer::Vec3f beside(const Place& place, double side) const;
  /// A point on the outline of something, with corners among them.
  renderer::Vec3d on_an_edge();

  const renderer::SceneGeometry& geometry_;
  renderer::Pcg32 random_;
  struct Name {
    unsigned kind;
    std::size_t index;
  };
  std::vector<Name> all_;
  double size_ = 0;  // largest coordinate
};

}  // namespace plumbline::tests
