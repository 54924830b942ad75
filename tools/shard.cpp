#include "shard.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <plumbline/output/checkpoint.h>
#include <plumbline/renderer/core/errors.h>

namespace plumbline::tools {
namespace {

/// Calls the function with the place of each pixel of a part in an image, and in the part.
template <class Function>
void for_each_pixel(const Shard& shard, std::size_t pixels, const Function& function) {
  std::size_t in_part = 0;
  for (std::size_t i = shard.number - 1; i < pixels; i += shard.count) function(i, in_part++);
}

/// Copies what each pixel has so many of.
template <class T>
void copy_pixel(const std::vector<T>& from, std::size_t i, std::vector<T>& to, std::size_t j,
                std::size_t of_each) {
  std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(i * of_each), of_each,
              to.begin() + static_cast<std::ptrdiff_t>(j * of_each));
}

/// What a pixel has several of.
struct OfEach {
  explicit OfEach(const renderer::RenderState& state)
      : moments(state.moments_per_pixel()),
        bsdf_counts(state.drawn.empty() ? 0 : state.bsdf_counts.size() / state.drawn.size()) {}
  std::size_t moments, bsdf_counts;
};

void copy(const renderer::RenderState& from, std::size_t i, renderer::RenderState& to,
          std::size_t j, const OfEach& each) {
  to.drawn[j] = from.drawn[i];
  copy_pixel(from.moments, i, to.moments, j, each.moments);
  copy_pixel(from.bsdf_counts, i, to.bsdf_counts, j, each.bsdf_counts);
}

/// A part without samples, of the size that it has in such a state.
renderer::RenderState empty_part(const Shard& shard, const renderer::RenderState& state) {
  const std::size_t pixels = state.drawn.size();
  const std::size_t first = shard.number - 1;
  const std::size_t size = first < pixels ? (pixels - first - 1) / shard.count + 1 : 0;
  const OfEach each(state);
  renderer::RenderState part;
  part.width = static_cast<int>(size);
  part.height = 1;
  part.nets = state.nets;
  part.drawn.resize(size);
  part.moments.resize(size * each.moments);
  part.bsdf_counts.resize(size * each.bsdf_counts);
  return part;
}

}  // namespace

void keep_only(const Shard& shard, renderer::RenderState& state) {
  for (std::size_t i = 0; i < state.drawn.size(); ++i) {
    if (!shard.has(i)) state.drawn[i] = output::kElsewhere;
  }
}

renderer::RenderState taken_out(const Shard& shard, const renderer::RenderState& state) {
  renderer::RenderState part = empty_part(shard, state);
  const OfEach each(state);
  for_each_pixel(shard, state.drawn.size(),
                 [&](std::size_t i, std::size_t j) { copy(state, i, part, j, each); });
  part.counters = state.counters;
  part.seconds = state.seconds;
  return part;
}

void put_back(const Shard& shard, const renderer::RenderState& part, renderer::RenderState& state) {
  const renderer::RenderState expected = empty_part(shard, state);
  if (part.drawn.size() != expected.drawn.size() ||
      part.moments.size() != expected.moments.size() ||
      part.bsdf_counts.size() != expected.bsdf_counts.size()) {
    throw renderer::InputError("a part of another render came");
  }
  const OfEach each(state);
  for_each_pixel(shard, state.drawn.size(),
                 [&](std::size_t i, std::size_t j) { copy(part, j, state, i, each); });
}

}  // namespace plumbline::tools
