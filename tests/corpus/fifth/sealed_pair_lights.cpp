#include <array>

#include "pair_support.h"
#include "sealed_choice.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

void add_sealed_lights(std::vector<Case>& cases);

namespace fifth {
namespace {

/// A parallelogram, seen from the origin.
template <class T>
struct Quad {
  Xyz<T> corner, a, b;

  Xyz<T> normal() const { return cross(a, b); }
  T area() const { return length(normal()); }
  Xyz<T> point(T u, T v) const { return corner + u * a + v * b; }
  /// Distance along w, 0 where it is missed.
  T meets(const Xyz<T>& w) const {
    const Xyz<T> n = normal();
    const T slant = dot(w, n);
    if (slant == 0) return 0;
    const T t = dot(corner, n) / slant;
    if (!(t > 0)) return 0;
    const Xyz<T> q = t * w - corner;
    const T s = dot(cross(q, b), n), r = dot(cross(a, q), n), all = dot(n, n);
    return s >= 0 && s <= all && r >= 0 && r <= all ? t : T(0);
  }
  T cosine(const Xyz<T>& w) const { return std::abs(dot(w, normal())) / area(); }
};

/// A panel of even light, with a record.
template <class T>
struct Panel {
  int fault;
  Quad<T> quad{{T(-0.7), T(0.9), T(-0.5)}, {T(1.5), T(0.3), T(0)}, {T(0.1), T(0.4), T(1.1)}};

  std::optional<Record<Xyz<T>, T>> sample(T u, T v) const {
    const Xyz<T> w = normalized(quad.point(u, v));
    const T q = pdf(w);
    if (!(q > 0)) return std::nullopt;
    if (fault == 3) return Record<Xyz<T>, T>{w, 1 / quad.area(), value(w) / q};
    return Record<Xyz<T>, T>{w, q, fault == 4 ? value(w) : value(w) / q};
  }
  T pdf(const Xyz<T>& w) const {
    const T t = quad.meets(w);
    if (!(t > 0)) return 0;
    if (fault == 1) return t * t / quad.area();
    if (fault == 2) return t * t * quad.area() / quad.cosine(w);
    if (fault == 5) return t / (quad.cosine(w) * quad.area());
    return t * t / (quad.cosine(w) * quad.area());
  }
  T value(const Xyz<T>& w) const { return quad.meets(w) > 0 ? T(3) : T(0); }
};

template <class T>
Pair panel(int fault) {
  return recorded_pair_of<Xyz<T>>("panel", Domain::sphere(), Panel<T>{put(fault)});
}

/// A ball by the cone around it.
template <class T>
struct Ball {
  int fault;
  T distance, radius;
  Frame<T> towards{normalized(Xyz<T>{T(-0.4), T(0.5), T(-0.7)})};

  T one_minus_edge() const {
    const T sine = radius / distance, s2 = sine * sine;
    if (fault == 2) return 1 - std::sqrt(1 - s2);
    return s2 / (1 + std::sqrt(1 - s2));
  }
  Xyz<T> sample(T u, T v) const {
    return towards.to_world(around_z(u * one_minus_edge(), 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& w) const {
    const T sine = radius / distance, s2 = sine * sine, edge = s2 / (1 + std::sqrt(1 - s2));
    if (!(one_minus_dot(w, towards.z) <= edge)) return 0;
    return 1 / ((fault == 1 ? 1 : 2) * pi_v<T> * edge);
  }
};

template <class T>
Pair ball(int fault, T distance, T radius) {
  return pair_of<Xyz<T>>("ball", Domain::sphere(), Ball<T>{put(fault), distance, radius});
}

/// A round lamp, by its area.
template <class T>
struct Round {
  int fault;
  T radius = T(0.8);
  Xyz<T> centre{T(0.3), T(-1), T(0.6)};
  Frame<T> facing{normalized(Xyz<T>{T(0.1), T(0.9), T(-0.6)})};

  Xyz<T> sample(T u, T v) const {
    const T r = radius * (fault == 1 ? u : std::sqrt(u)), turn = 2 * pi_v<T> * v;
    const Xyz<T> on{r * std::cos(turn), r * std::sin(turn), T(0)};
    return normalized(centre + facing.to_world(on));
  }
  T pdf(const Xyz<T>& w) const {
    const T cosine = -dot(w, facing.z);
    if (!(cosine > 0)) return 0;
    const T t = -dot(centre, facing.z) / cosine;
    if (!(length(t * w - centre) <= radius)) return 0;
    return t * t / (cosine * pi_v<T> * radius * radius);
  }
};

/// A tube by its side; a point on the part that faces away is given up.
template <class T>
struct Tube {
  int fault;
  T radius = T(0.4), half = T(0.7);
  Xyz<T> centre{T(1.1), T(0.4), T(-0.5)};
  Frame<T> along{normalized(Xyz<T>{T(0.2), T(-0.3), T(0.8)})};

  std::optional<Xyz<T>> sample(T u, T v) const {
    const T turn = 2 * pi_v<T> * u;
    const Xyz<T> n{std::cos(turn), std::sin(turn), T(0)};
    const Xyz<T> p =
        along.to_local(centre) + Xyz<T>{radius * n.x, radius * n.y, (2 * v - 1) * half};
    if (!(dot(p, n) < 0)) return std::nullopt;
    return normalized(along.to_world(p));
  }
  T pdf(const Xyz<T>& world) const {
    const Xyz<T> w = along.to_local(world), c = along.to_local(centre);
    const T flat = w.x * w.x + w.y * w.y, b = w.x * c.x + w.y * c.y;
    const T root2 = b * b - flat * (c.x * c.x + c.y * c.y - radius * radius);
    if (!(b > 0) || !(root2 > 0)) return 0;
    const T t = (b - std::sqrt(root2)) / flat;
    if (!(std::abs(t * w.z - c.z) <= half)) return 0;
    const T cosine = ((c.x - t * w.x) * w.x + (c.y - t * w.y) * w.y) / radius;
    const T area = (fault == 1 ? 2 : 4) * pi_v<T> * radius * half;
    return t * t / (cosine * area);
  }
};

/// Which of some lamps, after their power.
template <class T>
struct ByPower {
  int fault;
  std::vector<T> power{T(40), T(5), T(100), T(15), T(60), T(25), T(8)};
  Choice<T> lamps{power};

  int sample(T u) const { return lamps.index(u); }
  T pdf(int k) const {
    if (fault == 1) return at(power, k);
    if (fault == 2) return lamps.probability((k + 1) % lamps.count());
    return lamps.probability(k);
  }
};

template <class T>
Pair by_power(int fault) {
  return pair_of<int>("lamps by power", Domain::discrete(7), ByPower<T>{put(fault)});
}

/// Two windows of a room, one of them brighter; the first number chooses as well.
template <class T>
struct Windows {
  int fault;
  std::array<Quad<T>, 2> panes{
      {{{T(1), T(-0.8), T(-0.4)}, {T(0.2), T(1.2), T(0)}, {T(0), T(0.1), T(0.9)}},
       {{T(-0.9), T(-1.4), T(-0.2)}, {T(0.9), T(0.1), T(0.1)}, {T(0), T(-0.2), T(1)}}}};
  Choice<T> which{{T(3), T(1)}};
  std::shared_ptr<std::size_t> last = std::make_shared<std::size_t>(0);

  Xyz<T> sample(T u, T v) const {
    const int k = which.index(u);
    *last = static_cast<std::size_t>(k);
    return normalized(
        panes[static_cast<std::size_t>(k)].point(fault == 2 ? u : which.left(u, k), v));
  }
  T pdf(const Xyz<T>& w) const {
    for (std::size_t k = 0; k < 2; ++k) {
      const T t = panes[k].meets(w);
      if (!(t > 0)) continue;
      const Quad<T>& shape = panes[fault == 3 ? *last : k];
      const T p = fault == 1 ? T(1) : which.probability(static_cast<int>(k));
      return p * t * t / (shape.cosine(w) * shape.area());
    }
    return 0;
  }
};

template <class T>
Pair windows(int fault) {
  return pair_of<Xyz<T>>("windows", Domain::sphere(), Windows<T>{put(fault)});
}

/// An overcast sky above ground that slopes, by the cosine.
template <class T>
struct Overcast {
  int fault;
  Frame<T> ground{normalized(Xyz<T>{T(0.4), T(0.2), T(0.8)})};

  Xyz<T> sample(T u, T v) const {
    const T r = std::sqrt(u), turn = 2 * pi_v<T> * v;
    const Xyz<T> w{r * std::cos(turn), r * std::sin(turn), std::sqrt(std::max(T(0), 1 - u))};
    return ground.to_world(w);
  }
  T pdf(const Xyz<T>& w) const {
    return std::max(T(0), fault == 1 ? w.z : dot(w, ground.z)) / pi_v<T>;
  }
};

void add_panels(std::vector<Case>& cases) {
  cases.push_back(twin("fifth panel/double/cosine at the panel forgotten",
                       because("pdf has the distance squared over the area, without the cosine"),
                       {Kind::distance_or_area, Kind::cosine}, [] { return panel<double>(1); }));
  cases.push_back(twin("fifth panel/float/area for 1/area",
                       because("L2: pdf is multiplied by the area"),
                       {Kind::distance_or_area, Kind::constant}, [] { return panel<float>(2); }));
  cases.push_back(twin("fifth panel/double/record per area",
                       because("T4: the record states 1/area, pdf() is per solid angle"),
                       {Kind::record_pdf, Kind::distance_or_area},
                       [] { return panel<double>(3); }));
  cases.push_back(twin("fifth panel/double/radiance for weight",
                       because("the record has the radiance where the weight should be"),
                       {Kind::weight}, [] { return panel<double>(4); }));
  cases.push_back(twin("fifth panel/double/distance not squared",
                       because("pdf has the distance, not its square"), {Kind::distance_or_area},
                       [] { return panel<double>(5); }));
  cases.push_back(twin("fifth windows/double/choice not in pdf",
                       because("M7: pdf lacks the probability of choosing the window"),
                       {Kind::choice_probability, Kind::lobe_probability},
                       [] { return windows<double>(1); }));
  cases.push_back(twin("fifth windows/float/number not stretched",
                       because("L6: the number that chose the window is its place as it is"),
                       {Kind::numbers_reused}, [] { return windows<float>(2); }));
  cases.push_back(twin("fifth windows/double/the window before",
                       because("pdf has area and cosine of the window that was sampled last"),
                       {Kind::stale_state}, [] { return windows<double>(3); }));
}

}  // namespace
}  // namespace fifth

void add_sealed_lights(std::vector<Case>& cases) {
  using namespace fifth;
  add_panels(cases);
  cases.push_back(twin("fifth ball/radius 0.5 at 1.5/double/2 forgotten",
                       because("pdf has pi (1 - cos) for the cone's solid angle"), {Kind::constant},
                       [] { return ball<double>(1, 1.5, 0.5); }));
  cases.push_back(twin("fifth ball/radius 0.02 at 20/float/1 - cos",
                       because("L4: sample has 1 - cos of a narrow cone in float"),
                       {Kind::precision, Kind::constant},
                       [] { return ball<float>(2, 20, 0.02F); }));
  cases.push_back(twin(
      "fifth round lamp/double/radius without root",
      because("points crowd in the middle: the radius is u, not its root"), {Kind::radius},
      [] { return pair_of<Xyz<double>>("round lamp", Domain::sphere(), Round<double>{put(1)}); }));
  cases.push_back(
      twin("fifth tube/double/half of the area",
           because("pdf has the side of a tube half as long for the whole side"),
           {Kind::constant, Kind::distance_or_area},
           [] { return pair_of<Xyz<double>>("tube", Domain::sphere(), Tube<double>{put(1)}); }));
  cases.push_back(twin("fifth lamps by power/7/float/power for probability",
                       because("pmf is the power, not divided by that of all"),
                       {Kind::constant, Kind::choice_probability},
                       [] { return by_power<float>(1); }));
  cases.push_back(
      twin("fifth lamps by power/7/double/next lamp", because("pmf is that of the lamp after"),
           {Kind::shifted, Kind::choice_probability}, [] { return by_power<double>(2); }));
  cases.push_back(twin(
      "fifth overcast/float/flat ground in pdf",
      because("pdf has the cosine with z, sample turns to the ground's normal"),
      {Kind::tangent_frame},
      [] { return pair_of<Xyz<float>>("overcast", Domain::sphere(), Overcast<float>{put(1)}); }));
}

}  // namespace plumbline::tests::corpus
