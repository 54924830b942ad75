#include <plumbline/renderer/loop/tiles.h>

#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace plumbline::renderer {
namespace {

/// Flush-to-zero and denormals-are-zero while in scope.
class FlushToZero {
 public:
#if defined(__SSE2__)
  FlushToZero() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
  ~FlushToZero() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
#endif
};

int thread_count(int requested) {
  return requested > 0 ? requested : oneapi::tbb::info::default_concurrency();
}

}  // namespace

TileThreads::TileThreads(int threads)
    : limit_(oneapi::tbb::global_control::max_allowed_parallelism,
             static_cast<std::size_t>(thread_count(threads))),
      arena_(thread_count(threads)) {}

void TileThreads::run(int width, int height, std::size_t side,
                      const std::function<void(const Tile&)>& function) {
  using Range = oneapi::tbb::blocked_range2d<int>;
  arena_.execute([&] {
    oneapi::tbb::parallel_for(Range(0, height, side, 0, width, side), [&](const Range& range) {
      const FlushToZero flush_to_zero;
      function(
          {range.cols().begin(), range.cols().end(), range.rows().begin(), range.rows().end()});
    });
  });
}

}  // namespace plumbline::renderer
