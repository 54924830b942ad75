#include <array>

#include "pair_support.h"
#include "sealed_switch.h"
#include "sealed_tables.h"

namespace plumbline::tests::corpus {

void add_sealed_phase(std::vector<Case>& cases);

namespace {

using fourth::Odds;
using fourth::of_directions;
using fourth::on;
using fourth::said;

/// A volume of little mirrors whose normals lie on an ellipsoid, seen along `view`.
///
/// @source Heitz et al. 2015 (TOG 34:4), "The SGGX Microflake Distribution", Eq. 16, 17 and the
/// listing of its supplement
template <class T>
struct Flakes {
  int fault;
  Xyz<T> s, view;  ///< squares of the projected areas along the axes; where it is seen from

  T bilinear(const Xyz<T>& a, const Xyz<T>& b) const {
    return s.x * a.x * b.x + s.y * a.y * b.y + s.z * a.z * b.z;
  }
  T area() const { return std::sqrt(bilinear(view, view)); }
  T d(const Xyz<T>& m) const {
    const T e = m.x * m.x / s.x + m.y * m.y / s.y + m.z * m.z / s.z;
    return 1 / (pi_v<T> * std::sqrt(s.x * s.y * s.z) * e * e);
  }
  Xyz<T> sample(T u, T v) const {
    const Frame<T> f(view);
    const T jj = bilinear(f.y, f.y), ii = bilinear(f.z, f.z);
    const T kj = bilinear(f.x, f.y), ki = bilinear(f.x, f.z), ji = bilinear(f.y, f.z);
    const T root_det = std::sqrt(s.x * s.y * s.z), root_ii = std::sqrt(ii);
    const T t = std::sqrt(jj * ii - ji * ji);
    const Xyz<T> mk{root_det / t, 0, 0}, mi{ki / root_ii, ji / root_ii, root_ii};
    const Xyz<T> mj{-(ki * ji - kj * ii) / (t * root_ii), t / root_ii, 0};
    const T r = std::sqrt(u), a = r * std::cos(2 * pi_v<T> * v), b = r * std::sin(2 * pi_v<T> * v);
    const Xyz<T> m = f.to_world(normalized(a * mk + b * mj + std::sqrt(1 - u) * mi));
    return normalized(2 * dot(view, m) * m - view);
  }
  T pdf(const Xyz<T>& w) const {
    const Xyz<T> sum = view + w;
    const T long2 = dot(sum, sum);
    if (!(long2 > 0)) return 0;
    const Xyz<T> m = (1 / std::sqrt(long2)) * sum;
    if (fault == 1) return dot(view, m) * d(m) / area();
    return d(m) / (4 * (fault == 2 ? T(1) : area()));
  }
};

template <class T>
Flakes<T> flakes(int fault) {
  return {on(fault), {T(0.8), T(0.4), T(0.15)}, normalized(Xyz<T>{T(0.5), T(0.6), T(0.7)})};
}

/// Drops of water as Mie's theory gives them at nine cosines, linear between.
template <class T>
struct Drops {
  static constexpr int kCells = 8;
  int fault;
  std::array<T, kCells + 1> node{T(0.3), T(0.15), T(0.2), T(0.1), T(0.3), T(0.5), 1, T(2.2), 5};
  Frame<T> onward{normalized(Xyz<T>{T(0.4), T(-0.3), T(0.6)})};

  T at_node(int i) const { return node[static_cast<std::size_t>(i)]; }
  std::vector<T> masses() const {
    std::vector<T> m;
    for (int i = 0; i < kCells; ++i) m.push_back((at_node(i) + at_node(i + 1)) / 2);
    return m;
  }
  Xyz<T> sample(T u, T v) const {
    int k = Odds<T>(masses()).pick(u);
    const T p = at_node(k), q = at_node(k + 1);
    const T t = std::min(T(1), u * (p + q) / (p + std::sqrt(p * p + u * (q * q - p * p))));
    if (fault == 3) k = (k + 1) % kCells;
    const T cosine = 2 * (static_cast<T>(k) + t) / kCells - 1;
    return onward.to_world(around_z(1 - cosine, 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& w) const {
    const T cosine = std::clamp(dot(w, onward.z), T(-1), T(1));
    const T x = ((fault == 1 ? -cosine : cosine) + 1) / 2;
    const int k = cell_of(x, kCells);
    const T t = x * kCells - static_cast<T>(k);
    const std::vector<T> m = masses();
    const T all = std::accumulate(m.begin(), m.end(), T(0));
    const T per_cosine = ((1 - t) * at_node(k) + t * at_node(k + 1)) * kCells / (2 * all);
    return fault == 2 ? per_cosine : per_cosine / (2 * pi_v<T>);
  }
};

/// Henyey and Greenstein's lobe.
template <class T>
T hg(T g, T cosine) {
  const T d = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * pi_v<T> * d * std::sqrt(d));
}

/// Haze: a forward lobe and a weaker one back.
template <class T>
struct Haze {
  int fault;
  T forward, back, share;
  Frame<T> onward{normalized(Xyz<T>{T(-0.1), T(0.5), T(-0.6)})};

  std::optional<Record<Xyz<T>, T>> sample(T u, T v) const {
    const bool first = u < share;
    T left = first ? u / share : (u - share) / (1 - share);
    left = fourth::below_one(left);
    const T g = first ? (fault == 1 ? std::min(forward, T(0.8)) : forward) : back;
    const T k = (1 - g * g) / (1 + g - 2 * g * left);
    const T cosine = std::clamp((1 + g * g - k * k) / (2 * g), T(-1), T(1));
    const Xyz<T> w = onward.to_world(around_z(1 - cosine, 2 * pi_v<T> * v));
    const T q = pdf(w);
    return Record<Xyz<T>, T>{w, q, value(w) / q};
  }
  T mixed(const Xyz<T>& w, T other) const {
    const T cosine = dot(w, onward.z);
    return share * hg(forward, cosine) + (1 - share) * hg(other, cosine);
  }
  T pdf(const Xyz<T>& w) const { return mixed(w, fault == 2 ? -back : back); }
  T value(const Xyz<T>& w) const { return T(0.95) * mixed(w, back); }
};

template <class T>
Pair haze(int fault) {
  return recorded_pair_of<Xyz<T>>("haze", Domain::sphere(),
                                  Haze<T>{on(fault), T(0.9), T(-0.5), T(0.65)});
}

}  // namespace

void add_sealed_phase(std::vector<Case>& cases) {
  cases.push_back(twin("fourth flakes/double/density of the normal",
                       said("B3: pdf is that of the visible normal, without 1/(4 view.m)"),
                       {Kind::half_vector_jacobian},
                       [] { return of_directions("flakes", flakes<double>(1)); }));
  cases.push_back(twin("fourth flakes/double/not over the projected area",
                       said("pdf is not divided by the projected area of the flakes"),
                       {Kind::constant, Kind::masking},
                       [] { return of_directions("flakes", flakes<double>(2)); }));
  cases.push_back(twin("fourth drops/double/table from the other end",
                       said("pdf reads the table from forwards to backwards"), {Kind::mirrored},
                       [] { return of_directions("drops", Drops<double>{on(1)}); }));
  cases.push_back(twin("fourth drops/float/per cosine", said("pdf is per cosine, without 1/(2π)"),
                       {Kind::constant},
                       [] { return of_directions("drops", Drops<float>{on(2)}); }));
  cases.push_back(twin("fourth drops/double/next cell",
                       said("sample lands in the cell after the one that was chosen"),
                       {Kind::shifted},
                       [] { return of_directions("drops", Drops<double>{on(3)}); }));
  cases.push_back(twin("fourth haze/0.9, -0.5/double/g clamped in sample",
                       said("B29: sample clamps the forward lobe's g to 0.8, pdf does not"),
                       {Kind::roughness}, [] { return haze<double>(1); }));
  cases.push_back(twin("fourth haze/0.9, -0.5/float/back lobe forwards in pdf",
                       said("pdf has the back lobe's g without its sign"), {Kind::mirrored},
                       [] { return haze<float>(2); }));
}

}  // namespace plumbline::tests::corpus
