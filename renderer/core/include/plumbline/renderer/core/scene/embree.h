#pragma once

/// The one place that knows which Embree is installed. Version 3.13 (Debian 12) passes the query
/// state as an RTCIntersectContext; version 4 (Ubuntu 24.04) replaced it by optional argument
/// structures.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstddef>

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

/// Rays that are traced together.
inline constexpr std::size_t kPacket = 16;

/// Whether the rays of a packet start and point alike; only a hint.
enum class Coherence { none, coherent };

/// Nearest hits of up to 16 rays.
/// @param valid  −1 for each ray that takes part, else 0
inline void intersect(RTCScene scene, const int (&valid)[kPacket], RTCRayHit16& rays,
                      Coherence coherence) {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  if (coherence == Coherence::coherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &rays, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (coherence == Coherence::coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &rays);
#endif
}

/// Any hit of up to 16 rays: sets `tfar` to −∞ where there is one.
inline void occluded(RTCScene scene, const int (&valid)[kPacket], RTCRay16& rays,
                     Coherence coherence) {
#if RTC_VERSION_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  if (coherence == Coherence::coherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &rays, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (coherence == Coherence::coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &context, &rays);
#endif
}

}  // namespace plumbline::renderer::embree
