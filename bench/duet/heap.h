#pragma once

#include <cstdint>

namespace plumbline::duet {

/// What this thread has asked `operator new` for since it began.
struct HeapUse {
  std::uint64_t bytes = 0, blocks = 0;
};

HeapUse heap_use();

}  // namespace plumbline::duet
