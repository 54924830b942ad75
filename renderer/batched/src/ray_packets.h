#pragma once

#include <cstddef>
#include <cstdint>

#include <plumbline/renderer/batched/lanes.h>
#include <plumbline/renderer/core/scene/embree.h>
#include <plumbline/renderer/core/scene/geometry.h>

namespace plumbline::renderer {

/// Rays traced sixteen at a time: order[0] … order[count − 1], fastest where neighbours in that
/// order point alike. Results stand in that order too.
class RayPackets {
 public:
  /// @param geometry  kept, not copied
  explicit RayPackets(const SceneGeometry& geometry);

  /// What SceneGeometry::intersect finds for each ray.
  void intersect(const RayLanes& rays, const IndexLanes& order, std::size_t count,
                 HitLanes& hits) const;

  /// Sets `blocked` to 1 where anything lies on a ray before t_max, else to 0.
  void occluded(const RayLanes& rays, const Lanes<float>& t_max, const IndexLanes& order,
                std::size_t count, Lanes<std::uint8_t>& blocked) const;

 private:
  struct FlatLanes;

  void surface_hits(const RTCRayHit16& packet, const RayLanes& rays, const std::uint32_t* order,
                    std::size_t first, std::size_t count, FlatLanes& flat, HitLanes& hits) const;

  const SceneGeometry& geometry_;
  embree::Coherence coherence_ = embree::Coherence::none;
};

}  // namespace plumbline::renderer
