#include "heap.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace plumbline::duet {
namespace {

thread_local HeapUse used;

void* counted(void* block, std::size_t bytes) {
  if (block == nullptr) throw std::bad_alloc();
  used.bytes += bytes;
  ++used.blocks;
  return block;
}

}  // namespace

HeapUse heap_use() { return used; }

}  // namespace plumbline::duet

// The other forms of new and delete call these.
void* operator new(std::size_t bytes) {
  return plumbline::duet::counted(std::malloc(bytes == 0 ? 1 : bytes), bytes);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return plumbline::duet::counted(std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit),
                                  bytes);
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }
