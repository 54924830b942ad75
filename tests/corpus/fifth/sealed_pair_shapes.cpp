#include <array>

#include "pair_support.h"
#include "sealed_choice.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

void add_sealed_shapes(std::vector<Case>& cases);

namespace fifth {
namespace {

/// A triangle in barycentric coordinates.
template <class T>
struct Barycentric {
  int fault;

  Xy<T> sample(T u, T v) const {
    const T root = fault == 1 ? u : std::sqrt(u);
    return {1 - root, v * root};
  }
  T pdf(const Xy<T>& p) const { return p.x >= 0 && p.y >= 0 && p.x + p.y <= 1 ? T(2) : T(0); }
};

/// The same from a square that is folded along its diagonal.
template <class T>
struct Folded {
  int fault;

  Xy<T> sample(T u, T v) const {
    if (u + v > 1 && fault != 1) return {1 - u, 1 - v};
    return {u, v};
  }
  T pdf(const Xy<T>& p) const { return p.x >= 0 && p.y >= 0 && p.x + p.y <= 1 ? T(2) : T(0); }
};

/// The mirror of a telescope, with its hole.
template <class T>
struct Holed {
  int fault;
  T hole = T(0.35);

  Xy<T> sample(T u, T v) const {
    const T r = fault == 1 ? hole + u * (1 - hole) : std::sqrt(hole * hole + u * (1 - hole * hole));
    const T turn = 2 * pi_v<T> * v;
    return {r * std::cos(turn), r * std::sin(turn)};
  }
  T pdf(const Xy<T>& p) const {
    const T r = std::hypot(p.x, p.y);
    return r >= hole && r <= 1 ? 1 / (pi_v<T> * (1 - hole * hole)) : T(0);
  }
};

/// A stop of blades: one of the triangles from the middle, and a point in it.
template <class T>
struct Blades {
  int fault;
  int count = 7;

  T wedge() const { return 2 * pi_v<T> / static_cast<T>(count); }
  Xy<T> sample(T u, T v) const {
    const int k = cell_of(u, count);
    const T left = fault == 1 ? u : short_of_one(u * static_cast<T>(count) - static_cast<T>(k));
    const T root = std::sqrt(left), a = static_cast<T>(k) * wedge(), b = a + wedge();
    const T s = root * (1 - v), t = root * v;
    return {s * std::cos(a) + t * std::cos(b), s * std::sin(a) + t * std::sin(b)};
  }
  T pdf(const Xy<T>& p) const {
    // Within the triangle of its wedge where it lies before the blade's edge.
    const T turn = share_of_turn(p.y, p.x) * static_cast<T>(count);
    const T middle = (std::floor(turn) + T(0.5)) * wedge();
    if (!(p.x * std::cos(middle) + p.y * std::sin(middle) <= std::cos(wedge() / 2))) return 0;
    if (fault == 2) return 1 / pi_v<T>;
    return 2 / (static_cast<T>(count) * std::sin(wedge()));
  }
};

template <class T>
Pair blades(int fault) {
  return pair_of<Xy<T>>("blades", Domain::disk(), Blades<T>{put(fault)});
}

/// A pixel's tent, over the square that it reaches over.
template <class T>
struct TentFilter {
  int fault;

  static T draw(T u) { return u < T(0.5) ? std::sqrt(u / 2) : 1 - std::sqrt((1 - u) / 2); }
  Xy<T> sample(T u, T v) const { return {draw(u), draw(v)}; }
  T pdf(const Xy<T>& p) const {
    const T x = 1 - std::abs(2 * p.x - 1), y = 1 - std::abs(2 * p.y - 1);
    if (!(x >= 0 && y >= 0)) return 0;
    return fault == 1 ? x * y : 4 * x * y;
  }
};

template <class T>
Pair tent_filter(int fault) {
  Pair pair = pair_of<Xy<T>>("tent filter", Domain::unit_square(), TentFilter<T>{put(fault)});
  pair.domain = pair.domain.with_breaks({0.5}, {0.5});
  return pair;
}

/// Directions within an angle of an axis.
template <class T>
struct Cap {
  int fault;
  T angle = T(0.9);
  Frame<T> axis{normalized(Xyz<T>{T(0.7), T(-0.1), T(0.3)})};

  static T one_minus_cos(T x) { return 2 * std::sin(x / 2) * std::sin(x / 2); }
  Xyz<T> sample(T u, T v) const {
    return axis.to_world(around_z(u * one_minus_cos(angle), 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& w) const {
    const T bound = one_minus_cos(fault == 1 ? angle / 2 : angle);
    return one_minus_dot(w, axis.z) <= bound ? 1 / (2 * pi_v<T> * one_minus_cos(angle)) : T(0);
  }
};

/// The side of a lampshade that tapers to a point at the origin.
template <class T>
struct Shade {
  int fault;
  T wide = T(0.7);

  Xyz<T> sample(T u, T v) const {
    const T s = fault == 1 ? u : std::sqrt(u), turn = 2 * pi_v<T> * v;
    return {s * wide * std::cos(turn), s * wide * std::sin(turn), s};
  }
  T pdf(const Xyz<T>& p) const {
    if (!(p.z >= 0 && p.z <= 1)) return 0;
    return 1 / (pi_v<T> * wide * std::sqrt(1 + wide * wide));
  }
};

Pair shade(int fault) {
  const double wide = 0.7, slope = std::sqrt(1 + wide * wide);
  const auto put_on = [wide](const verify::Point2& p) {
    const double turn = 2 * pi_v<double> * p[1];
    return verify::Vec3{p[0] * wide * std::cos(turn), p[0] * wide * std::sin(turn), p[0]};
  };
  const auto back = [](const verify::Vec3& x) {
    return verify::Point2{x[2], share_of_turn(x[1], x[0])};
  };
  const auto element = [wide, slope](const verify::Point2& p) {
    return 2 * pi_v<double> * wide * p[0] * slope;
  };
  return pair_of<Xyz<double>>("shade", Domain::surface(put_on, back, element),
                              Shade<double>{put(fault), wide});
}

}  // namespace
}  // namespace fifth

void add_sealed_shapes(std::vector<Case>& cases) {
  using namespace fifth;
  cases.push_back(twin("fifth barycentric/float/no root",
                       because("sample takes u for its square root"), {Kind::radius}, [] {
                         return pair_of<Xy<float>>("barycentric", Domain::triangle(),
                                                   Barycentric<float>{put(1)});
                       }));
  cases.push_back(twin("fifth folded/double/not folded",
                       because("the half of the square beyond the diagonal is not folded back"),
                       {Kind::support, Kind::not_rejected}, [] {
                         Pair pair = pair_of<Xy<double>>("folded", Domain::triangle(),
                                                         Folded<double>{put(1)});
                         pair.many_to_one = true;
                         return pair;
                       }));
  cases.push_back(twin(
      "fifth holed mirror/double/radius evenly",
      because("sample goes from the hole to the rim evenly in the radius"), {Kind::radius}, [] {
        return pair_of<Xy<double>>("holed mirror", Domain::disk().with_breaks({0.35 * 0.35}),
                                   Holed<double>{put(1)});
      }));
  cases.push_back(twin("fifth blades/7/double/number not stretched",
                       because("L6: the number that chose the triangle is its root as it is"),
                       {Kind::numbers_reused}, [] { return blades<double>(1); }));
  cases.push_back(twin("fifth blades/7/float/disk's area",
                       because("pdf is 1/pi, that of the disk around the polygon"),
                       {Kind::constant}, [] { return blades<float>(2); }));
  cases.push_back(twin("fifth tent filter/double/not normalised",
                       because("pdf is the filter, 1 in its middle"), {Kind::constant},
                       [] { return tent_filter<double>(1); }));
  cases.push_back(
      twin("fifth cap/double/half the angle in pdf",
           because("pdf ends at half of the angle that sample goes to"), {Kind::support},
           [] { return pair_of<Xyz<double>>("cap", Domain::sphere(), Cap<double>{put(1)}); }));
  cases.push_back(twin("fifth shade/double/height evenly",
                       because("sample is even in the height, not in the area"),
                       {Kind::radius, Kind::distance_or_area}, [] { return shade(1); }));
}

}  // namespace plumbline::tests::corpus
