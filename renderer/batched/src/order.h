#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#define HWY_COMPILE_ONLY_STATIC  // for the instruction set that this room is compiled for
#include <hwy/highway.h>

#include <plumbline/renderer/batched/lanes.h>

namespace plumbline::renderer {

/// to[k] = from[order[k]] for k < count; of four bytes each, up to a whole vector beyond, by an
/// instruction that compilers do without.
template <class T>
void gather(T* __restrict to, const T* __restrict from, const std::uint32_t* __restrict order,
            std::size_t count) {
  if constexpr (sizeof(T) == 4) {
    namespace hn = hwy::HWY_NAMESPACE;
    const HWY_CAPPED(T, 16) values;
    const hn::RebindToSigned<decltype(values)> indices;
    for (std::size_t k = 0; k < count; k += hn::Lanes(values)) {
      const auto at = hn::LoadU(indices, reinterpret_cast<const std::int32_t*>(order + k));
      hn::StoreU(hn::GatherIndex(values, from, at), values, to + k);
    }
  } else {
    for (std::size_t k = 0; k < count; ++k) to[k] = from[order[k]];
  }
}

/// Stable counting sort of 0 … count − 1 by key, into order(). Four parts are counted and placed
/// side by side, each by counters of its own: neighbours mostly have the same key, and one count
/// would wait until that before it is stored.
class CountingSort {
 public:
  /// @param keys  each < bins
  void sort(const IndexLanes& keys, std::size_t count, std::size_t bins) {
    ends_.assign(bins * kParts, 0);
    std::uint32_t* __restrict ends = ends_.data();
    for_each(count, [&](std::size_t i, std::size_t part) { ++ends[keys[i] * kParts + part]; });
    std::uint32_t before = 0;
    for (std::uint32_t& end : ends_) before += std::exchange(end, before);
    std::uint32_t* __restrict order = order_.data();
    for_each(count, [&](std::size_t i, std::size_t part) {
      order[ends[keys[i] * kParts + part]++] = static_cast<std::uint32_t>(i);
    });
  }

  /// Where the run of a key starts in order(), and where it ends.
  std::size_t begin(std::size_t key) const { return key == 0 ? 0 : end(key - 1); }
  std::size_t end(std::size_t key) const { return ends_[key * kParts + kParts - 1]; }
  const IndexLanes& order() const { return order_; }

 private:
  static constexpr std::size_t kParts = 4;

  /// Calls function(i, part): i in order within each part, and the parts one behind the other.
  template <class Function>
  static void for_each(std::size_t count, const Function& function) {
    const std::size_t size = count / kParts;
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t part = 0; part < kParts; ++part) function(part * size + i, part);
    }
    for (std::size_t i = size * kParts; i < count; ++i) function(i, kParts - 1);
  }

  std::vector<std::uint32_t> ends_;  // of what each part gives to the run of each key
  IndexLanes order_{};
};

}  // namespace plumbline::renderer
