#include <array>

#include "pair_support.h"
#include "sealed_switch.h"
#include "sealed_tables.h"

namespace plumbline::tests::corpus {

void add_sealed_shapes(std::vector<Case>& cases);

namespace {

using fourth::Odds;
using fourth::on;
using fourth::said;

/// The iris of a lens, turned on its axis. The first number chooses a blade, and is stretched.
template <class T>
struct TurnedIris {
  int fault;
  int blades;
  T turn;

  T corner(int k, T from) const {
    return from + 2 * pi_v<T> * static_cast<T>(k) / static_cast<T>(blades);
  }
  Xy<T> sample(T u, T v) const {
    const T scaled = u * static_cast<T>(blades);
    const int k = std::min(static_cast<int>(scaled), blades - 1);
    const T root = std::sqrt(std::min(scaled - static_cast<T>(k), T(1)));
    const T a = root * (1 - v), b = root * v;
    return {a * std::cos(corner(k, turn)) + b * std::cos(corner(k + 1, turn)),
            a * std::sin(corner(k, turn)) + b * std::sin(corner(k + 1, turn))};
  }
  T pdf(const Xy<T>& p) const {
    const T half = pi_v<T> / static_cast<T>(blades);
    for (int k = 0; k < blades; ++k) {
      const T middle = corner(k, fault == 1 ? T(0) : turn) + half;
      if (p.x * std::cos(middle) + p.y * std::sin(middle) > std::cos(half)) return 0;
    }
    const T area = static_cast<T>(blades) * std::sin(2 * half) / 2;
    return fault == 2 ? area : 1 / area;
  }
};

/// A lens by a map that keeps squares around the middle together.
///
/// @source Shirley, Chiu 1997, "A Low Distortion Map Between Disk and Square"
template <class T>
struct RoundLens {
  int fault;
  T radius;

  Xy<T> sample(T u, T v) const {
    const T a = 2 * u - 1, b = 2 * v - 1;
    if (a == 0 && b == 0) return {0, 0};
    const bool wide = std::abs(a) > std::abs(b);
    const T r = radius * (wide ? a : b);
    T phi = pi_v<T> / 4 * (wide ? b / a : a / b);
    if (!wide && fault != 1) phi = pi_v<T> / 2 - phi;
    return {r * std::cos(phi), r * std::sin(phi)};
  }
  T pdf(const Xy<T>& p) const {
    return p.x * p.x + p.y * p.y <= radius * radius ? 1 / (pi_v<T> * radius * radius) : T(0);
  }
};

/// Where light leaves wax: a sum of Gaussians over the distance, each cut off at the same one.
///
/// @source d'Eon, Luebke 2007 (GPU Gems 3), "Advanced Techniques for Realistic Real-Time Skin
/// Rendering"
template <class T>
struct Wax {
  int fault;
  T most = 2;
  Odds<T> odds{{T(0.2), T(0.5), T(0.3)}};
  std::array<T, 3> variance{T(0.02), T(0.1), T(0.5)};

  T inside(std::size_t k) const { return -std::expm1(-most * most / (2 * variance[k])); }
  Xy<T> sample(T u, T v) const {
    T left = u;
    const auto k = static_cast<std::size_t>(odds.pick(left));
    if (fault == 2) left = u;
    const T r = std::min(most, std::sqrt(-2 * variance[k] * std::log1p(-left * inside(k))));
    return {r * std::cos(2 * pi_v<T> * v), r * std::sin(2 * pi_v<T> * v)};
  }
  T pdf(const Xy<T>& p) const {
    const T r2 = p.x * p.x + p.y * p.y;
    if (!(r2 <= most * most)) return 0;
    T q = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const T share = odds[static_cast<int>(fault == 1 ? 2 - k : k)];
      q += share * std::exp(-r2 / (2 * variance[k])) / (2 * pi_v<T> * variance[k] * inside(k));
    }
    return q;
  }
};

/// Positions on a pixel by a tent, both ways.
template <class T>
struct TentPixel {
  int fault;

  static T draw(T u) { return u < T(0.5) ? std::sqrt(u / 2) : 1 - std::sqrt((1 - u) / 2); }
  static T height(T x) { return 2 - std::abs(4 * x - 2); }
  Xy<T> sample(T u, T v) const { return {draw(u), draw(v)}; }
  T pdf(const Xy<T>& p) const { return height(p.x) * height(p.y) / (fault == 1 ? 2 : 1); }
};

/// The picture of a highlight out of focus, by rows.
template <class T>
struct Bokeh {
  static constexpr int kSide = 6;
  int fault;
  std::vector<Odds<T>> rows;  ///< the last one chooses among the others

  explicit Bokeh(int which) : fault(which) {
    std::vector<T> light;
    for (int j = 0; j < kSide; ++j) {
      std::vector<T> row;
      for (int i = 0; i < kSide; ++i) {
        row.push_back(T(0.3) + static_cast<T>(j) / 4 + static_cast<T>((i * 5 + j * 3) % 7) / 5);
      }
      light.push_back(std::accumulate(row.begin(), row.end(), T(0)));
      rows.emplace_back(std::move(row));
    }
    rows.emplace_back(std::move(light));
  }
  Xy<T> sample(T u, T v) const {
    const int j = rows.back().pick(v), i = rows[static_cast<std::size_t>(j)].pick(u);
    return {(static_cast<T>(i) + u) / kSide, (static_cast<T>(j) + v) / kSide};
  }
  T pdf(const Xy<T>& p) const {
    int j = cell_of(p.y, kSide);
    if (fault == 1) j = kSide - 1 - j;
    const T of_row = rows[static_cast<std::size_t>(j)][cell_of(p.x, kSide)];
    return rows.back()[j] * of_row * kSide * kSide;
  }
};

}  // namespace

void add_sealed_shapes(std::vector<Case>& cases) {
  cases.push_back(twin("fourth turned iris/5/double/not turned in pdf",
                       said("pdf holds points against the blades before they are turned"),
                       {Kind::tangent_frame}, [] {
                         return pair_of<Xy<double>>("turned iris", Domain::disk(),
                                                    TurnedIris<double>{on(1), 5, 0.35});
                       }));
  cases.push_back(twin(
      "fourth turned iris/7/float/area for 1/area",
      said("L2: pdf is the area where its inverse belongs"),
      {Kind::constant, Kind::distance_or_area}, [] {
        return pair_of<Xy<float>>("turned iris", Domain::disk(), TurnedIris<float>{on(2), 7, 0.2F});
      }));
  cases.push_back(twin(
      "fourth round lens/radius 1.5/float/quarter turn forgotten",
      said("the second branch lacks π/2 − and falls where the first one does"), {Kind::support},
      [] {
        return pair_of<Xy<float>>("round lens", Domain::disk(1.5), RoundLens<float>{on(1), 1.5F});
      }));
  cases.push_back(twin("fourth wax/double/shares from the other end",
                       said("pdf has the first Gaussian's share for the last and the reverse"),
                       {Kind::lobe_probability}, [] {
                         return pair_of<Xy<double>>("wax", Domain::disk(2), Wax<double>{on(1)});
                       }));
  cases.push_back(twin("fourth wax/float/number not stretched",
                       said("L6: the number that chose the Gaussian is the distance's as it is"),
                       {Kind::numbers_reused}, [] {
                         return pair_of<Xy<float>>("wax", Domain::disk(2), Wax<float>{on(2)});
                       }));
  cases.push_back(twin("fourth tent on a pixel/float/height of one tent",
                       said("pdf has 1/r of one axis only"), {Kind::constant}, [] {
                         return pair_of<Xy<float>>("tent on a pixel", Domain::unit_square(),
                                                   TentPixel<float>{on(1)});
                       }));
  cases.push_back(twin(
      "fourth bokeh/6x6/double/upside down", said("pdf reads the picture upside down"),
      {Kind::mirrored},
      [] { return pair_of<Xy<double>>("bokeh", Domain::unit_square(), Bokeh<double>(on(1))); }));
}

}  // namespace plumbline::tests::corpus
