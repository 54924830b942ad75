#pragma once

#include <optional>

#include <plumbline/renderer/core/scene/embree.h>
#include <plumbline/renderer/core/scene/ray.h>

namespace plumbline::renderer {

/// Where a ray meets a primitive.
struct PrimitiveHit {
  unsigned kind, index;  ///< as Embree counts
  float u, v, t;
};

/// What answers a scene's rays in place of Embree, in Embree's own packets. A ray with a negative
/// `tfar` takes no part. The answer to a ray depends on no other of its packet.
class RayEngine {
 public:
  RayEngine() = default;
  RayEngine(const RayEngine&) = delete;
  RayEngine& operator=(const RayEngine&) = delete;
  virtual ~RayEngine() = default;

  /// Nearest hits: kind and index of the primitive, u, v and `tfar`; where there is none geomID is
  /// RTC_INVALID_GEOMETRY_ID.
  virtual void intersect(RTCRayHit16& rays) const = 0;

  /// Any hit: sets `tfar` to −∞ where there is one.
  virtual void occluded(RTCRay16& rays) const = 0;

  /// One ray, with the same bits as in a packet.
  virtual std::optional<PrimitiveHit> intersect(const Ray& ray) const = 0;
  virtual bool occluded(const Ray& ray) const = 0;
};

}  // namespace plumbline::renderer
