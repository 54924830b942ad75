#pragma once

#include <array>
#include <cstdint>

#include <plumbline/renderer/core/math.h>

namespace plumbline::renderer {

/// Mixes 64 bits so that neighbouring inputs give unrelated outputs.
/// @source Steele et al. 2014 (SplitMix64), finaliser of Stafford, variant 13
constexpr std::uint64_t mix_bits(std::uint64_t v) {
  v ^= v >> 30;
  v *= 0xbf58476d1ce4e5b9u;
  v ^= v >> 27;
  v *= 0x94d049bb133111ebu;
  return v ^ (v >> 31);
}

/// The 24 top bits as a number in [0, 1): rounding all 32 to float can give 1.
constexpr float to_unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

/// Independent uniform numbers (PCG32, XSH-RR). Each (seed, pixel, sample) starts its own sequence,
/// so a sample's numbers do not depend on which thread draws them or on how many passes came
/// before.
///
/// @source O'Neill 2014, Section 6.3 (pcg32)
class Pcg32 {
 public:
  Pcg32(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample) {
    const std::uint64_t key = mix_bits(mix_bits(mix_bits(seed + kGolden) + pixel) + sample);
    increment_ = mix_bits(key + kGolden) | 1u;
    state_ = key;
    next_bits();
  }

  /// Goes on where another one, of which this is the state(), has come to.
  explicit Pcg32(const std::array<std::uint64_t, 2>& state)
      : state_(state[0]), increment_(state[1]) {}
  std::array<std::uint64_t, 2> state() const { return {state_, increment_}; }

  std::uint32_t next_bits() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005u + increment_;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
    const auto rotation = static_cast<std::uint32_t>(old >> 59u);
    return (shifted >> rotation) | (shifted << ((0u - rotation) & 31u));
  }

  /// Uniform in [0, 1).
  float next_1d() { return to_unit(next_bits()); }

  Vec2f next_2d() {
    const float x = next_1d();
    return {x, next_1d()};
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15u;  // 2^64 / golden ratio

  std::uint64_t state_;
  std::uint64_t increment_;
};

}  // namespace plumbline::renderer
