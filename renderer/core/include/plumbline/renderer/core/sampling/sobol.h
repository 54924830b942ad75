#pragma once

#include <array>
#include <cstdint>

#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/sampling/pcg32.h>

namespace plumbline::renderer {

constexpr std::uint32_t reverse_bits(std::uint32_t v) {
  v = (v >> 24) | ((v >> 8) & 0x0000ff00u) | ((v << 8) & 0x00ff0000u) | (v << 24);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v >> 4) & 0x0f0f0f0fu);
  v = ((v & 0x33333333u) << 2) | ((v >> 2) & 0x33333333u);
  return ((v & 0x55555555u) << 1) | ((v >> 1) & 0x55555555u);
}

/// Owen's scrambling in base 2 of a number with its bits reversed: each bit is flipped or not by a
/// hash of the seed and the bits below it.
///
/// @source Laine, Karras 2011 (the idea); Vegdahl 2021, "Building a better LK hash" (the constants)
constexpr std::uint32_t owen_scramble_reversed(std::uint32_t v, std::uint32_t seed) {
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= (seed >> 16) | 1u;
  v ^= v * 0x05526c56u;
  return v ^ (v * 0x53a22864u);
}

/// Second coordinate of the Sobol' sequence with its bits reversed. The first is the index itself.
/// Its matrix is Pascal's triangle mod 2: bit j is the sum of the bits k of the index whose number
/// contains all bits of j.
constexpr std::uint32_t sobol_second_reversed(std::uint32_t index) {
  index ^= (index >> 1) & 0x55555555u;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 8) & 0x00ff00ffu;
  return index ^ (index >> 16);
}

/// Points of Owen-scrambled Sobol' nets in two dimensions, padded: every call takes another net,
/// scrambled and shuffled on its own. Per call, the points 0 … 2^k − 1 are a (0, k, 2)-net in base
/// 2: one in every box of 2^−a by 2^(a−k). Across calls they are independent. Points repeat after
/// 2^32 only.
///
/// The points of one (seed, net) depend on each other: the variance of their mean shows between
/// nets with different seeds or numbers, never among the points of one.
///
/// @source Burley 2020 (JCGT 9:4), Listings 1 to 5
class SobolSampler {
 public:
  /// @param net    which set of nets: the pixel, or a replicate of it
  /// @param index  of the point, < 2^32
  SobolSampler(std::uint64_t seed, std::uint64_t net, std::uint64_t index)
      : key_(mix_bits(mix_bits(seed + kGolden) + net)),
        reversed_index_(reverse_bits(static_cast<std::uint32_t>(index))) {}

  /// Goes on where another one, of which this is the state(), has come to.
  explicit SobolSampler(const std::array<std::uint64_t, 2>& state)
      : key_(state[0]), reversed_index_(static_cast<std::uint32_t>(state[1])) {}
  std::array<std::uint64_t, 2> state() const { return {key_, reversed_index_}; }

  /// Uniform in [0, 1).
  float next_1d() {
    const Seeds seeds = next_seeds();
    return to_unit(reverse_bits(owen_scramble_reversed(shuffled_index(seeds), seeds.x)));
  }

  Vec2f next_2d() {
    const Seeds seeds = next_seeds();
    const std::uint32_t index = shuffled_index(seeds);
    const std::uint32_t x = owen_scramble_reversed(index, seeds.x);
    const std::uint32_t y = owen_scramble_reversed(sobol_second_reversed(index), seeds.y);
    return {to_unit(reverse_bits(x)), to_unit(reverse_bits(y))};
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15u;  // 2^64 / golden ratio

  struct Seeds {
    std::uint32_t index, x, y;
  };

  Seeds next_seeds() {
    key_ += kGolden;
    const std::uint64_t a = mix_bits(key_);
    return {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32),
            static_cast<std::uint32_t>((a * kGolden) >> 32)};
  }

  std::uint32_t shuffled_index(const Seeds& seeds) const {
    return reverse_bits(owen_scramble_reversed(reversed_index_, seeds.index));
  }

  std::uint64_t key_;
  std::uint32_t reversed_index_;
};

}  // namespace plumbline::renderer
