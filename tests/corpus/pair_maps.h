#pragma once

#include "pair_support.h"

/// Environment maps, equirectangular and octahedral, piecewise constant.
namespace plumbline::tests::corpus {

template <class T>
struct Image {
  int width, height;
  std::vector<T> texels;

  T at(int i, int j) const { return corpus::at(texels, j * width + i); }
};

/// A sky with structure from texel to texel, a sun in one of them, and rows without any light.
template <class T>
Image<T> sky(int width, int height, double sun, bool black_rows = false) {
  Image<T> image{width, height, zeros<T>(width * height)};
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const double haze = 0.3 + (i * 7 + j * 3) % 5;
      const double horizon = j * 2 < height ? 1.0 : 0.4;
      const bool black = black_rows && (j % 4 == 1 || j + 1 == height);
      ref(image.texels, j * width + i) = black ? T(0) : static_cast<T>(haze * horizon);
    }
  }
  if (sun > 0) ref(image.texels, height / 3 * width + width / 3) = static_cast<T>(sun);
  return image;
}

/// Density on [0, 1], constant on n equal cells, sampled by its cumulative distribution.
template <class T>
struct PiecewiseConstant {
  std::vector<T> f, cdf;
  T integral = 0;

  explicit PiecewiseConstant(std::vector<T> values) : f(std::move(values)) {
    const T n = static_cast<T>(f.size());
    cdf.push_back(0);
    for (const T v : f) cdf.push_back(cdf.back() + v / n);
    integral = cdf.back();
    for (std::size_t i = 0; i < cdf.size(); ++i) {
      cdf[i] = integral > 0 ? cdf[i] / integral : static_cast<T>(i) / n;
    }
  }
  int size() const { return static_cast<int>(f.size()); }
  T sample(T u, int& cell) const {
    const auto above = std::upper_bound(cdf.begin(), cdf.end(), u);
    cell = std::clamp(static_cast<int>(above - cdf.begin()) - 1, 0, size() - 1);
    T within = u - corpus::at(cdf, cell);
    const T mass = corpus::at(cdf, cell + 1) - corpus::at(cdf, cell);
    if (mass > 0) within /= mass;
    return (static_cast<T>(cell) + within) / static_cast<T>(size());
  }
};

template <class T>
Xyz<T> from_latitude(T u, T v) {
  const T theta = pi_v<T> * v, phi = 2 * pi_v<T> * u;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

template <class T>
Xy<T> to_latitude(const Xyz<T>& w) {
  const T phi = std::atan2(w.y, w.x) / (2 * pi_v<T>);
  return {phi < 0 ? phi + 1 : phi, std::acos(std::clamp(w.z, T(-1), T(1))) / pi_v<T>};
}

template <class T>
T sine_of_row(int j, int height) {
  return std::sin(pi_v<T> * (static_cast<T>(j) + T(0.5)) / static_cast<T>(height));
}

/// A row by the marginal distribution, a texel by the conditional one of the row.
///
/// @source Pharr, Jakob, Humphreys 2023, "Physically Based Rendering", 4th ed., §12.5.2
template <class T>
struct MapByRows {
  int fault;
  int width, height;
  std::vector<PiecewiseConstant<T>> rows;
  std::optional<PiecewiseConstant<T>> marginal;
  std::vector<T> unweighted;  ///< integrals of the rows without their sine
  std::shared_ptr<int> last = std::make_shared<int>(0);

  MapByRows(const Image<T>& image, int which)
      : fault(which), width(image.width), height(image.height) {
    std::vector<T> integrals;
    for (int j = 0; j < height; ++j) {
      const T sine = sine_of_row<T>(j, height);
      std::vector<T> row;
      for (int i = 0; i < width; ++i) row.push_back(image.at(i, j) * sine);
      rows.emplace_back(std::move(row));
      integrals.push_back(rows.back().integral);
      unweighted.push_back(rows.back().integral / sine);
    }
    marginal.emplace(std::move(integrals));
  }

  Xyz<T> sample(T u, T v) const {
    int i = 0, j = 0;
    T y = marginal->sample(v, j);
    *last = j;
    const int row = fault == 10 ? std::min(j + 1, height - 1) : j;
    T x = rows[static_cast<std::size_t>(row)].sample(u, i);
    if (fault == 9) {
      x = (static_cast<T>(i) + T(0.5)) / static_cast<T>(width);
      y = (static_cast<T>(j) + T(0.5)) / static_cast<T>(height);
    }
    return from_latitude(x, y);
  }

  T pdf(const Xyz<T>& w) const {
    T sine = std::sqrt(w.x * w.x + w.y * w.y);
    if (!(sine > 0)) return 0;
    Xy<T> p = to_latitude(w);
    if (fault == 4) p.x += T(0.5) / static_cast<T>(width);
    if (fault == 5) p.x = 1 - p.x;
    if (fault == 6) p.y = 1 - p.y;
    const int i =
        fault == 4 ? static_cast<int>(p.x * static_cast<T>(width)) % width : cell_of(p.x, width);
    int j = cell_of(p.y, height);
    if (fault == 3) j = std::min(j + 1, height - 1);
    if (fault == 11) j = *last;
    if (fault == 1) sine = 1;
    if (fault == 2) sine = sine_of_row<T>(j, height);
    const PiecewiseConstant<T>& row = rows[static_cast<std::size_t>(j)];
    const T over_row = fault == 8 ? row.integral : marginal->integral;
    T density = over_row > 0 ? at(row.f, i) / over_row : T(0);
    if (fault == 12) {
      T all = 0;
      for (const T integral : unweighted) all += integral / static_cast<T>(height);
      density = at(row.f, i) / sine_of_row<T>(j, height) / all;
    }
    return density / ((fault == 7 ? 1 : 2) * pi_v<T> * pi_v<T> * sine);
  }
};

/// Index by Vose's alias method; what is left of the number is uniform again.
template <class T>
struct AliasTable {
  std::vector<T> p, keep;
  std::vector<int> alias;

  explicit AliasTable(const std::vector<T>& weights) {
    const int n = static_cast<int>(weights.size());
    double sum = 0;
    for (const T w : weights) sum += static_cast<double>(w);
    std::vector<double> scaled;
    std::vector<int> small, large;
    for (int i = 0; i < n; ++i) {
      const double share = static_cast<double>(corpus::at(weights, i)) / sum;
      p.push_back(static_cast<T>(share));
      scaled.push_back(share * n);
      (scaled.back() < 1 ? small : large).push_back(i);
      alias.push_back(i);
    }
    keep.assign(p.size(), T(1));
    while (!small.empty() && !large.empty()) {
      const int s = small.back(), l = large.back();
      small.pop_back();
      ref(keep, s) = static_cast<T>(corpus::at(scaled, s));
      ref(alias, s) = l;
      ref(scaled, l) -= 1 - corpus::at(scaled, s);
      if (corpus::at(scaled, l) < 1) large.pop_back(), small.push_back(l);
    }
  }
  int size() const { return static_cast<int>(p.size()); }
  int sample(T u, T& left, int fault = 0) const {
    const int i = cell_of(u, size());
    const T rest = u * static_cast<T>(size()) - static_cast<T>(i);
    const T q = corpus::at(keep, i);
    const bool own = fault == 3 ? rest >= q : rest < q;
    left = rest < q ? rest / q : (rest - q) / (1 - q);
    if (fault == 1) left = rest;
    return own ? i : corpus::at(alias, i);
  }
};

/// A texel by an alias table over all of them; the record holds density and radiance over density.
template <class T>
struct MapByAlias {
  int fault;
  Image<T> image;
  std::optional<AliasTable<T>> table;
  T texels_over_square;  ///< texels / (2π²): density over θ, φ per probability of a texel

  MapByAlias(Image<T> of, int which) : fault(which), image(std::move(of)) {
    std::vector<T> weights;
    for (int j = 0; j < image.height; ++j) {
      const T sine = fault == 4 ? T(1) : sine_of_row<T>(j, image.height);
      for (int i = 0; i < image.width; ++i) weights.push_back(image.at(i, j) * sine);
    }
    table.emplace(weights);
    if (fault == 4) {
      T sum = 0;
      for (int k = 0; k < table->size(); ++k) {
        sum += ref(table->p, k) *= sine_of_row<T>(k / image.width, image.height);
      }
      for (T& p : table->p) p /= sum;
    }
    texels_over_square = static_cast<T>(table->size()) / (2 * pi_v<T> * pi_v<T>);
    if (fault == 2) texels_over_square = 1 / (2 * pi_v<T> * pi_v<T>);
  }

  int texel(const Xyz<T>& w) const {
    Xy<T> p = to_latitude(w);
    if (fault == 5) std::swap(p.x, p.y);
    return cell_of(p.y, image.height) * image.width + cell_of(p.x, image.width);
  }
  std::optional<Record<Xyz<T>, T>> sample(T u, T v) const {
    T left = 0;
    const int k = table->sample(u, left, fault);
    const T x = (static_cast<T>(k % image.width) + left) / static_cast<T>(image.width);
    const T y = (static_cast<T>(k / image.width) + v) / static_cast<T>(image.height);
    const Xyz<T> w = from_latitude(x, y);
    const T density = pdf(w);
    if (!(density > 0)) return std::nullopt;
    const T stated = fault == 7 ? density * std::sqrt(w.x * w.x + w.y * w.y) : density;
    return Record<Xyz<T>, T>{
        w, stated, fault == 6 ? at(image.texels, k) / at(table->p, k) : value(w) / density};
  }
  T pdf(const Xyz<T>& w) const {
    const T sine = std::sqrt(w.x * w.x + w.y * w.y);
    return sine > 0 ? at(table->p, texel(w)) * texels_over_square / sine : T(0);
  }
  T value(const Xyz<T>& w) const { return at(image.texels, texel(w)); }
};

/// What exceeds the mean, as importance of a map whose rest the BSDF's own samples find.
///
/// @source Karlík et al. 2019 (TOG 38:6), "MIS Compensation", §5
template <class T>
Image<T> compensated(Image<T> image) {
  T mean = 0;
  for (const T v : image.texels) mean += v / static_cast<T>(image.texels.size());
  for (T& v : image.texels) v = std::max(T(0), v - mean);
  return image;
}

/// Equal-area map of the square onto the sphere, folded along the diagonals.
///
/// @source Clarberg 2008 (JGT 13:3), "Fast Equal-Area Mapping of the (Hemi)Sphere"
template <class T>
struct MapOctahedral {
  int fault;
  int size;
  std::vector<PiecewiseConstant<T>> rows;
  std::optional<PiecewiseConstant<T>> marginal;

  MapOctahedral(const Image<T>& image, int which) : fault(which), size(image.width) {
    std::vector<T> integrals;
    for (int j = 0; j < size; ++j) {
      std::vector<T> row;
      for (int i = 0; i < size; ++i) row.push_back(image.at(i, j));
      rows.emplace_back(std::move(row));
      integrals.push_back(rows.back().integral);
    }
    marginal.emplace(std::move(integrals));
  }

  static Xyz<T> from_square(const Xy<T>& p) {
    const T a = 2 * p.x - 1, b = 2 * p.y - 1;
    const T inside = 1 - std::abs(a) - std::abs(b);  // < 0: the lower hemisphere
    const T r = 1 - std::abs(inside);
    const T phi = (r > 0 ? (std::abs(b) - std::abs(a)) / r + 1 : T(1)) * pi_v<T> / 4;
    const T s = r * std::sqrt(2 - r * r);
    return {std::copysign(s * std::cos(phi), a), std::copysign(s * std::sin(phi), b),
            std::copysign(1 - r * r, inside)};
  }
  Xy<T> to_square(const Xyz<T>& w) const {
    const T r = std::sqrt(std::max(T(0), 1 - std::abs(w.z)));
    const T turn = std::atan2(std::abs(w.y), std::abs(w.x)) * 2 / pi_v<T>;
    T b = turn * r, a = r - b;
    if (w.z < 0 && fault != 3) {
      std::swap(a, b);
      a = 1 - a, b = 1 - b;
    }
    Xy<T> p{(std::copysign(a, w.x) + 1) / 2, (std::copysign(b, w.y) + 1) / 2};
    if (fault == 2) std::swap(p.x, p.y);
    if (fault == 4) p.x += T(0.5) / static_cast<T>(size), p.y += T(0.5) / static_cast<T>(size);
    return p;
  }
  Xyz<T> sample(T u, T v) const {
    int i = 0, j = 0;
    const T y = marginal->sample(v, j);
    return from_square({rows[static_cast<std::size_t>(j)].sample(u, i), y});
  }
  T pdf(const Xyz<T>& w) const {
    const Xy<T> p = to_square(w);
    const auto j = static_cast<std::size_t>(cell_of(p.y, size));
    const T density = at(rows[j].f, cell_of(p.x, size)) / marginal->integral;
    return fault == 1 ? density : density / (4 * pi_v<T>);
  }
};

template <class T>
Pair map_by_rows(int w, int h, double sun, bool black_rows, int fault = 0) {
  return pair_of<Xyz<T>>("environment map by rows", Domain::sphere(),
                         MapByRows<T>(sky<T>(w, h, sun, black_rows), fault));
}

template <class T>
Pair map_compensated(int w, int h, double sun, int fault = 0) {
  return pair_of<Xyz<T>>("compensated environment map", Domain::sphere(),
                         MapByRows<T>(compensated(sky<T>(w, h, sun)), fault));
}

template <class T>
Pair map_by_alias(int w, int h, double sun, int fault = 0) {
  return recorded_pair_of<Xyz<T>>("environment map by alias table", Domain::sphere(),
                                  MapByAlias<T>(sky<T>(w, h, sun), fault));
}

template <class T>
Pair map_octahedral(int n, double sun, int fault = 0) {
  return pair_of<Xyz<T>>("octahedral environment map", Domain::sphere(),
                         MapOctahedral<T>(sky<T>(n, n, sun), fault));
}

}  // namespace plumbline::tests::corpus
