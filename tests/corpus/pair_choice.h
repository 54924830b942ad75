#pragma once

#include <array>

#include "pair_lights.h"
#include "pair_maps.h"
#include "pair_support.h"

/// Choosing one of many lights: probabilities, and densities over all of them.
namespace plumbline::tests::corpus {

/// Powers from dim to bright over three decades; each seventh lamp is switched off.
template <class T>
std::vector<T> lamp_powers(int n) {
  std::vector<T> powers;
  for (int i = 0; i < n; ++i) {
    powers.push_back(i % 7 == 3 ? T(0) : std::pow(T(10), static_cast<T>(i * 5 % 13) / 4 - 1));
  }
  return powers;
}

/// In proportion to power, by the cumulative distribution.
template <class T>
struct LightsByPower {
  int fault;
  PiecewiseConstant<T> table;

  LightsByPower(int n, int which) : fault(which), table(lamp_powers<T>(n)) {}
  int sample(T u) const {
    int i = 0;
    table.sample(u, i);
    return i;
  }
  T pdf(int i) const {
    const T n = static_cast<T>(table.size());
    if (fault == 1) return 1 / n;
    if (fault == 2) return at(table.f, (i + 1) % table.size()) / (table.integral * n);
    if (fault == 3) return at(table.f, i) / table.integral;
    return at(table.f, i) / (table.integral * n);
  }
};

/// In proportion to power, by the alias method. `fault` as in AliasTable.
template <class T>
struct LightsByAlias {
  int fault;
  AliasTable<T> table;

  LightsByAlias(int n, int which) : fault(which), table(lamp_powers<T>(n)) {}
  int sample(T u) const {
    T left = 0;
    return fault == 2 ? cell_of(u, table.size()) : table.sample(u, left, fault);
  }
  T pdf(int i) const { return at(table.p, i); }
};

/// A complete binary tree over 2^depth lights, importance power/distance² of each node's bounds.
/// One number is stretched from level to level; the probability follows the way down.
///
/// @source Conty Estevez, Kulla 2018 (HPG), "Importance Sampling of Many Lights", §5.3
template <class T>
struct LightTree {
  int fault;
  int depth;
  std::vector<T> importance;  ///< of node 1 (root), 2, 3, …: children of k are 2k and 2k + 1

  LightTree(int levels, int which) : fault(which), depth(levels) {
    const int leaves = 1 << depth;
    importance = zeros<T>(2 * leaves);
    for (int k = 2 * leaves - 1; k > 0; --k) {
      // Bounds of a node are a little too large, so that its importance is not its children's sum.
      const T d = T(0.6) + static_cast<T>(k * 11 % 17) / 10;
      const T power = k >= leaves ? T(1) + static_cast<T>(k * 7 % 5)
                                  : at(importance, 2 * k) + at(importance, 2 * k + 1);
      ref(importance, k) = power / (d * d);
    }
  }
  T left_share(int node) const {
    const T l = at(importance, 2 * node), r = at(importance, 2 * node + 1);
    return l / (l + r);
  }
  int sample(T u) const {
    int node = 1;
    for (int level = 0; level < depth; ++level) {
      const T p = left_share(node);
      const bool left = u < p;
      if (fault != 3) {
        u = left ? u / p : (u - p) / (1 - p);
        u = std::min(u, 1 - std::numeric_limits<T>::epsilon() / 2);
      }
      node = 2 * node + (left ? 0 : 1);
    }
    return node - (1 << depth);
  }
  T pdf(int light) const {
    int node = 1;
    T probability = 1;
    for (int level = 0; level < depth; ++level) {
      const bool left = (light >> (depth - 1 - level)) % 2 == 0;
      const T p = left_share(node);
      if (!(fault == 1 && level == 0)) probability *= left || fault == 2 ? p : 1 - p;
      node = 2 * node + (left ? 0 : 1);
    }
    return probability;
  }
};

/// One of a stream of candidates, each kept with its share of the weight so far.
///
/// @source Chao 1982; as in Wyman 2021 (Ray Tracing Gems II, ch. 22), "Weighted Reservoir Sampling"
template <class T>
struct Reservoir {
  int fault;
  std::vector<T> weights;

  int sample(Random& random) const {
    T sum = 0;
    int chosen = 0;
    for (int i = 0; i < static_cast<int>(weights.size()); ++i) {
      const T w = at(weights, i), before = sum;
      sum += w;
      const T share = fault == 1 ? (i == 0 ? T(1) : w / (before + 2 * w)) : w / sum;
      if (w > 0 && verify::uniform<T>(random) < share) chosen = i;
    }
    return chosen;
  }
  T pdf(int i) const {
    T sum = 0;
    for (const T w : weights) sum += w;
    return (fault == 2 ? T(1) : at(weights, i)) / sum;
  }
};

/// Next-event estimation over several sphere lights as one technique: the light by its power with
/// a number that is then used again, a direction in its cone. Two of the cones overlap.
template <class T>
struct AllLights {
  int fault;
  std::vector<T> share;
  std::vector<Cone<T>> cones;

  explicit AllLights(int which, bool equal = false) : fault(which) {
    const std::array<T, 5> powers{1, 6, 2, 8, 3};
    const std::array<Xyz<T>, 5> centres{{{1, 0, 2},
                                         {T(-1.5), 1, 1},
                                         {T(1.3), T(0.2), T(2.1)},
                                         {0, -2, T(0.3)},
                                         {T(-1), T(-1), -2}}};
    const std::array<T, 5> radii{T(0.5), T(0.3), T(0.4), T(0.9), T(0.2)};
    for (std::size_t k = 0; k < 5; ++k) {
      share.push_back(equal ? T(0.2) : powers[k] / 20);
      cones.push_back(sphere_cone<T>(centres[k], radii[k], 0));
    }
  }
  std::optional<Record<Xyz<T>, T>> sample(T u, T v) const {
    std::size_t k = 0;
    T left = u;
    if (fault == 4) {
      k = static_cast<std::size_t>(cell_of(u, 5));
      left = u * 5 - static_cast<T>(k);
    } else {
      while (k + 1 < share.size() && left >= share[k]) left -= share[k++];
      left = std::min(left / share[k], 1 - std::numeric_limits<T>::epsilon() / 2);
    }
    if (fault == 3) left = u;
    const Xyz<T> w = cones[k].sample(left, v);
    const T density = pdf(w);
    if (!(density > 0)) return std::nullopt;
    T stated = density;
    if (fault == 2) stated = cones[k].pdf(w);
    if (fault == 6) stated = share[k] * cones[k].pdf(w);
    return Record<Xyz<T>, T>{w, stated, value(w) / (fault == 7 ? cones[k].pdf(w) : stated)};
  }
  T pdf(const Xyz<T>& w) const {
    T sum = 0;
    for (std::size_t k = 0; k < share.size(); ++k) {
      const T p = cones[k].pdf(w);
      if (fault == 1 && p > 0) return share[k] * p;
      sum += (fault == 5 ? T(1) : fault == 8 && k == 3 ? T(1) : share[k]) * p;
    }
    return sum;
  }
  T value(const Xyz<T>& w) const {  // radiance of whatever is hit
    T sum = 0;
    for (const Cone<T>& cone : cones) sum += cone.pdf(w) > 0 ? T(1.5) : T(0);
    return sum;
  }
};

template <class T, class Technique>
Pair choice(std::string name, int n, Technique technique) {
  Pair pair = pair_of<int>(std::move(name), Domain::discrete(static_cast<std::size_t>(n)),
                           std::move(technique));
  if constexpr (std::is_same_v<T, double>) pair.epsilon = 0x1p-53;
  return pair;
}

}  // namespace plumbline::tests::corpus
