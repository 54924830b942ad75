#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <plumbline/renderer/render/path.h>

namespace plumbline::renderer {

/// Traces many paths side by side, one stage at a time: rays by octant in packets of sixteen,
/// vertices sorted by BSDF and light, so that each stage is a loop over plain arrays. Every
/// function of BSDFs, lights and heuristics is that of `estimate_radiance`, called with the same
/// numbers in the same order: from equal hits the two give equal bits.
class BatchTracer {
 public:
  /// @return nullptr where the strategy takes more than one sample of a technique, or chooses
  ///         between them: the stages are made for at most one of each
  static std::unique_ptr<BatchTracer> make(const Scene& scene, const PathOptions& options,
                                           SamplerType sampler, std::uint64_t seed);
  virtual ~BatchTracer() = default;

  /// Starts the path of one sample of a pixel; its numbers are those of Sampler(…, net, index).
  /// Only while size() < kBatch.
  virtual void start(int x, int y, std::uint64_t net, std::uint64_t index) = 0;
  virtual std::size_t size() const = 0;

  /// Traces all paths that were started and forgets them.
  /// @return radiance of each, in the order of their start; valid until the next start
  virtual std::span<const Rgbf> trace(PathCounters& counters) = 0;

 protected:
  BatchTracer() = default;
  BatchTracer(const BatchTracer&) = delete;
  BatchTracer& operator=(const BatchTracer&) = delete;
};

}  // namespace plumbline::renderer
