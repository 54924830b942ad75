#include <array>
#include <limits>

#include "pair_support.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

void add_sealed_lights(std::vector<Case>& cases);

namespace {

using fresh::on;
using fresh::said;

/// A spot: directions uniform within an angle of its axis.
template <class T>
struct Spot {
  int fault;
  T angle;
  Frame<T> frame;

  T cap() const {
    const T s = std::sin(angle / 2);
    return fault == 3 ? 1 - std::cos(angle) : 2 * s * s;
  }
  Xyz<T> sample(T u, T v) const {
    const T s = std::sin(angle / 2);
    const T away = fault == 2 ? 1 - std::cos(u * angle) : u * 2 * s * s;
    return frame.to_world(around_z(away, 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& w) const {
    const T s = std::sin(angle / 2);
    if (!(one_minus_dot(w, frame.z) <= 2 * s * s)) return 0;
    return 1 / ((fault == 1 ? 4 : 2) * pi_v<T> * cap());
  }
};

template <class T>
Frame<T> spot_axis() {
  return Frame<T>(normalized(Xyz<T>{T(0.3), T(-0.5), T(0.7)}));
}

/// Where a ray along w from the origin meets the plane of p, a, b, in coordinates along a and b.
template <class T>
struct Hit {
  T s, t, distance, cosine;
};

template <class T>
std::optional<Hit<T>> meet(const Xyz<T>& p, const Xyz<T>& a, const Xyz<T>& b, const Xyz<T>& w) {
  const Xyz<T> c = cross(w, b);
  const T det = dot(a, c);
  if (det == 0) return std::nullopt;
  const Xyz<T> from = T(-1) * p, q = cross(from, a);
  const T d = dot(b, q) / det;
  if (!(d > 0)) return std::nullopt;
  return Hit<T>{dot(from, c) / det, dot(w, q) / det, d, std::abs(dot(w, normalized(cross(a, b))))};
}

/// A triangle of a mesh that glows, uniform in area.
template <class T>
struct MeshTriangle {
  int fault;
  Xyz<T> p, a, b;

  Xyz<T> sample(T u, T v) const {
    T s = 1 - std::sqrt(u), t = v * std::sqrt(u);
    if (fault == 1) s = u, t = v * (1 - u);
    return normalized(p + s * a + t * b);
  }
  T pdf(const Xyz<T>& w) const {
    const auto hit = meet(p, a, b, w);
    if (!hit || !(hit->s >= 0 && hit->t >= 0 && hit->s + hit->t <= 1)) return 0;
    const T area = length(cross(a, b)) / 2;
    const T cosine = fault == 2 ? std::abs(dot(w, cross(a, b))) : hit->cosine;
    return hit->distance * hit->distance / (area * cosine);
  }
};

/// A panel on the ceiling, radiance from its middle to its rim.
template <class T>
struct Panel {
  int fault;
  Xyz<T> p, a, b;

  std::optional<Record<Xyz<T>, T>> sample(T u, T v) const {
    const Xyz<T> at = p + u * a + v * b;
    const Xyz<T> w = normalized(at);
    const T density = pdf(w);
    if (!(density > 0)) return std::nullopt;
    const T stated = fault == 2 ? 1 / length(cross(a, b)) : density;
    return Record<Xyz<T>, T>{w, stated, value(w) / (fault == 4 ? stated * stated : stated)};
  }
  T pdf(const Xyz<T>& w) const {
    const auto hit = meet(p, a, b, w);
    if (!hit || !(hit->s >= 0 && hit->s <= 1 && hit->t >= 0 && hit->t <= 1)) return 0;
    const T area = length(cross(a, b)), square = hit->distance * hit->distance;
    if (fault == 1) return square / (area * std::abs(w.z));
    if (fault == 3) return hit->cosine / (square * area);
    return square / (area * hit->cosine);
  }
  T value(const Xyz<T>& w) const {
    const auto hit = meet(p, a, b, w);
    if (!hit || !(hit->s >= 0 && hit->s <= 1 && hit->t >= 0 && hit->t <= 1)) return 0;
    return 1 + 4 * hit->s * (1 - hit->s) * hit->t * (1 - hit->t);
  }
};

template <class T>
Panel<T> ceiling(int fault) {
  return {on(fault), {T(-0.5), T(0.2), T(1.2)}, {T(1.4), 0, T(0.5)}, {T(0.1), T(1.1), T(-0.3)}};
}

/// Three windows of a room, one of which is chosen by its area; the second number is stretched and
/// used again.
template <class T>
struct Windows {
  int fault;
  struct Window {
    Xyz<T> p, a, b;
    T share;
  };
  std::array<Window, 3> windows{
      {{{1, -1, T(-0.5)}, {0, 2, 0}, {0, 0, 1}, T(0.5)},
       {{-1, T(1.5), T(-0.5)}, {1, 0, 0}, {0, 0, 1}, T(0.25)},
       {{T(-1.8), -1, T(-0.2)}, {0, T(0.8), 0}, {0, 0, T(1.25)}, T(0.25)}}};

  Xyz<T> sample(T u, T v) const {
    std::size_t k = 0;
    T below = 0;
    while (k < 2 && v >= below + windows[k].share) below += windows[k++].share;
    T left = (v - below) / windows[k].share;
    if (fault == 1) left = v;
    if (fault == 2) {
      k = static_cast<std::size_t>(cell_of(v, 3));
      left = v * 3 - static_cast<T>(k);
    }
    left = std::min(left, 1 - std::numeric_limits<T>::epsilon() / 2);
    return normalized(windows[k].p + u * windows[k].a + left * windows[k].b);
  }
  T pdf(const Xyz<T>& w) const {
    T sum = 0;
    for (const Window& window : windows) {
      const auto hit = meet(window.p, window.a, window.b, w);
      if (!hit || !(hit->s >= 0 && hit->s <= 1 && hit->t >= 0 && hit->t <= 1)) continue;
      const T area = length(cross(window.a, window.b));
      const T share = fault == 3 ? T(1) : window.share;
      sum += share * hit->distance * hit->distance / (area * hit->cosine);
    }
    return sum;
  }
};

/// A lantern: a candle's glow upwards, a wide one downwards.
template <class T>
struct Lantern {
  int fault;
  T up = T(0.3);

  Xyz<T> sample(T u, T v) const {
    const bool upwards = u < up;
    const T left = upwards ? u / up : (u - up) / (1 - up);
    const T z = upwards ? std::cbrt(left) : -std::sqrt(left);
    const T r = std::sqrt(std::max(T(0), 1 - z * z)), phi = 2 * pi_v<T> * v;
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  T pdf(const Xyz<T>& w) const {
    if (w.z > 0) return up * 3 * w.z * w.z / (2 * pi_v<T>);
    return (fault == 1 ? up : 1 - up) * -w.z / pi_v<T>;
  }
};

/// A lamp out of many, with odds in proportion to power.
template <class T>
struct LampByPower {
  int fault;
  std::vector<T> power{T(3), T(0.5), T(8), T(1), T(2), T(5), T(0.25), T(4)};

  T total() const {
    T sum = 0;
    for (std::size_t i = 0; i + (fault == 1 ? 1 : 0) < power.size(); ++i) sum += power[i];
    return sum;
  }
  int sample(T u) const {
    T all = 0, below = 0;
    for (const T p : power) all += p;
    int k = 0;
    while (k + 1 < static_cast<int>(power.size()) && u * all >= below + at(power, k)) {
      below += at(power, k++);
    }
    return fault == 2 ? std::min(k + 1, static_cast<int>(power.size()) - 1) : k;
  }
  T pdf(int k) const { return at(power, k) / total(); }
};

template <template <class> class Technique, class T>
Pair of_directions(std::string name, Technique<T> technique) {
  return pair_of<Xyz<T>>(std::move(name), Domain::sphere(), std::move(technique));
}

template <class T>
Pair panel(int fault) {
  return recorded_pair_of<Xyz<T>>("panel", Domain::sphere(), ceiling<T>(fault));
}

template <class T>
Pair lamp(int fault) {
  return pair_of<int>("lamp by power", Domain::discrete(8), LampByPower<T>{on(fault)});
}

void add_spots(std::vector<Case>& cases) {
  cases.push_back(twin("fresh spot/40 degrees/float/4π for 2π",
                       said("pdf is 1/(4π(1 − cos)), twice 2π"), {Kind::constant}, [] {
                         return of_directions("spot", Spot<float>{on(1), 0.7F, spot_axis<float>()});
                       }));
  cases.push_back(
      twin("fresh spot/0.15 degrees/float/1 − cos",
           said("L4: the solid angle from 1 − cosθ_max in float"),
           {Kind::precision, Kind::constant}, [] {
             return of_directions("spot", Spot<float>{on(3), 0.0026F, spot_axis<float>()});
           }));
}

void add_areas(std::vector<Case>& cases) {
  cases.push_back(twin(
      "fresh mesh triangle/float/no root", said("s = u, t = v(1 − u): no root"), {Kind::radius},
      [] {
        return of_directions(
            "mesh triangle",
            MeshTriangle<float>{on(1), {-0.4F, -0.6F, 1}, {1.6F, 0.2F, 0.4F}, {0.1F, 1.3F, -0.2F}});
      }));
  cases.push_back(
      twin("fresh mesh triangle/double/normal not normalised",
           said("the cosine is taken with the cross product of the edges as it is"),
           {Kind::constant, Kind::distance_or_area}, [] {
             return of_directions(
                 "mesh triangle",
                 MeshTriangle<double>{on(2), {-0.4, -0.6, 1}, {1.6, 0.2, 0.4}, {0.1, 1.3, -0.2}});
           }));
  cases.push_back(twin("fresh panel/double/cosine of the receiver",
                       said("the cosine is that at the shaded point, not at the light"),
                       {Kind::distance_or_area, Kind::cosine}, [] { return panel<double>(1); }));
  cases.push_back(twin("fresh panel/float/record per area",
                       said("T4: the record is per area, pdf() per solid angle"),
                       {Kind::record_pdf, Kind::distance_or_area}, [] { return panel<float>(2); }));
}

void add_choices(std::vector<Case>& cases) {
  cases.push_back(twin("fresh windows/double/number not stretched",
                       said("L6: the number that chose the window is the place in it as it is"),
                       {Kind::numbers_reused},
                       [] { return of_directions("windows", Windows<double>{on(1)}); }));
  cases.push_back(twin("fresh windows/float/no choice in pdf",
                       said("L17: pdf lacks the probability that the window was chosen"),
                       {Kind::choice_probability},
                       [] { return of_directions("windows", Windows<float>{on(3)}); }));
  cases.push_back(twin("fresh lantern/float/share of the upper half below",
                       said("pdf has the probability of the upper half for the lower one too"),
                       {Kind::constant_per_hemisphere, Kind::choice_probability},
                       [] { return of_directions("lantern", Lantern<float>{on(1)}); }));
  cases.push_back(twin("fresh lamp by power/double/total without the last",
                       said("pdf divides by a total that lacks the last lamp"),
                       {Kind::choice_probability, Kind::constant}, [] { return lamp<double>(1); }));
}

}  // namespace

void add_sealed_lights(std::vector<Case>& cases) {
  add_spots(cases);
  add_areas(cases);
  add_choices(cases);
}

}  // namespace plumbline::tests::corpus
