#pragma once

#include <algorithm>
#include <limits>

#include "pair_support.h"

/// Choices and angles that the pairs of the fifth set share.
namespace plumbline::tests::corpus::fifth {

template <class T>
T short_of_one(T u) {
  return std::clamp(u, T(0), 1 - std::numeric_limits<T>::epsilon() / 2);
}

/// One of several after their weights, by a sum from the first on and a search.
template <class T>
class Choice {
 public:
  explicit Choice(const std::vector<T>& weights) : below_(1, T(0)) {
    for (const T w : weights) below_.push_back(below_.back() + w);
    const T all = below_.back();
    for (T& b : below_) b /= all;
  }
  int count() const { return static_cast<int>(below_.size()) - 1; }
  T probability(int i) const { return at(below_, i + 1) - at(below_, i); }
  T before(int i) const { return at(below_, i); }
  int index(T u) const {
    const auto above = std::upper_bound(below_.begin() + 1, below_.end() - 1, u);
    return static_cast<int>(above - below_.begin()) - 1;
  }
  /// What is left of u within its part, in [0, 1) again.
  T left(T u, int i) const { return short_of_one((u - before(i)) / probability(i)); }

 private:
  std::vector<T> below_;
};

/// Share of a turn from 0 to 1.
template <class T>
T share_of_turn(T across, T along) {
  const T t = std::atan2(across, along) / (2 * pi_v<T>);
  return t < 0 ? t + 1 : t;
}

template <class T>
Xyz<T> at_height(T z, T phi) {
  const T r = std::sqrt(std::max(T(0), (1 - z) * (1 + z)));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace plumbline::tests::corpus::fifth
