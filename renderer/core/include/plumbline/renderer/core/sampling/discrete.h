#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <plumbline/renderer/core/math.h>

namespace plumbline::renderer {

/// Choice of one of N by weight.
///
/// Probabilities are whole multiples of 2⁻²⁴, the resolution of the random numbers in float, and at
/// least one where the weight is positive: what `pmf` says is exactly how often `sample` chooses,
/// also for a choice a million times less likely than another.
class DiscreteDistribution {
 public:
  DiscreteDistribution() = default;

  /// @param weights  N ≤ 2²⁴ finite weights ≥ 0; all 0: every choice is equally likely
  explicit DiscreteDistribution(std::span<const double> weights);

  std::uint32_t size() const { return static_cast<std::uint32_t>(bounds_.size() - 1); }

  template <class T>
  struct Choice {
    std::uint32_t index;  ///< in [0, N)
    T pmf;                ///< [1]
    T u;                  ///< uniform in [0, 1) again, independent of the choice
  };

  /// @param u  in [0, 1); increasing u chooses increasing indices, which keeps it stratified
  template <class T>
  Choice<T> sample(const T& u) const {
    const std::uint32_t index = index_at(u);
    const T p = pmf<T>(index);
    const T one_minus_ulp = T(1) - std::numeric_limits<T>::epsilon() / T(2);
    return {index, p, std::min(T((u - T(bounds_[index])) / p), one_minus_ulp)};
  }

  /// @return probability [1] that `sample` chooses `index`; 0 for one beyond N
  template <class T>
  T pmf(std::uint32_t index) const {
    if (index >= size()) return T(0);
    return T(bounds_[index + 1]) - T(bounds_[index]);
  }

 private:
  /// How many of the inner bounds u has passed. Where they are few all are asked: which way a
  /// search would turn cannot be predicted.
  template <class T>
  std::uint32_t index_at(const T& u) const {
    constexpr std::uint32_t kFew = 16;
    if (size() <= kFew) {
      std::uint32_t passed = 0;
      for (std::uint32_t i = 1; i < size(); ++i) passed += u < T(bounds_[i]) ? 0u : 1u;
      return passed;
    }
    const auto above = std::upper_bound(bounds_.begin() + 1, bounds_.end() - 1, u,
                                        [](const T& x, float bound) { return x < T(bound); });
    return static_cast<std::uint32_t>(above - bounds_.begin()) - 1;
  }

  std::vector<float> bounds_{0.0f};  // N + 1, from 0 to 1: the cumulative probabilities
};

}  // namespace plumbline::renderer
