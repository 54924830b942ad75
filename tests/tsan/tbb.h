#pragma once

#include <oneapi/tbb/parallel_for.h>
#include <sanitizer/tsan_interface.h>

/// Included before all else by the preset `tsan`. TBB's library is not instrumented, so that the
/// thread sanitizer does not see what it orders: what stands before a parallel loop comes before
/// each of its pieces, and these before what stands behind it. Said here, so that all that is left
/// is between pieces, which nothing orders.
namespace tbb {

/// @param arguments  of parallel_for, but for what is to be done with a piece
template <class Body, class... Arguments>
void parallel_for_in_order(const Body& body, const Arguments&... arguments) {
  char handed_out = 0, done = 0;
  __tsan_release(&handed_out);
  parallel_for(arguments..., [&](const auto& piece) {
    __tsan_acquire(&handed_out);
    body(piece);
    __tsan_release(&done);
  });
  __tsan_acquire(&done);
}

template <class Range, class Body>
void parallel_for_seen(const Range& range, const Body& body) {
  parallel_for_in_order(body, range);
}

template <class Index, class Body>
void parallel_for_seen(const Index& first, const Index& end, const Body& body) {
  parallel_for_in_order(body, first, end);
}

}  // namespace tbb

#define parallel_for parallel_for_seen
