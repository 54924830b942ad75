#pragma once

#include <limits>
#include <numeric>

#include "pair_support.h"
#include "sealed_switch.h"

/// Tables of the fourth set's pairs, written apart from those of the others.
namespace plumbline::tests::corpus::fourth {

template <class T>
T below_one(T u) {
  return std::min(u, 1 - std::numeric_limits<T>::epsilon() / 2);
}

/// One of several by given odds.
template <class T>
struct Odds {
  std::vector<T> p;

  explicit Odds(std::vector<T> weights) : p(std::move(weights)) {
    const T sum = std::accumulate(p.begin(), p.end(), T(0));
    for (T& x : p) x /= sum;
  }
  int size() const { return static_cast<int>(p.size()); }
  T operator[](int i) const { return at(p, i); }

  /// Which one; `u` becomes what is left of it, in [0, 1) again.
  int pick(T& u) const {
    int i = 0;
    T rest = u;
    while (i + 1 < size() && rest >= at(p, i)) rest -= at(p, i++);
    u = below_one(std::max(T(0), rest / at(p, i)));
    return i;
  }
};

template <class T>
Xyz<T> spherical(T z, T phi) {
  const T r = std::sqrt(std::max(T(0), 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Share of a turn, from 0 to 1.
template <class T>
T turn_of(T x, T y) {
  const T turn = std::atan2(y, x) / (2 * pi_v<T>);
  return turn < 0 ? turn + 1 : turn;
}

template <template <class> class Technique, class T>
Pair of_directions(std::string name, Technique<T> technique) {
  return pair_of<Xyz<T>>(std::move(name), Domain::sphere(), std::move(technique));
}

}  // namespace plumbline::tests::corpus::fourth
