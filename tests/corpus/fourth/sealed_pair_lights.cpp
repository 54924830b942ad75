#include <array>

#include "pair_support.h"
#include "sealed_switch.h"
#include "sealed_tables.h"

namespace plumbline::tests::corpus {

void add_sealed_lights(std::vector<Case>& cases);

namespace {

using fourth::Odds;
using fourth::of_directions;
using fourth::on;
using fourth::said;

/// A bulb by the cone that it fills.
template <class T>
struct Bulb {
  int fault;
  T distance, radius;
  Frame<T> frame{normalized(Xyz<T>{T(-0.6), T(0.3), T(0.5)})};

  static T cap(T sine2) { return sine2 / (1 + std::sqrt(1 - sine2)); }
  T sine2() const { return radius * radius / (distance * distance); }
  Xyz<T> sample(T u, T v) const {
    return frame.to_world(around_z(u * cap(sine2()), 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& w) const {
    if (!(one_minus_dot(w, frame.z) <= cap(sine2()))) return 0;
    return 1 / (2 * pi_v<T> * cap(fault == 1 ? radius / distance : sine2()));
  }
};

/// A globe by its surface; what faces away is given up.
template <class T>
struct Globe {
  int fault;
  Xyz<T> centre;
  T radius;

  std::optional<Xyz<T>> sample(T u, T v) const {
    const Xyz<T> n = around_z(2 * u, 2 * pi_v<T> * v), p = centre + radius * n;
    if (!(dot(p, n) < 0)) return std::nullopt;
    return normalized(p);
  }
  T pdf(const Xyz<T>& w) const {
    const T b = dot(w, centre), root2 = b * b - dot(centre, centre) + radius * radius;
    if (!(b > 0) || !(root2 > 0)) return 0;
    const T d = b - std::sqrt(root2);
    const Xyz<T> n = (1 / radius) * (d * w - centre);
    const T distance2 = fault == 1 ? dot(centre, centre) : d * d;
    const T cosine = fault == 2 ? dot(w, normalized(centre)) : -dot(w, n);
    return distance2 / (cosine * 4 * pi_v<T> * radius * radius);
  }
};

/// Distance along w to the plane of a triangle, if it is met within it.
template <class T>
struct Facet {
  Xyz<T> a, b, c;

  Xyz<T> normal() const { return cross(b - a, c - a); }
  T area() const { return length(normal()) / 2; }
  std::optional<T> meet(const Xyz<T>& w) const {
    const Xyz<T> n = normal();
    const T d = dot(a, n) / dot(w, n);
    if (!(d > 0)) return std::nullopt;
    const Xyz<T> p = d * w;
    const bool inside = dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 &&
                        dot(cross(a - c, p - c), n) >= 0;
    return inside ? std::optional<T>(d) : std::nullopt;
  }
};

/// A screen of two triangles that glows more towards one corner, with a record.
template <class T>
struct Screen {
  int fault;
  Xyz<T> p{T(0.6), T(-0.7), T(0.9)}, a{T(-0.2), T(1.3), T(0.1)}, b{T(0.4), T(0.2), T(-1)};

  T area() const { return length(cross(a, b)); }
  /// Where w meets it, from 0 to 1 both ways, and how far away.
  std::optional<Xyz<T>> meet(const Xyz<T>& w) const {
    const Xyz<T> n = cross(a, b);
    const T d = dot(p, n) / dot(w, n);
    if (!(d > 0)) return std::nullopt;
    const Xyz<T> q = d * w - p;
    const T s = dot(cross(q, b), n) / dot(n, n), t = dot(cross(a, q), n) / dot(n, n);
    if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) return std::nullopt;
    return Xyz<T>{s, t, d};
  }
  std::optional<Record<Xyz<T>, T>> sample(T u, T v) const {
    const Xyz<T> w = normalized(p + u * a + v * b);
    const T q = pdf(w);
    if (!(q > 0)) return std::nullopt;
    const T radiance = T(0.5) + u * v;
    return Record<Xyz<T>, T>{w, q, radiance / (fault == 1 ? 1 / area() : q)};
  }
  T pdf(const Xyz<T>& w) const {
    const auto hit = meet(w);
    if (!hit) return 0;
    const T cosine = std::abs(dot(w, cross(a, b))) / area();
    return hit->z * hit->z / (cosine * area());
  }
  T value(const Xyz<T>& w) const {
    const auto hit = meet(w);
    if (!hit) return 0;
    const T radiance = T(0.5) + hit->x * hit->y;
    return fault == 2 ? 2 * radiance : radiance;
  }
};

/// A lamp's shade as a mesh, a triangle of it by its area; the first number is stretched.
template <class T>
struct ShadeOfMesh {
  int fault;
  std::array<Facet<T>, 4> facets{
      {{{1, T(-0.5), T(-0.5)}, {T(1.2), 1, T(-0.5)}, {1, 0, 1}},
       {{T(-0.5), 1, T(-0.3)}, {T(-0.8), T(1.2), T(0.4)}, {T(0.1), T(1.1), T(0.5)}},
       {{-2, T(-0.4), T(-0.6)}, {-2, T(-1.4), T(0.2)}, {-2, T(0.8), T(0.9)}},
       {{T(-0.3), T(-0.4), -1}, {T(0.5), T(-0.2), T(-1.1)}, {T(0.1), T(0.4), T(-0.9)}}}};

  Odds<T> odds() const {
    std::vector<T> areas;
    for (const Facet<T>& f : facets) areas.push_back(f.area());
    return Odds<T>(fault == 2 ? std::vector<T>(4, T(1)) : areas);
  }
  Xyz<T> sample(T u, T v) const {
    const Facet<T>& f = facets[static_cast<std::size_t>(odds().pick(u))];
    const T root = std::sqrt(u);
    return normalized((1 - root) * f.a + (root * (1 - v)) * f.b + (root * v) * f.c);
  }
  T pdf(const Xyz<T>& w) const {
    T total = 0, q = 0;
    for (const Facet<T>& f : facets) total += fault == 3 ? 2 * f.area() : f.area();
    for (const Facet<T>& f : facets) {
      const auto d = f.meet(w);
      if (!d) continue;
      const T cosine = std::abs(dot(w, normalized(f.normal())));
      q += *d * *d / (cosine * (fault == 1 ? f.area() : total));
    }
    return q;
  }
};

/// A spot with a soft rim: even inside, falling to 0 over a ramp in the cosine.
template <class T>
struct SoftSpot {
  int fault;
  T inner = T(0.9), outer = T(0.7);
  Frame<T> frame{normalized(Xyz<T>{T(0.2), T(0.3), T(-0.9)})};

  T even_share() const {
    const T even = 1 - inner, rim = (inner - outer) / 2;
    return even / (even + rim);
  }
  Xyz<T> sample(T u, T v) const {
    const T p = even_share();
    const T c =
        u < p ? 1 - u / p * (1 - inner) : outer + (inner - outer) * std::sqrt((1 - u) / (1 - p));
    return frame.to_world(around_z(1 - c, 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& w) const {
    const T c = dot(w, frame.z);
    if (!(c >= outer)) return 0;
    const T even = 1 - inner, rim = (inner - outer) / (fault == 1 ? 1 : 2);
    const T p = even / (even + rim);
    if (c >= inner) return p / (2 * pi_v<T> * (1 - inner));
    const T width = inner - outer;
    return (1 - p) * 2 * (c - outer) / (width * width) / (2 * pi_v<T>);
  }
};

/// Eight lamps in a tree, each node by its power over the square of its distance.
template <class T>
struct LampTree {
  int fault;
  std::array<T, 8> power{2, 5, 1, 1, 8, 3, 2, 4};
  std::array<T, 8> distance{1, 3, T(0.7), 2, 4, T(1.5), 1, 2};

  T importance(int from, int to) const {
    T all = 0, away = 0;
    for (int k = from; k < to; ++k) {
      all += power[static_cast<std::size_t>(k)];
      away += distance[static_cast<std::size_t>(k)];
    }
    away /= static_cast<T>(to - from);
    return all / (away * away);
  }
  T first_share(int from, int to, bool of_pdf) const {
    const int middle = (from + to) / 2;
    T a = importance(from, middle), b = importance(middle, to);
    if (of_pdf && fault == 1) {
      a = b = 0;
      for (int k = from; k < to; ++k) (k < middle ? a : b) += power[static_cast<std::size_t>(k)];
    }
    return a / (a + b);
  }
  int sample(T u) const {
    int from = 0, to = 8;
    while (to - from > 1) {
      const T p = first_share(from, to, false);
      const bool first = u < p;
      u = fourth::below_one(first ? u / p : (u - p) / (1 - p));
      (first ? to : from) = (from + to) / 2;
    }
    return from;
  }
  T pdf(int k) const {
    int from = 0, to = 8;
    T probability = 1;
    while (to - from > 1) {
      const T p = first_share(from, to, true);
      const int middle = (from + to) / 2;
      probability *= k < middle ? p : 1 - p;
      (k < middle ? to : from) = middle;
    }
    return probability;
  }
};

/// Half of the time any lamp, half of the time by power, so that none is missed.
template <class T>
struct Cautious {
  int fault;
  Odds<T> odds{{T(3), T(0.1), T(6), T(1), T(0.5), T(2)}};

  int sample(T u) const {
    const bool any = u < T(0.5);
    T left = any ? 2 * u : 2 * u - 1;
    if (fault == 2) left = u;
    return any ? cell_of(left, odds.size()) : odds.pick(left);
  }
  T pdf(int k) const {
    if (fault == 1) return odds[k];
    return odds[k] / 2 + 1 / static_cast<T>(2 * odds.size());
  }
};

template <class T>
Pair cautious(int fault) {
  return pair_of<int>("lamps, cautiously", Domain::discrete(6), Cautious<T>{on(fault)});
}

void add_single_lights(std::vector<Case>& cases) {
  cases.push_back(twin("fourth bulb/radius 0.3 at 1.2/double/ratio not squared",
                       said("pdf has r/d for the square of the cone's sine"), {Kind::constant}, [] {
                         return of_directions("bulb", Bulb<double>{on(1), 1.2, 0.3});
                       }));
  cases.push_back(twin("fourth globe/double/distance of the centre",
                       said("M1: pdf has the square of the centre's distance, not of the point's"),
                       {Kind::distance_or_area}, [] {
                         return of_directions("globe", Globe<double>{on(1), {0.4, 0.6, 1}, 0.6});
                       }));
  cases.push_back(
      twin("fourth globe/double/cosine at the centre",
           said("the cosine is that with the direction of the centre, not the normal's"),
           {Kind::distance_or_area, Kind::cosine}, [] {
             return of_directions("globe", Globe<double>{on(2), {-0.4, 0.6, 1}, 0.7});
           }));
  cases.push_back(twin("fourth screen/double/weight by area",
                       said("T4: the weight is the radiance over 1/area, pdf is per solid angle"),
                       {Kind::weight, Kind::distance_or_area}, [] {
                         return recorded_pair_of<Xyz<double>>("screen", Domain::sphere(),
                                                              Screen<double>{on(1)});
                       }));
  cases.push_back(twin("fourth screen/double/radiance added twice",
                       said("K3: the radiance is added twice in what is hit, once in the weight"),
                       {Kind::value_constant, Kind::weight}, [] {
                         return recorded_pair_of<Xyz<double>>("screen", Domain::sphere(),
                                                              Screen<double>{on(2)});
                       }));
  cases.push_back(twin("fourth soft spot/double/ramp counted in full",
                       said("pdf counts the rim as if it did not fall off, twice"),
                       {Kind::lobe_probability},
                       [] { return of_directions("soft spot", SoftSpot<double>{on(1)}); }));
}

void add_many_lights(std::vector<Case>& cases) {
  cases.push_back(twin("fourth shade of a mesh/double/own area for all of it",
                       said("L17: pdf divides by the triangle's own area, not by the mesh's"),
                       {Kind::choice_probability}, [] {
                         return of_directions("shade of a mesh", ShadeOfMesh<double>{on(1)});
                       }));
  cases.push_back(twin(
      "fourth shade of a mesh/double/triangles evenly",
      said("sample chooses triangles evenly, pdf has them by area"), {Kind::choice_probability},
      [] { return of_directions("shade of a mesh", ShadeOfMesh<double>{on(2)}); }));
  cases.push_back(twin("fourth shade of a mesh/float/area without the half",
                       said("pdf has the cross product's length for the area"),
                       {Kind::constant, Kind::distance_or_area},
                       [] { return of_directions("shade of a mesh", ShadeOfMesh<float>{on(3)}); }));
  cases.push_back(
      twin("fourth lamp tree/8/double/power alone in pdf",
           said("pdf goes down the tree by power, sample by power over distance squared"),
           {Kind::choice_probability},
           [] { return pair_of<int>("lamp tree", Domain::discrete(8), LampTree<double>{on(1)}); }));
  cases.push_back(twin("fourth lamps, cautiously/6/double/by power alone in pdf",
                       said("M9: pmf is that by power, half of the lamps are taken evenly"),
                       {Kind::choice_probability, Kind::lobe_probability},
                       [] { return cautious<double>(1); }));
  cases.push_back(twin("fourth lamps, cautiously/6/float/number not stretched",
                       said("L6: the number that chose the way chooses the lamp as it is"),
                       {Kind::numbers_reused, Kind::choice_probability},
                       [] { return cautious<float>(2); }));
}

}  // namespace

void add_sealed_lights(std::vector<Case>& cases) {
  add_single_lights(cases);
  add_many_lights(cases);
}

}  // namespace plumbline::tests::corpus
