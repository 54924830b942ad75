#pragma once

#include <cstdint>
#include <type_traits>

namespace plumbline::verify {

/// Random numbers of the checks, independent of any generator under test (xoshiro256++, seeded by
/// SplitMix64).
///
/// Each (seed, stream) starts a sequence of its own.
///
/// @source Blackman, Vigna 2021, "Scrambled linear pseudorandom number generators"
///
/// A uniform random bit generator in the standard's sense: std distributions take it too.
class Random {
 public:
  using result_type = std::uint64_t;

  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) {
    std::uint64_t s = mix(seed) + stream;
    for (auto& word : state_) word = mix(s += 0x9e3779b97f4a7c15u);
  }

  std::uint64_t bits() {
    const std::uint64_t result = rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = rotl(state_[3], 45);
    return result;
  }

  static constexpr std::uint64_t min() { return 0; }
  static constexpr std::uint64_t max() { return ~std::uint64_t{0}; }
  std::uint64_t operator()() { return bits(); }

  /// Uniform in [0, 1), a multiple of 2^-53. Rounded to float it can become 1: use `uniform_float`.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Uniform in [0, 1), a multiple of 2^-24.
  float uniform_float() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }

 private:
  static std::uint64_t mix(std::uint64_t v) {
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
    return v ^ (v >> 31);
  }
  static std::uint64_t rotl(std::uint64_t v, int k) { return (v << k) | (v >> (64 - k)); }

  std::uint64_t state_[4];
};

/// Uniform in [0, 1) in the precision of T, never 1.
template <class T>
T uniform(Random& random) {
  if constexpr (std::is_same_v<T, float>) {
    return random.uniform_float();
  } else {
    return T(random.uniform());
  }
}

}  // namespace plumbline::verify
