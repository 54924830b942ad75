#include <array>

#include "pair_support.h"
#include "sealed_switch.h"
#include "sealed_tables.h"

namespace plumbline::tests::corpus {

void add_sealed_lines(std::vector<Case>& cases);

namespace {

using fourth::Odds;
using fourth::on;
using fourth::said;

/// Distance to a collision in air, which is so thin that hardly any happens.
template <class T>
struct ThinAir {
  int fault;
  T sigma, most;

  T sample(T u) const { return std::min(most, -std::log1p(u * std::expm1(-sigma * most)) / sigma); }
  T pdf(T t) const {
    if (!(t >= 0 && t <= most)) return 0;
    const T inside = fault == 1 ? 1 - std::exp(-sigma * most) : -std::expm1(-sigma * most);
    return sigma * std::exp(-sigma * t) / inside;
  }
};

/// Distance to a collision on a grid, given that there is one: voxel after voxel.
template <class T>
struct Voxels {
  static constexpr int kVoxels = 6;
  int fault;
  std::array<T, kVoxels> sigma{T(0.2), T(0.9), T(0.1), T(0.6), T(1.5), T(0.4)};

  T of_voxel(int k) const { return sigma[static_cast<std::size_t>(k)]; }
  T depth(T t) const {
    T sum = 0;
    for (int k = 0; k < kVoxels; ++k) {
      sum += of_voxel(k) * std::clamp(t - static_cast<T>(k), T(0), T(1));
    }
    return sum;
  }
  T sample(T u) const {
    T left = -std::log1p(u * std::expm1(-depth(kVoxels)));
    int k = 0;
    while (k + 1 < kVoxels && left > of_voxel(k)) left -= of_voxel(k++);
    return static_cast<T>(k) + std::min(T(1), left / of_voxel(k));
  }
  T pdf(T t) const {
    if (!(t >= 0 && t <= kVoxels)) return 0;
    int k = cell_of(t / kVoxels, kVoxels);
    if (fault == 1) k = (k + 1) % kVoxels;
    return of_voxel(k) * std::exp(-depth(t)) / -std::expm1(-depth(kVoxels));
  }
};

/// A phosphor's line at 580 nm with a short and a long flank, over [380, 780] nm.
template <class T>
struct Phosphor {
  static constexpr T kCentre = 580, kReach = 200;
  int fault;
  T blue = 25, red = 70;

  static T area(T width) { return width * -std::expm1(-kReach / width); }
  T sample(T u) const {
    const T p = area(blue) / (area(blue) + area(red));
    const bool left = u < p;
    const T x = fourth::below_one(left ? u / p : (u - p) / (1 - p)), width = left ? blue : red;
    const T away = std::min(kReach, -width * std::log1p(x * std::expm1(-kReach / width)));
    return left ? kCentre - away : kCentre + away;
  }
  T pdf(T lambda) const {
    const T x = lambda - kCentre;
    if (!(std::abs(x) <= kReach)) return 0;
    const T width = (x < 0) == (fault == 1) ? red : blue;
    return std::exp(-std::abs(x) / width) / (area(blue) + area(red));
  }
};

/// A shutter that opens over a while, stays open, and takes longer to close.
template <class T>
struct Shutter {
  static constexpr T kOpen = T(0.2), kClosing = T(0.6);
  int fault;

  static T whole() { return kOpen / 2 + (kClosing - kOpen) + (1 - kClosing) / 2; }
  T sample(T u) const {
    const T x = u * whole(), open = kClosing - kOpen;
    if (x < kOpen / 2) return std::sqrt(2 * kOpen * x);
    if (x < kOpen / 2 + open) return kOpen + (x - kOpen / 2);
    const T closing = 1 - kClosing, left = std::max(T(0), whole() - x);
    const T to_end = std::min(closing, std::sqrt(2 * closing * left));
    return fault == 2 ? kClosing + to_end : 1 - to_end;
  }
  T pdf(T t) const {
    if (!(t >= 0 && t <= 1)) return 0;
    const T height = t < kOpen ? t / kOpen : t < kClosing ? T(1) : (1 - t) / (1 - kClosing);
    return fault == 1 ? height : height / whole();
  }
};

/// Sizes of dust grains by a power law.
template <class T>
struct Dust {
  int fault;
  T power, least, most;

  T raised(T r) const { return std::pow(r, 1 - power); }
  bool logarithmic() const { return power == 1 && fault != 1; }
  T sample(T u) const {
    if (logarithmic()) return std::min(most, least * std::pow(most / least, u));
    return std::pow(raised(least) + u * (raised(most) - raised(least)), 1 / (1 - power));
  }
  T pdf(T r) const {
    if (!(r >= least && r <= most)) return 0;
    if (logarithmic()) return 1 / (r * std::log(most / least));
    return std::pow(r, -power) * (1 - power) / (raised(most) - raised(least));
  }
};

/// Number of grains in a pixel of film, after Poisson, twelve at most.
template <class T>
struct Grains {
  static constexpr int kMost = 12;
  int fault;
  T mean;

  T term(int k) const {
    T x = std::exp(-mean);
    for (int i = 1; i <= k; ++i) x *= mean / static_cast<T>(i);
    return x;
  }
  T all() const {
    T sum = 0;
    for (int k = 0; k <= kMost; ++k) sum += term(k);
    return sum;
  }
  int sample(T u) const {
    T below = u * all();
    int k = 0;
    while (k < kMost && below >= term(k)) below -= term(k++);
    return k;
  }
  T pdf(int k) const {
    const T p = term(fault == 1 ? (k + 1) % (kMost + 1) : k) / all();
    return fault == 2 ? p * std::exp(mean) : p;
  }
};

/// Distance along a ray, by extinction or, now and then, evenly.
template <class T>
struct WaryDistance {
  int fault;
  T sigma = T(1.5), most = 6, even = T(0.2);
  std::shared_ptr<int> last = std::make_shared<int>(-1);

  T sample(T u) const {
    const bool evenly = u < even;
    const T left = fourth::below_one(evenly ? u / even : (u - even) / (1 - even));
    *last = evenly ? 1 : 0;
    return evenly ? left * most
                  : std::min(most, -std::log1p(left * std::expm1(-sigma * most)) / sigma);
  }
  T pdf(T t) const {
    if (!(t >= 0 && t <= most)) return 0;
    const T by_extinction = sigma * std::exp(-sigma * t) / -std::expm1(-sigma * most);
    if (fault == 2 && *last == 1) return 1 / most;
    if (fault == 2 && *last == 0) return by_extinction;
    const T p = fault == 1 ? 1 - even : even;
    return p / most + (1 - p) * by_extinction;
  }
};

template <class T>
Pair wary(int fault) {
  Pair pair = pair_of<T>("wary distance", Domain::interval(0, 6), WaryDistance<T>{on(fault)});
  pair.many_to_one = true;
  return pair;
}

/// How far from its source light arrives through ground glass: on a half-line, after Rayleigh.
template <class T>
struct Spread {
  int fault;
  T deviation;

  T sample(T u) const { return deviation * std::sqrt(-2 * std::log1p(-u)); }
  T pdf(T r) const {
    if (!(r >= 0)) return 0;
    const T gauss = std::exp(-r * r / (2 * deviation * deviation)) / (deviation * deviation);
    return fault == 1 ? gauss : r * gauss;
  }
};

}  // namespace

void add_sealed_lines(std::vector<Case>& cases) {
  cases.push_back(twin(
      "fourth thin air/float/1 − exp",
      said("L4: pdf divides by 1 − exp(−σd) in float, where σd is 1e-6"),
      {Kind::precision, Kind::constant}, [] {
        return pair_of<float>("thin air", Domain::interval(0, 2), ThinAir<float>{on(1), 5e-7F, 2});
      }));
  cases.push_back(twin(
      "fourth voxels/double/extinction of the next voxel",
      said("pdf has the extinction of the voxel after the one of the collision"), {Kind::shifted},
      [] { return pair_of<double>("voxels", Domain::interval(0, 6), Voxels<double>{on(1)}); }));
  cases.push_back(twin("fourth phosphor/double/flanks exchanged",
                       said("pdf has the long flank on the short side"), {Kind::mirrored}, [] {
                         return pair_of<double>("phosphor", Domain::interval(380, 780),
                                                Phosphor<double>{on(1)});
                       }));
  cases.push_back(
      twin("fourth shutter/float/height 1",
           said("pdf is how far the shutter is open, not over the whole of it"), {Kind::constant},
           [] { return pair_of<float>("shutter", Domain::interval(), Shutter<float>{on(1)}); }));
  cases.push_back(
      twin("fourth shutter/double/closes the wrong way round",
           said("samples of the closing ramp rise towards its end"), {Kind::mirrored},
           [] { return pair_of<double>("shutter", Domain::interval(), Shutter<double>{on(2)}); }));
  cases.push_back(
      twin("fourth dust/power 1/double/no case for the power 1",
           said("power 1 has no case of its own: 0/0"), {Kind::not_finite}, [] {
             return pair_of<double>("dust", Domain::interval(1, 8), Dust<double>{on(1), 1, 1, 8});
           }));
  cases.push_back(
      twin("fourth grains/mean 3/double/one more", said("pmf is that of one grain more"),
           {Kind::shifted}, [] {
             return pair_of<int>("grains", Domain::discrete(13), Grains<double>{on(1), 3});
           }));
  cases.push_back(
      twin("fourth grains/mean 2/double/without exp", said("pmf lacks exp(−mean)"),
           {Kind::constant}, [] {
             return pair_of<int>("grains", Domain::discrete(13), Grains<double>{on(2), 2});
           }));
  cases.push_back(twin("fourth wary distance/double/shares exchanged in pdf",
                       said("pdf has the even share for extinction and the reverse"),
                       {Kind::lobe_probability}, [] { return wary<double>(1); }));
  cases.push_back(twin("fourth wary distance/double/the way it went last",
                       said("pdf is that of the way in which the last sample was drawn"),
                       {Kind::stale_state, Kind::chosen_lobe_only},
                       [] { return wary<double>(2); }));
  cases.push_back(
      twin("fourth spread/half-line/double/per area",
           said("pdf is the Gaussian's, without the distance r"), {Kind::radius}, [] {
             return pair_of<double>("spread", Domain::interval(0, 6), Spread<double>{on(1), 0.6});
           }));
}

}  // namespace plumbline::tests::corpus
