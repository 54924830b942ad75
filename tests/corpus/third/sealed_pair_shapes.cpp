#include "pair_support.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

void add_sealed_shapes(std::vector<Case>& cases);

namespace {

using fresh::on;
using fresh::said;

/// Opening of a mirror telescope: a disk without its middle.
template <class T>
struct Ring {
  int fault;
  T inner, outer;

  Xy<T> sample(T u, T v) const {
    T r = std::sqrt(inner * inner + u * (outer * outer - inner * inner));
    if (fault == 1) r = inner + u * (outer - inner);
    if (fault == 3) r = outer * std::sqrt(u);
    const T phi = 2 * pi_v<T> * v;
    return {r * std::cos(phi), r * std::sin(phi)};
  }
  T pdf(const Xy<T>& p) const {
    const T r2 = p.x * p.x + p.y * p.y;
    if (!(r2 >= inner * inner && r2 <= outer * outer)) return 0;
    const T hole = fault == 2 ? T(0) : inner * inner;
    return 1 / (pi_v<T> * (outer * outer - hole));
  }
};

/// Iris of straight blades. The first number chooses a sector, and is stretched.
template <class T>
struct Iris {
  int fault;
  int blades;

  T corner(int k) const { return 2 * pi_v<T> * static_cast<T>(k) / static_cast<T>(blades); }
  Xy<T> sample(T u, T v) const {
    const T scaled = u * static_cast<T>(fault == 1 ? blades - 1 : blades);
    const int k = std::min(static_cast<int>(scaled), blades - 1);
    const T s = std::sqrt(scaled - static_cast<T>(k));
    const T a = s * (1 - v), b = s * v;
    return {a * std::cos(corner(k)) + b * std::cos(corner(k + 1)),
            a * std::sin(corner(k)) + b * std::sin(corner(k + 1))};
  }
  T pdf(const Xy<T>& p) const {
    for (int k = 0; k < blades; ++k) {
      const T middle = (corner(k) + corner(k + 1)) / 2;
      if (p.x * std::cos(middle) + p.y * std::sin(middle) > std::cos(corner(1) / 2)) return 0;
    }
    return 2 / (static_cast<T>(blades) * std::sin(corner(1)));
  }
};

/// A round lens.
template <class T>
struct Lens {
  int fault;
  T radius;

  Xy<T> sample(T u, T v) const {
    const T r = radius * std::sqrt(v), phi = 2 * pi_v<T> * u;
    return {r * std::cos(phi), r * std::sin(phi)};
  }
  T pdf(const Xy<T>& p) const {
    const T r2 = p.x * p.x + p.y * p.y;
    if (!(r2 <= (fault == 1 ? radius : radius * radius))) return 0;
    return fault == 2 ? radius * radius / pi_v<T> : 1 / (pi_v<T> * radius * radius);
  }
};

/// Where light that has gone into skin comes out: a Gaussian profile over the distance, cut off.
template <class T>
struct SkinProfile {
  int fault;
  T width, most;

  T inside() const { return -std::expm1(-most * most / (2 * width * width)); }
  Xy<T> sample(T u, T v) const {
    const T r = std::min(width * std::sqrt(-2 * std::log1p(-u * inside())), most);
    const T phi = 2 * pi_v<T> * v;
    return {r * std::cos(phi), r * std::sin(phi)};
  }
  T pdf(const Xy<T>& p) const {
    const T r2 = p.x * p.x + p.y * p.y;
    if (!(r2 <= most * most)) return 0;
    const T over_r = std::exp(-r2 / (2 * width * width)) / (width * width * inside());
    return (fault == 1 ? std::sqrt(r2) : T(1)) * over_r / (2 * pi_v<T>);
  }
};

/// Positions on a pixel by a filter in cells, a ramp along x, a hump along y.
template <class T>
struct Filter {
  int fault;
  std::vector<T> along_x{T(1), T(2), T(4), T(3), T(0.5)}, along_y{T(0.5), T(3), T(1)};

  static T draw(const std::vector<T>& f, T u) {
    T sum = 0, below = 0;
    for (const T x : f) sum += x;
    int k = 0;
    while (k + 1 < static_cast<int>(f.size()) && u * sum >= below + at(f, k)) below += at(f, k++);
    const T left = std::min((u * sum - below) / at(f, k), T(1));
    return (static_cast<T>(k) + left) / static_cast<T>(f.size());
  }
  static T density(const std::vector<T>& f, T x) {
    T sum = 0;
    for (const T y : f) sum += y;
    const int n = static_cast<int>(f.size());
    return at(f, cell_of(x, n)) / sum * static_cast<T>(n);
  }
  Xy<T> sample(T u, T v) const {
    Xy<T> p{draw(along_x, u), draw(along_y, v)};
    if (fault == 1) {
      p.x += T(0.5) / static_cast<T>(along_x.size());
      p.x -= std::floor(p.x);
    }
    return p;
  }
  T pdf(const Xy<T>& p) const {
    if (fault == 2) return density(along_x, p.y) * density(along_y, p.x);
    if (fault == 3) return density(along_x, p.x);
    return density(along_x, p.x) * density(along_y, p.y);
  }
};

template <template <class> class Technique, class T>
Pair on_disk(std::string name, T radius, Technique<T> technique) {
  return pair_of<Xy<T>>(std::move(name), Domain::disk(static_cast<double>(radius)),
                        std::move(technique));
}

template <class T>
Pair filter(int fault) {
  return pair_of<Xy<T>>("filter", Domain::unit_square(), Filter<T>{on(fault)});
}

}  // namespace

void add_sealed_shapes(std::vector<Case>& cases) {
  cases.push_back(twin("fresh ring/0.4, 1/float/no root",
                       said("the radius goes evenly from the inner to the outer one"),
                       {Kind::radius}, [] {
                         return on_disk("ring", 1.0F, Ring<float>{on(1), 0.4F, 1});
                       }));
  cases.push_back(twin("fresh ring/0.5, 1/float/hole not taken off",
                       said("pdf is that of the whole disk, the hole's area is not taken off"),
                       {Kind::constant}, [] {
                         return on_disk("ring", 1.0F, Ring<float>{on(2), 0.5F, 1});
                       }));
  cases.push_back(twin("fresh iris/7/double/last sector left out",
                       said("sample chooses among one sector less than there are"),
                       {Kind::support, Kind::choice_probability}, [] {
                         return on_disk("iris", 1.0, Iris<double>{on(1), 7});
                       }));
  cases.push_back(twin("fresh lens/radius 2/float/r² against r",
                       said("pdf holds the square of the distance against the radius"),
                       {Kind::support}, [] {
                         return on_disk("lens", 2.0F, Lens<float>{on(1), 2});
                       }));
  cases.push_back(twin("fresh skin profile/double/per distance",
                       said("pdf is that of the distance over 2π, not over 2πr"), {Kind::radius},
                       [] {
                         return on_disk("skin profile", 1.5, SkinProfile<double>{on(1), 0.5, 1.5});
                       }));
}

}  // namespace plumbline::tests::corpus
