#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <plumbline/renderer/core/scene/embree.h>
#include <plumbline/renderer/core/scene/ray.h>

namespace plumbline::bench {

/// Which question a ray is asked.
enum class Query { nearest, occluded };

/// Calls of Embree, one after the other, as they were made or are to be made.
class RayCalls {
 public:
  /// `rays` in calls of `width` (1, 8 or 16) neighbours each; the last one may be part empty.
  static RayCalls pack(const std::vector<renderer::Ray>& rays, Query query, int width);

  /// @param lanes  which of the call's rays are asked, bit by bit
  /// @param rays   an RTCRay, RTCRay8 or RTCRay16, as `width` says
  void add(Query query, bool coherent, int width, std::uint32_t lanes, const void* rays);

  /// Makes all calls. Denormals are flushed meanwhile, as they are when rendering.
  void replay(RTCScene scene) const;

  /// The same rays in the same order, one per call.
  RayCalls one_wide() const;

  std::size_t calls() const { return calls_.size(); }
  std::size_t rays() const { return rays_; }

 private:
  struct Call {
    Query query;
    bool coherent;
    int width;
    std::uint32_t lanes;
    std::size_t first;  // into data_
  };

  std::vector<Call> calls_;
  std::vector<float> data_;  // of each call its Embree ray structure
  std::size_t rays_ = 0;
};

/// While it exists, every call of Embree in this process is noted. Rays must come from one thread.
class RayRecording {
 public:
  explicit RayRecording(RayCalls& calls);
  ~RayRecording();
  RayRecording(const RayRecording&) = delete;
  RayRecording& operator=(const RayRecording&) = delete;
};

}  // namespace plumbline::bench
