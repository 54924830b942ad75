#include <array>

#include "pair_support.h"
#include "sealed_choice.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

void add_sealed_lines(std::vector<Case>& cases);

namespace fifth {
namespace {

/// A tent over [-r, r].
template <class T>
struct Tent {
  int fault;
  T r;

  T sample(T u) const {
    if (u < T(0.5)) return r * (std::sqrt(2 * u) - 1);
    return r * (1 - std::sqrt(2 * (1 - u)));
  }
  T pdf(T x) const {
    const T height = std::max(T(0), 1 - std::abs(x) / r);
    return fault == 1 ? height : height / r;
  }
};

/// Wavelengths that the eye sees, from 360 nm to 830 nm.
///
/// @source Radziszewski et al. 2009, "An Improved Technique for Full Spectral Rendering"
template <class T>
struct Visible {
  static constexpr double kSlope = 0.0072, kPeak = 538;
  int fault;

  static T tangent(double lambda) { return static_cast<T>(std::tanh(kSlope * (lambda - kPeak))); }
  T sample(T u) const {
    const T low = tangent(360), high = tangent(830);
    const T x = std::atanh(low + u * (high - low)) / T(kSlope) + T(kPeak);
    return std::clamp(x, T(360), T(830));
  }
  T pdf(T lambda) const {
    if (!(lambda >= 360 && lambda <= 830)) return 0;
    const T c = std::cosh(T(kSlope) * (lambda - (fault == 1 ? T(555) : T(kPeak))));
    return T(kSlope) / (c * c * (tangent(830) - tangent(360)));
  }
};

/// Linear between nodes.
template <class T>
struct Graph {
  static constexpr int kPieces = 8;
  int fault;
  std::vector<T> node{T(1), T(3), T(2), T(0.5), T(0.2), T(1.5), T(4), T(2.5), T(0.8)};

  std::vector<T> masses() const {
    std::vector<T> m;
    for (int i = 0; i < kPieces; ++i) m.push_back((at(node, i) + at(node, i + 1)) / 2);
    return m;
  }
  T sample(T u) const {
    const Choice<T> pieces(masses());
    const int i = pieces.index(u);
    const T a = at(node, i), b = at(node, i + 1), left = pieces.left(u, i);
    const T t = left * (a + b) / (a + std::sqrt(a * a + left * (b * b - a * a)));
    return (static_cast<T>(i) + std::min(T(1), t)) / kPieces;
  }
  T pdf(T x) const {
    if (!(x >= 0 && x <= 1)) return 0;
    const int i = cell_of(x, kPieces);
    const T t = x * kPieces - static_cast<T>(i);
    const int k = fault == 1 ? std::min(i + 1, kPieces - 1) : i;
    T all = 0;
    for (const T m : masses()) all += m;
    return ((1 - t) * at(node, k) + t * at(node, k + 1)) * kPieces / all;
  }
};

template <class T>
Pair graph(int fault) {
  std::vector<double> nodes;
  for (int i = 1; i < Graph<T>::kPieces; ++i) nodes.push_back(static_cast<double>(i) / 8);
  return pair_of<T>("graph", Domain::interval().with_breaks(nodes), Graph<T>{put(fault)});
}

/// Distance through smoke that takes colours differently: a colour, then its extinction.
template <class T>
struct Smoke {
  int fault;
  std::array<T, 3> sigma{T(2), T(1), T(0.4)};

  T sample(T u) const {
    const int k = cell_of(u, 3);
    const T left = short_of_one(3 * u - static_cast<T>(k));
    return -std::log1p(-left) / sigma[static_cast<std::size_t>(k)];
  }
  T pdf(T t) const {
    if (!(t >= 0)) return 0;
    if (fault == 1) return sigma[1] * std::exp(-sigma[1] * t);
    T sum = 0;
    for (const T s : sigma) sum += s * std::exp(-s * t);
    return sum / 3;
  }
};

template <class T>
Pair smoke(int fault) {
  Pair pair = pair_of<T>("smoke", Domain::interval(0, 100), Smoke<T>{put(fault)});
  pair.many_to_one = true;
  return pair;
}

/// Distance to a collision before a wall; what gets to the wall is another technique's.
template <class T>
struct BeforeWall {
  int fault;
  T sigma = T(0.8), wall = T(1.7);

  std::optional<T> sample(T u) const {
    const T t = -std::log1p(-u) / sigma;
    if (fault == 1) return std::min(t, wall);
    return t < wall ? std::optional<T>(t) : std::nullopt;
  }
  T pdf(T t) const { return t >= 0 && t <= wall ? sigma * std::exp(-sigma * t) : T(0); }
};

/// Radii of a profile, evenly in their logarithm.
template <class T>
struct Decades {
  int fault;
  T least = T(0.01), most = T(2);

  T sample(T u) const { return std::min(most, least * std::exp(u * std::log(most / least))); }
  T pdf(T r) const {
    if (!(r >= least && r <= most)) return 0;
    return 1 / (std::log(most / least) * (fault == 1 ? T(1) : r));
  }
};

/// Walker's table: each slot keeps a share of itself and gives the rest to another.
template <class T>
struct Slots {
  static constexpr int kSlots = 6;
  int fault;
  std::vector<T> p{T(0.3), T(0.05), T(0.2), T(0.1), T(0.25), T(0.1)}, keeps;
  std::vector<int> other;

  explicit Slots(int which) : fault(which), keeps(p), other(kSlots, 0) {
    std::vector<int> poor, rich;
    for (int i = 0; i < kSlots; ++i) {
      ref(keeps, i) *= kSlots;
      (at(keeps, i) < 1 ? poor : rich).push_back(i);
    }
    std::vector<T> rest = keeps;
    while (!poor.empty() && !rich.empty()) {
      const int small = poor.back(), large = rich.back();
      poor.pop_back();
      ref(keeps, small) = at(rest, small), ref(other, small) = large;
      ref(rest, large) -= 1 - at(rest, small);
      if (!(at(rest, large) < 1)) continue;
      rich.pop_back();
      poor.push_back(large);
    }
    for (const int i : poor) ref(keeps, i) = 1;
    for (const int i : rich) ref(keeps, i) = 1;
  }
  int sample(T u) const {
    const int slot = cell_of(u, kSlots);
    return u * kSlots - static_cast<T>(slot) < at(keeps, slot) ? slot : at(other, slot);
  }
  T pdf(int k) const { return fault == 1 ? at(keeps, k) / kSlots : at(p, k); }
};

/// How many bounces roulette lets a path have, at most nine.
template <class T>
struct Bounces {
  static constexpr int kMost = 9;
  int fault;
  T survives;

  int sample(T u) const {
    const T x = u * (1 - std::pow(survives, T(kMost + 1)));
    return std::clamp(static_cast<int>(std::log1p(-x) / std::log(survives)), 0, kMost);
  }
  T pdf(int k) const {
    const T q = std::pow(survives, static_cast<T>(k)) / (1 - std::pow(survives, T(kMost + 1)));
    return fault == 1 ? q : q * (1 - survives);
  }
};

}  // namespace
}  // namespace fifth

void add_sealed_lines(std::vector<Case>& cases) {
  using namespace fifth;
  cases.push_back(twin("fifth tent/r 2/float/1/r forgotten",
                       because("pdf is the tent's height, 1 in the middle, for r = 2"),
                       {Kind::constant}, [] {
                         return pair_of<float>("tent", Domain::interval(-2, 2).with_breaks({0.5}),
                                               Tent<float>{put(1), 2});
                       }));
  cases.push_back(
      twin("fifth visible/double/peak at 555 in pdf",
           because("pdf has its peak at 555 nm, sample at 538 nm"), {Kind::shifted}, [] {
             return pair_of<double>("visible", Domain::interval(360, 830), Visible<double>{put(1)});
           }));
  cases.push_back(twin("fifth graph/8/double/next piece",
                       because("pdf interpolates in the piece after"), {Kind::shifted},
                       [] { return graph<double>(1); }));
  cases.push_back(twin("fifth smoke/double/green alone in pdf",
                       because("M9: pdf is that of the green extinction, any colour is chosen"),
                       {Kind::chosen_lobe_only, Kind::lobe_probability, Kind::choice_probability},
                       [] { return smoke<double>(1); }));
  cases.push_back(twin("fifth before a wall/double/set on the wall",
                       because("distances beyond the wall are clamped to it, not given up"),
                       {Kind::on_a_line, Kind::not_rejected}, [] {
                         return pair_of<double>("before a wall", Domain::interval(0, 1.7),
                                                BeforeWall<double>{put(1)});
                       }));
  cases.push_back(twin("fifth decades/double/1/r forgotten",
                       because("pdf is per decade, without 1/r"), {Kind::radius}, [] {
                         return pair_of<double>("decades", Domain::interval(0.01, 2),
                                                Decades<double>{put(1)});
                       }));
  cases.push_back(twin("fifth slots/6/double/what a slot keeps",
                       because("pmf is what the slot keeps of itself, not the whole probability"),
                       {Kind::choice_probability}, [] {
                         return pair_of<int>("slots", Domain::discrete(6), Slots<double>(put(1)));
                       }));
  cases.push_back(
      twin("fifth bounces/survives 0.7/float/1 - q forgotten",
           because("R1: pmf lacks the probability that the path ends there"), {Kind::constant}, [] {
             return pair_of<int>("bounces", Domain::discrete(10), Bounces<float>{put(1), 0.7F});
           }));
}

}  // namespace plumbline::tests::corpus
