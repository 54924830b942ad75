#include "ray_calls.h"

#include <cstring>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

// The linker leads the renderer's calls of rtc… to __wrap_rtc…, and __real_rtc… to Embree
// (--wrap, see CMakeLists.txt): a recording needs nothing of the renderer.
// NOLINTBEGIN(bugprone-macro-parentheses)
#if RTC_VERSION_MAJOR >= 4
using IntersectState = RTCIntersectArguments;
using OccludedState = RTCOccludedArguments;
#define PLUMBLINE_PARAMETERS(Rays, State) Rays *rays, State *state
#define PLUMBLINE_ARGUMENTS rays, state
#else
using IntersectState = RTCIntersectContext;
using OccludedState = RTCIntersectContext;
#define PLUMBLINE_PARAMETERS(Rays, State) State *state, Rays *rays
#define PLUMBLINE_ARGUMENTS state, rays
#endif
// NOLINTEND(bugprone-macro-parentheses)

namespace plumbline::bench {
namespace {

RayCalls* recorded_calls = nullptr;

template <class State>
bool is_coherent(const State* state) {
#if RTC_VERSION_MAJOR >= 4
  return state != nullptr && (state->flags & RTC_RAY_QUERY_FLAG_COHERENT) != 0;
#else
  return (state->flags & RTC_INTERSECT_CONTEXT_FLAG_COHERENT) != 0;
#endif
}

void init(IntersectState& intersect, OccludedState& occluded, bool coherent) {
#if RTC_VERSION_MAJOR >= 4
  rtcInitIntersectArguments(&intersect);
  rtcInitOccludedArguments(&occluded);
  if (coherent) intersect.flags = occluded.flags = RTC_RAY_QUERY_FLAG_COHERENT;
#else
  rtcInitIntersectContext(&intersect);
  if (coherent) intersect.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  occluded = intersect;
#endif
}

template <class State>
void note(Query query, const State* state, int width, const int* valid, const void* rays) {
  if (recorded_calls == nullptr) return;
  std::uint32_t lanes = 0;
  for (int i = 0; i < width; ++i) {
    if (valid == nullptr || valid[i] != 0) lanes |= 1u << i;
  }
  recorded_calls->add(query, is_coherent(state), width, lanes, rays);
}

}  // namespace
}  // namespace plumbline::bench

// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
extern "C" {
#define PLUMBLINE_WRAP_PACKETS(width)                                                       \
  void __real_rtcIntersect##width(const int*, RTCScene,                                     \
                                  PLUMBLINE_PARAMETERS(RTCRayHit##width, IntersectState));  \
  void __wrap_rtcIntersect##width(const int* valid, RTCScene scene,                         \
                                  PLUMBLINE_PARAMETERS(RTCRayHit##width, IntersectState)) { \
    using plumbline::bench::Query;                                                          \
    plumbline::bench::note(Query::nearest, state, width, valid, &rays->ray);                \
    __real_rtcIntersect##width(valid, scene, PLUMBLINE_ARGUMENTS);                          \
  }                                                                                         \
  void __real_rtcOccluded##width(const int*, RTCScene,                                      \
                                 PLUMBLINE_PARAMETERS(RTCRay##width, OccludedState));       \
  void __wrap_rtcOccluded##width(const int* valid, RTCScene scene,                          \
                                 PLUMBLINE_PARAMETERS(RTCRay##width, OccludedState)) {      \
    plumbline::bench::note(plumbline::bench::Query::occluded, state, width, valid, rays);   \
    __real_rtcOccluded##width(valid, scene, PLUMBLINE_ARGUMENTS);                           \
  }

PLUMBLINE_WRAP_PACKETS(8)
PLUMBLINE_WRAP_PACKETS(16)

void __real_rtcIntersect1(RTCScene, PLUMBLINE_PARAMETERS(RTCRayHit, IntersectState));
void __wrap_rtcIntersect1(RTCScene scene, PLUMBLINE_PARAMETERS(RTCRayHit, IntersectState)) {
  plumbline::bench::note(plumbline::bench::Query::nearest, state, 1, nullptr, &rays->ray);
  __real_rtcIntersect1(scene, PLUMBLINE_ARGUMENTS);
}
void __real_rtcOccluded1(RTCScene, PLUMBLINE_PARAMETERS(RTCRay, OccludedState));
void __wrap_rtcOccluded1(RTCScene scene, PLUMBLINE_PARAMETERS(RTCRay, OccludedState)) {
  plumbline::bench::note(plumbline::bench::Query::occluded, state, 1, nullptr, rays);
  __real_rtcOccluded1(scene, PLUMBLINE_ARGUMENTS);
}
}
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)

namespace plumbline::bench {
namespace {

constexpr std::size_t kFields = sizeof(RTCRay) / sizeof(float);  // in the same order at any width

struct QueryState {
  IntersectState intersect{};
  OccludedState occluded{};

  explicit QueryState(bool coherent) { init(intersect, occluded, coherent); }
};

void ask(RTCScene scene, const int*, RTCRayHit* rays, IntersectState* state) {
  __real_rtcIntersect1(scene, PLUMBLINE_ARGUMENTS);
}
void ask(RTCScene scene, const int*, RTCRay* rays, OccludedState* state) {
  __real_rtcOccluded1(scene, PLUMBLINE_ARGUMENTS);
}
void ask(RTCScene scene, const int* valid, RTCRayHit8* rays, IntersectState* state) {
  __real_rtcIntersect8(valid, scene, PLUMBLINE_ARGUMENTS);
}
void ask(RTCScene scene, const int* valid, RTCRay8* rays, OccludedState* state) {
  __real_rtcOccluded8(valid, scene, PLUMBLINE_ARGUMENTS);
}
void ask(RTCScene scene, const int* valid, RTCRayHit16* rays, IntersectState* state) {
  __real_rtcIntersect16(valid, scene, PLUMBLINE_ARGUMENTS);
}
void ask(RTCScene scene, const int* valid, RTCRay16* rays, OccludedState* state) {
  __real_rtcOccluded16(valid, scene, PLUMBLINE_ARGUMENTS);
}

/// Makes one call; both kinds start from the same structure, so that their preparation costs alike.
template <class RayHit, std::size_t kWidth>
void make_call(RTCScene scene, Query query, std::uint32_t lanes, const float* data,
               QueryState& state) {
  RayHit packet;
  std::memcpy(&packet.ray, data, sizeof packet.ray);
  alignas(64) int valid[kWidth];
  for (std::size_t i = 0; i < kWidth; ++i) valid[i] = (lanes >> i & 1u) != 0 ? -1 : 0;
  if (query == Query::occluded) {
    ask(scene, valid, &packet.ray, &state.occluded);
  } else {
    std::memset(&packet.hit, 0xff, sizeof packet.hit);  // RTC_INVALID_GEOMETRY_ID
    ask(scene, valid, &packet, &state.intersect);
  }
}

}  // namespace

RayCalls RayCalls::pack(const std::vector<renderer::Ray>& rays, Query query, int width) {
  RayCalls result;
  const auto lanes = static_cast<std::size_t>(width);
  std::vector<float> packet(kFields * lanes);
  for (std::size_t first = 0; first < rays.size(); first += lanes) {
    std::uint32_t valid = 0;
    for (std::size_t i = 0; i < lanes && first + i < rays.size(); ++i) {
      const renderer::Ray& ray = rays[first + i];
      const std::uint32_t mask = ~0u;
      const float fields[] = {ray.origin.x,
                              ray.origin.y,
                              ray.origin.z,
                              0,
                              ray.direction.x,
                              ray.direction.y,
                              ray.direction.z,
                              0,
                              ray.t_max,
                              0,
                              0,
                              0};
      for (std::size_t f = 0; f < kFields; ++f) packet[f * lanes + i] = fields[f];
      std::memcpy(&packet[9 * lanes + i], &mask, sizeof mask);
      valid |= 1u << i;
    }
    result.add(query, false, width, valid, packet.data());
  }
  return result;
}

void RayCalls::add(Query query, bool coherent, int width, std::uint32_t lanes, const void* rays) {
  const std::size_t first = data_.size();
  data_.resize(first + kFields * static_cast<std::size_t>(width));
  std::memcpy(&data_[first], rays, sizeof(RTCRay) * static_cast<std::size_t>(width));
  calls_.push_back({query, coherent, width, lanes, first});
  for (; lanes != 0; lanes &= lanes - 1) ++rays_;
}

void RayCalls::replay(RTCScene scene) const {
#if defined(__SSE2__)
  const unsigned saved = _mm_getcsr();
  _mm_setcsr(saved | 0x8040u);
#endif
  QueryState states[] = {QueryState(false), QueryState(true)};
  for (const Call& call : calls_) {
    QueryState& state = states[call.coherent ? 1 : 0];
    const float* data = &data_[call.first];
    if (call.width == 1) {
      make_call<RTCRayHit, 1>(scene, call.query, call.lanes, data, state);
    } else if (call.width == 8) {
      make_call<RTCRayHit8, 8>(scene, call.query, call.lanes, data, state);
    } else {
      make_call<RTCRayHit16, 16>(scene, call.query, call.lanes, data, state);
    }
  }
#if defined(__SSE2__)
  _mm_setcsr(saved);
#endif
}

RayCalls RayCalls::one_wide() const {
  RayCalls result;
  float ray[kFields];
  for (const Call& call : calls_) {
    const auto width = static_cast<std::size_t>(call.width);
    for (std::size_t i = 0; i < width; ++i) {
      if ((call.lanes >> i & 1u) == 0) continue;
      for (std::size_t f = 0; f < kFields; ++f) ray[f] = data_[call.first + f * width + i];
      result.add(call.query, false, 1, 1, ray);
    }
  }
  return result;
}

RayRecording::RayRecording(RayCalls& calls) { recorded_calls = &calls; }
RayRecording::~RayRecording() { recorded_calls = nullptr; }

}  // namespace plumbline::bench
