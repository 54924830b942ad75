#include "pair_support.h"
#include "sealed_choice.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

void add_sealed_maps(std::vector<Case>& cases);

namespace fifth {
namespace {

/// A picture of a sky: a bright spot, a band at the horizon, ground that is dark but not black.
template <class T>
T picture(int i, int j, int wide, int high) {
  const double x = (i + 0.5) / wide, y = (j + 0.5) / high;
  const double spot = 9 * std::exp(-40 * ((x - 0.2) * (x - 0.2) + (y - 0.3) * (y - 0.3)));
  const double band = 1.5 * std::exp(-50 * (y - 0.5) * (y - 0.5));
  return static_cast<T>((y > 0.6 ? 0.15 : 0.6) + spot + band + 0.1 * ((3 * i + j) % 5));
}

/// An equirectangular sky with y up, a row after its light and then a texel of the row.
template <class T>
struct Dome {
  int fault, wide, high;
  std::vector<Choice<T>> rows;  ///< texels of each
  std::vector<Choice<T>> row;   ///< one: which row

  Dome(int which, int w, int h) : fault(which), wide(w), high(h) {
    std::vector<T> light;
    for (int j = 0; j < high; ++j) {
      std::vector<T> texels;
      T sum = 0;
      for (int i = 0; i < wide; ++i) {
        texels.push_back(picture<T>(i, j, wide, high));
        sum += texels.back();
      }
      rows.emplace_back(texels);
      light.push_back(sum *
                      std::sin(pi_v<T> * (static_cast<T>(j) + T(0.5)) / static_cast<T>(high)));
    }
    row.emplace_back(light);
    if (fault == 2) {
      for (int j = 0; j < high; ++j) {
        ref(light, j) /= std::sin(pi_v<T> * (static_cast<T>(j) + T(0.5)) / static_cast<T>(high));
      }
    }
    row.emplace_back(light);
  }
  const Choice<T>& texels(int j) const { return rows[static_cast<std::size_t>(j)]; }

  Xyz<T> sample(T u, T v) const {
    const int j = row[0].index(v);
    const int i = texels(j).index(u);
    const T phi = 2 * pi_v<T> * (static_cast<T>(i) + texels(j).left(u, i)) / static_cast<T>(wide);
    const T theta = pi_v<T> * (static_cast<T>(j) + row[0].left(v, j)) / static_cast<T>(high);
    const T sine = std::sin(theta);
    return {sine * std::cos(phi), std::cos(theta), sine * std::sin(phi)};
  }
  T pdf(const Xyz<T>& w) const {
    const T sine = std::hypot(w.x, w.z);
    if (!(sine > 0)) return 0;
    T x = share_of_turn(w.z, w.x);
    const T y = std::atan2(sine, w.y) / pi_v<T>;
    if (fault == 4) x = 1 - x;
    if (fault == 3) {
      x += T(0.5) / static_cast<T>(wide);
      x -= std::floor(x);
    }
    const int i = cell_of(x, wide);
    const int j = cell_of(fault == 6 ? 1 - y : y, high);
    const T probability = row[1].probability(j) * texels(j).probability(i);
    const T per_square = probability * static_cast<T>(wide * high);
    if (fault == 1) return per_square / (2 * pi_v<T> * pi_v<T>);
    return per_square / ((fault == 5 ? 4 * pi_v<T> : 2 * pi_v<T> * pi_v<T>)*sine);
  }
};

template <class T>
Pair dome(int fault, int wide, int high) {
  Pair pair = pair_of<Xyz<T>>("dome", Domain::sphere(), Dome<T>(put(fault), wide, high));
  pair.domain = Domain::equirectangular(static_cast<std::size_t>(wide),
                                        static_cast<std::size_t>(high), {0, 1, 0}, {1, 0, 0});
  return pair;
}

/// An octahedral sky, any texel after its light.
template <class T>
struct Diamond {
  static constexpr int kSide = 8;
  int fault;
  std::vector<Choice<T>> texels;  ///< one

  explicit Diamond(int which) : fault(which) {
    std::vector<T> light;
    for (int k = 0; k < kSide * kSide; ++k) {
      light.push_back(T(0.3) + static_cast<T>((k * 5 + k / kSide * 3) % 9) / 4);
    }
    texels.emplace_back(light);
  }
  static T signed_one(T x) { return x < 0 ? T(-1) : T(1); }
  Xyz<T> sample(T u, T v) const {
    const int k = texels[0].index(u);
    const T within = fault == 2 ? u : texels[0].left(u, k);
    const T x = 2 * (static_cast<T>(k % kSide) + within) / kSide - 1;
    const T y = 2 * (static_cast<T>(k / kSide) + v) / kSide - 1;
    const T z = 1 - std::abs(x) - std::abs(y);
    if (z >= 0) return normalized(Xyz<T>{x, y, z});
    return normalized(
        Xyz<T>{(1 - std::abs(y)) * signed_one(x), (1 - std::abs(x)) * signed_one(y), z});
  }
  T pdf(const Xyz<T>& w) const {
    const T sum = std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
    T x = w.x / sum, y = w.y / sum;
    if (w.z < 0) {
      const T folded = (1 - std::abs(y)) * signed_one(x);
      y = (1 - std::abs(x)) * signed_one(y);
      x = folded;
    }
    const int k = cell_of((y + 1) / 2, kSide) * kSide + cell_of((x + 1) / 2, kSide);
    const T per_square = texels[0].probability(k) * kSide * kSide / 4;
    // The octahedron is 1/sum away, and met at a slant.
    return fault == 1 ? per_square / (sum * sum) : per_square / (sum * sum * sum);
  }
};

template <class T>
Pair diamond(int fault) {
  return pair_of<Xyz<T>>("diamond", Domain::octahedral(8), Diamond<T>(put(fault)));
}

/// A sky of rows of equal height on a cylinder, so that all texels are of one solid angle.
template <class T>
struct Drum {
  static constexpr int kWide = 12, kHigh = 6;
  int fault;
  std::vector<Choice<T>> texels;  ///< one

  explicit Drum(int which) : fault(which) {
    std::vector<T> light;
    for (int k = 0; k < kWide * kHigh; ++k) {
      light.push_back(picture<T>(k % kWide, k / kWide, kWide, kHigh));
    }
    texels.emplace_back(light);
  }
  Xyz<T> sample(T u, T v) const {
    const int k = texels[0].index(u);
    const T turn = (static_cast<T>(k % kWide) + texels[0].left(u, k)) / kWide;
    return at_height(1 - 2 * (static_cast<T>(k / kWide) + v) / kHigh, 2 * pi_v<T> * turn);
  }
  T pdf(const Xyz<T>& w) const {
    const int i = cell_of(share_of_turn(w.y, w.x), kWide), j = cell_of((1 - w.z) / 2, kHigh);
    const T q = texels[0].probability(j * kWide + i) * kWide * kHigh / (4 * pi_v<T>);
    return fault == 1 ? q / std::max(T(1e-6), std::hypot(w.x, w.y)) : q;
  }
};

template <class T>
Pair drum(int fault) {
  std::vector<double> rows, columns;
  for (int j = 1; j < Drum<T>::kHigh; ++j) rows.push_back(static_cast<double>(j) / Drum<T>::kHigh);
  for (int i = 1; i < Drum<T>::kWide; ++i)
    columns.push_back(static_cast<double>(i) / Drum<T>::kWide);
  return pair_of<Xyz<T>>("drum", Domain::sphere().with_breaks(rows, columns), Drum<T>(put(fault)));
}

}  // namespace
}  // namespace fifth

void add_sealed_maps(std::vector<Case>& cases) {
  using namespace fifth;
  cases.push_back(twin("fifth dome/24x12/double/sine forgotten",
                       because("L12: pdf is per area of the map, without 1/sine"), {Kind::sine},
                       [] { return dome<double>(1, 24, 12); }));
  cases.push_back(twin("fifth dome/20x10/float/rows without sine in pdf",
                       because("L12: pdf has the rows' light without the sine that sample has"),
                       {Kind::sine}, [] { return dome<float>(2, 20, 10); }));
  cases.push_back(twin("fifth dome/16x8/double/half a texel",
                       because("pdf counts columns from the middle of the first texel"),
                       {Kind::shifted}, [] { return dome<double>(3, 16, 8); }));
  cases.push_back(twin("fifth dome/18x9/float/the other way round",
                       because("pdf turns about the map's axis the other way"), {Kind::mirrored},
                       [] { return dome<float>(4, 18, 9); }));
  cases.push_back(twin("fifth dome/12x6/double/4 pi for the map",
                       because("pdf has the sphere's 4 pi where the map's area is 2 pi squared"),
                       {Kind::constant}, [] { return dome<double>(5, 12, 6); }));
  cases.push_back(twin("fifth dome/22x11/double/upside down", because("pdf counts rows from below"),
                       {Kind::mirrored}, [] { return dome<double>(6, 22, 11); }));
  cases.push_back(twin("fifth diamond/8x8/double/without the slant",
                       because("pdf has the octahedron's distance squared and lacks the cosine"),
                       {Kind::distance_or_area, Kind::cosine}, [] { return diamond<double>(1); }));
  cases.push_back(twin("fifth diamond/8x8/float/number not stretched",
                       because("L6: the number that chose the texel is its place across as it is"),
                       {Kind::numbers_reused}, [] { return diamond<float>(2); }));
  cases.push_back(twin("fifth drum/12x6/double/sine of another map",
                       because("pdf is divided by the sine that a map of latitudes has"),
                       {Kind::sine}, [] { return drum<double>(1); }));
}

}  // namespace plumbline::tests::corpus
