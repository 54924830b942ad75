#include <array>

#include "pair_support.h"
#include "sealed_switch.h"
#include "sealed_tables.h"

namespace plumbline::tests::corpus {

void add_sealed_maps(std::vector<Case>& cases);

namespace {

using fourth::Odds;
using fourth::of_directions;
using fourth::on;
using fourth::said;

/// A sky that a scene has tilted: rows by their light, a texel of the row.
template <class T>
struct TiltedSky {
  static constexpr int kWide = 16, kHigh = 8;
  int fault;
  Frame<T> world;
  std::vector<Odds<T>> rows;
  std::vector<Odds<T>> choice, stated;  ///< of rows: for sample, for pdf; one of each

  TiltedSky(int which, const Xyz<T>& up) : fault(which), world(up) {
    std::vector<T> by_middle, by_edge;
    for (int j = 0; j < kHigh; ++j) {
      std::vector<T> row;
      for (int i = 0; i < kWide; ++i) {
        row.push_back(T(0.5) + static_cast<T>((i * 3 + j * 5) % 7) / 2);
      }
      const T light = std::accumulate(row.begin(), row.end(), T(0));
      by_middle.push_back(light * sine(static_cast<T>(j) + T(0.5)));
      by_edge.push_back(light * sine(static_cast<T>(j) + T(1)));
      rows.emplace_back(std::move(row));
    }
    choice.emplace_back(fault == 2 ? by_edge : by_middle);
    stated.emplace_back(by_middle);
  }
  static T sine(T row) { return std::max(T(0), std::sin(pi_v<T> * row / kHigh)); }

  Xyz<T> sample(T u, T v) const {
    const int j = choice.front().pick(v), i = rows[static_cast<std::size_t>(j)].pick(u);
    const T phi = 2 * pi_v<T> * (static_cast<T>(i) + u) / kWide;
    const T theta = pi_v<T> * (static_cast<T>(j) + v) / kHigh, r = std::sin(theta);
    return world.to_world({r * std::cos(phi), r * std::sin(phi), std::cos(theta)});
  }
  T pdf(const Xyz<T>& given) const {
    const Xyz<T> w = fault == 1 ? world.to_world(given) : world.to_local(given);
    const T r = std::sqrt(w.x * w.x + w.y * w.y);
    if (!(r > 0)) return 0;
    const int i = cell_of(fourth::turn_of(w.x, w.y), kWide);
    const int j = cell_of(std::atan2(r, w.z) / pi_v<T>, kHigh);
    const T probability = stated.front()[j] * rows[static_cast<std::size_t>(j)][i];
    return probability * kWide * kHigh / (2 * pi_v<T> * pi_v<T> * r);
  }
};

template <class T>
Pair tilted_sky(int fault) {
  const Xyz<T> up = normalized(Xyz<T>{T(0.3), T(-0.4), T(0.8)});
  const TiltedSky<T> sky(on(fault), up);
  Pair pair = pair_of<Xyz<T>>("tilted sky", Domain::sphere(), sky);
  const auto wide = [](const Xyz<T>& w) {
    return Xyz<double>{static_cast<double>(w.x), static_cast<double>(w.y),
                       static_cast<double>(w.z)};
  };
  const Xyz<double> z = normalized(wide(up)), near_x = wide(sky.world.x);
  const Xyz<double> x = normalized(near_x - dot(near_x, z) * z);
  pair.domain = Domain::equirectangular(16, 8, {z.x, z.y, z.z}, {x.x, x.y, x.z});
  return pair;
}

/// A sky on the faces of a cube, a texel by its light, all of it uniform in the plane of the face.
template <class T>
struct CubeSky {
  static constexpr int kSide = 3, kCells = 6 * kSide * kSide;
  int fault;
  std::vector<Odds<T>> texels;  ///< one

  explicit CubeSky(int which) : fault(which) {
    std::vector<T> light;
    for (int k = 0; k < kCells; ++k) {
      const int face = k / (kSide * kSide);
      light.push_back((T(0.5) + static_cast<T>(k * 7 % 5) / 3) * (1 + static_cast<T>(face) / 2));
    }
    texels.emplace_back(std::move(light));
  }
  Xyz<T> sample(T u, T v) const {
    const int k = texels.front().pick(u), face = k / (kSide * kSide);
    const T s = 2 * (static_cast<T>(k % kSide) + u) / kSide - 1;
    const T t = 2 * (static_cast<T>(k / kSide % kSide) + v) / kSide - 1;
    const T out = face % 2 == 0 ? T(1) : T(-1);
    const Xyz<T> p = face < 2   ? Xyz<T>{out, s, t}
                     : face < 4 ? Xyz<T>{t, out, s}
                                : Xyz<T>{s, t, out};
    return normalized(p);
  }
  T pdf(const Xyz<T>& w) const {
    const T x = std::abs(w.x), y = std::abs(w.y), z = std::abs(w.z);
    const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const T out = axis == 0 ? w.x : axis == 1 ? w.y : w.z, over = 1 / std::abs(out);
    const T s = (axis == 0 ? w.y : axis == 1 ? w.z : w.x) * over;
    const T t = (axis == 0 ? w.z : axis == 1 ? w.x : w.y) * over;
    const bool positive = (out > 0) != (fault == 2);
    const int face = 2 * axis + (positive ? 0 : 1);
    const int first = face * kSide * kSide;
    const int k = first + cell_of((t + 1) / 2, kSide) * kSide + cell_of((s + 1) / 2, kSide);
    T probability = texels.front()[k];
    if (fault == 3) {
      T of_face = 0;
      for (int i = 0; i < kSide * kSide; ++i) of_face += texels.front()[first + i];
      probability /= 6 * of_face;
    }
    const T per_area = probability * kSide * kSide / 4;
    const T distance2 = 1 + s * s + t * t;
    return fault == 1 ? per_area : per_area * distance2 * std::sqrt(distance2);
  }
};

template <class T>
Pair cube_sky(int fault) {
  return of_directions("cube sky", CubeSky<T>(on(fault)));
}

/// A sun, evenly over its disk, before a sky by the cosine.
template <class T>
struct SunAndSky {
  int fault;
  T radius = T(0.05), sun_share = T(0.4);
  Frame<T> sun{normalized(Xyz<T>{T(0.5), T(0.2), T(0.6)})};

  static T cap(T angle) { return 2 * std::sin(angle / 2) * std::sin(angle / 2); }
  Xyz<T> sample(T u, T v) const {
    if (u < sun_share) {
      const T left = fourth::below_one(u / sun_share);
      return sun.to_world(around_z(left * cap(radius), 2 * pi_v<T> * v));
    }
    const T left = fourth::below_one((u - sun_share) / (1 - sun_share)), phi = 2 * pi_v<T> * v;
    const T r = std::sqrt(left);
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - left)};
  }
  T pdf(const Xyz<T>& w) const {
    T q = std::max(T(0), w.z) / pi_v<T> * (fault == 2 ? T(1) : 1 - sun_share);
    if (one_minus_dot(w, sun.z) <= cap(radius)) {
      q += sun_share / (2 * pi_v<T> * cap(fault == 1 ? 2 * radius : radius));
    }
    return q;
  }
};

/// Light over a square, halved from level to level, columns before rows; each number is stretched
/// after each of its choices.
///
/// @source Clarberg et al. 2005 (TOG 24:3), "Wavelet Importance Sampling", §5
template <class T>
struct Quarters {
  static constexpr int kLevels = 3, kSide = 8;
  int fault;
  std::vector<T> light;

  explicit Quarters(int which) : fault(which) {
    for (int k = 0; k < kSide * kSide; ++k) {
      light.push_back(T(0.2) + static_cast<T>(k * k % 11) / 4);
    }
  }
  T within(int x, int y, int wide, int high) const {
    T sum = 0;
    for (int j = y; j < y + high; ++j) {
      for (int i = x; i < x + wide; ++i) sum += at(light, j * kSide + i);
    }
    return sum;
  }
  bool second(T& u, T share, int level) const {
    const bool beyond = u >= share;
    if (fault == 1 && level == 1) return beyond;
    u = fourth::below_one(std::max(T(0), beyond ? (u - share) / (1 - share) : u / share));
    return beyond;
  }
  Xy<T> sample(T u, T v) const {
    int x = 0, y = 0, size = kSide;
    for (int level = 0; level < kLevels; ++level) {
      const int half = size / 2;
      if (second(u, within(x, y, half, size) / within(x, y, size, size), level)) x += half;
      if (second(v, within(x, y, half, half) / within(x, y, half, size), level)) y += half;
      size = half;
    }
    return {(static_cast<T>(x) + u) / kSide, (static_cast<T>(y) + v) / kSide};
  }
  T pdf(const Xy<T>& p) const {
    const T cells = fault == 2 ? T(kSide * kSide / 4) : T(kSide * kSide);
    const T here = at(light, cell_of(p.y, kSide) * kSide + cell_of(p.x, kSide));
    return here / within(0, 0, kSide, kSide) * cells;
  }
};

template <class T>
Pair quarters(int fault) {
  return pair_of<Xy<T>>("quarters", Domain::unit_square(), Quarters<T>(on(fault)));
}

}  // namespace

void add_sealed_maps(std::vector<Case>& cases) {
  cases.push_back(twin("fourth tilted sky/16x8/double/turned once more in pdf",
                       said("pdf turns the direction to the world again, not back to the map"),
                       {Kind::tangent_frame}, [] { return tilted_sky<double>(1); }));
  cases.push_back(
      twin("fourth tilted sky/16x8/float/sine at the edge of the row",
           said("L12: sample chooses rows by the sine at their lower edge, pdf at the middle"),
           {Kind::sine}, [] { return tilted_sky<float>(2); }));
  cases.push_back(twin("fourth cube sky/3/double/per area of the cube",
                       said("pdf is per area of the face, not per solid angle"),
                       {Kind::distance_or_area}, [] { return cube_sky<double>(1); }));
  cases.push_back(twin("fourth cube sky/3/float/opposite face",
                       said("pdf reads the face on the other side"), {Kind::mirrored},
                       [] { return cube_sky<float>(2); }));
  cases.push_back(twin("fourth cube sky/3/double/faces as if even",
                       said("pdf gives each face a sixth, sample goes by their light"),
                       {Kind::choice_probability, Kind::lobe_probability},
                       [] { return cube_sky<double>(3); }));
  cases.push_back(twin("fourth sun and sky/double/diameter for radius",
                       said("pdf has the solid angle of a cone as wide as the sun's diameter"),
                       {Kind::constant, Kind::lobe_probability},
                       [] { return of_directions("sun and sky", SunAndSky<double>{on(1)}); }));
  cases.push_back(twin("fourth sun and sky/float/sky without its share",
                       said("M7: pdf of the sky lacks the probability that the sun is not chosen"),
                       {Kind::choice_probability, Kind::lobe_probability},
                       [] { return of_directions("sun and sky", SunAndSky<float>{on(2)}); }));
  cases.push_back(twin("fourth quarters/8x8/double/middle level not stretched",
                       said("L6: numbers are not stretched after the second level's choices"),
                       {Kind::numbers_reused}, [] { return quarters<double>(1); }));
  cases.push_back(twin("fourth quarters/8x8/float/one level short",
                       said("pdf lacks the factor 4 of the last level"), {Kind::constant},
                       [] { return quarters<float>(2); }));
}

}  // namespace plumbline::tests::corpus
