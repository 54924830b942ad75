#pragma once

/// The one place that knows which Embree is installed. Version 3.13 (Debian 12) passes the query
/// state as an RTCIntersectContext; version 4 (Ubuntu 24.04) replaced it by optional argument
/// structures.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace plumbline::renderer::embree {

/// Nearest hit of one ray.
inline void intersect(RTCScene scene, RTCRayHit& ray_hit) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &ray_hit);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray_hit);
#endif
}

/// Any hit of one ray: sets `ray.tfar` to −∞ where there is one.
inline void occluded(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
}

}  // namespace plumbline::renderer::embree
