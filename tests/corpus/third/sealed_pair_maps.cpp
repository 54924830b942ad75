#include <array>

#include "pair_support.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

void add_sealed_maps(std::vector<Case>& cases);

namespace {

using fresh::on;
using fresh::said;

/// A panorama, by one running sum over all its texels. Rows go by equal θ, or by equal height above
/// the horizon, where all texels are of one size.
template <class T>
struct Panorama {
  static constexpr int kWide = 12, kHigh = 6;
  int fault;
  bool equal_heights;
  std::vector<T> mass, sums{T(0)};
  std::shared_ptr<int> last = std::make_shared<int>(-1);

  Panorama(int which, bool heights) : fault(which), equal_heights(heights) {
    for (int j = 0; j < kHigh; ++j) {
      for (int i = 0; i < kWide; ++i) {
        const T glow = T(0.4) + static_cast<T>((i * 5 + j * 7) % 6) / 2 + (i == 3 ? T(2) : T(0));
        const T size = equal_heights ? T(1) : std::cos(edge(j)) - std::cos(edge(j + 1));
        mass.push_back(glow * (fault == 5 ? T(1) : size));
        sums.push_back(sums.back() + mass.back());
        if (fault == 5) mass.back() = glow * size;
      }
    }
    T all = 0;
    for (const T m : mass) all += m;
    for (T& m : mass) m /= all;
    const T whole = sums.back();
    for (T& s : sums) s /= whole;
  }
  static T edge(int j) { return pi_v<T> * static_cast<T>(j) / kHigh; }

  Xyz<T> sample(T u, T v) const {
    const auto above = std::upper_bound(sums.begin() + 1, sums.end() - 1, u);
    const int k = static_cast<int>(above - sums.begin()) - 1;
    const T left = (u - at(sums, k)) / (at(sums, k + 1) - at(sums, k));
    const T x = (static_cast<T>(k % kWide) + (fault == 1 ? u : left)) / kWide;
    const T y = (static_cast<T>(k / kWide) + (fault == 7 ? left : v)) / kHigh;
    *last = k;
    const T phi = 2 * pi_v<T> * x;
    if (equal_heights) {
      const Xyz<T> w = around_z(2 * y, phi);
      return w;
    }
    const T theta = pi_v<T> * y;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  }
  T pdf(const Xyz<T>& w) const {
    const T sine = std::sqrt(w.x * w.x + w.y * w.y);
    if (!(sine > 0)) return 0;
    T x = (fault == 3 ? std::atan2(w.x, w.y) : std::atan2(w.y, w.x)) / (2 * pi_v<T>);
    if (x < 0) x += 1;
    const T y = equal_heights ? (1 - w.z) / 2 : std::atan2(sine, w.z) / pi_v<T>;
    int i = cell_of(x, kWide);
    if (fault == 2) i = static_cast<int>(std::lround(x * kWide)) % kWide;
    const int k = fault == 8 && *last >= 0 ? *last : cell_of(y, kHigh) * kWide + i;
    const T density = at(mass, k) * kWide * kHigh;
    if (equal_heights) return density / (4 * pi_v<T> * (fault == 6 ? sine : T(1)));
    if (fault == 4) return density / (pi_v<T> * pi_v<T> * sine);
    if (fault == 9) return density * sine / (2 * pi_v<T> * pi_v<T>);
    return density / (2 * pi_v<T> * pi_v<T> * sine);
  }
};

template <class T>
Pair panorama(int fault, bool equal_heights = false) {
  return pair_of<Xyz<T>>("panorama", Domain::sphere(), Panorama<T>(on(fault), equal_heights));
}

}  // namespace

void add_sealed_maps(std::vector<Case>& cases) {
  cases.push_back(twin("fresh panorama/12x6/float/column rounded",
                       said("pdf rounds to the nearest column, sample rounds down"),
                       {Kind::shifted}, [] { return panorama<float>(2); }));
  cases.push_back(twin("fresh panorama/12x6/double/atan2 of x, y",
                       said("pdf has the arguments of atan2 exchanged"), {Kind::mirrored},
                       [] { return panorama<double>(3); }));
  cases.push_back(twin("fresh panorama/12x6/float/texels without their size",
                       said("sample chooses texels without their solid angle, pdf has it"),
                       {Kind::sine}, [] { return panorama<float>(5); }));
  cases.push_back(twin("fresh panorama/equal heights 12x6/float/1/sinθ too many",
                       said("pdf divides by sinθ, though rows are of equal height"), {Kind::sine},
                       [] { return panorama<float>(6, true); }));
  cases.push_back(twin("fresh panorama/12x6/double/one number for both",
                       said("what is left of the first number is row and column within the texel"),
                       {Kind::numbers_reused, Kind::on_a_line},
                       [] { return panorama<double>(7); }));
}

}  // namespace plumbline::tests::corpus
