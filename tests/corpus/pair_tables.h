#pragma once

#include "pair_maps.h"
#include "pair_support.h"

/// Densities tabulated over the square and interpolated: measured BRDFs, smooth sky maps.
namespace plumbline::tests::corpus {

/// Bilinear between nodes: y by the piecewise-linear marginal, x by the piecewise-linear
/// conditional of the interpolated row.
template <class T>
struct BilinearTable {
  int fault;
  int nx, ny;  ///< nodes
  std::vector<T> f, row_cdf, marginal_cdf;

  BilinearTable(int which, int nodes_x, int nodes_y, std::vector<T> values)
      : fault(which), nx(nodes_x), ny(nodes_y), f(std::move(values)) {
    for (int j = 0; j < ny; ++j) {
      row_cdf.push_back(0);
      for (int i = 0; i + 1 < nx; ++i) {
        row_cdf.push_back(row_cdf.back() + (node(i, j) + node(i + 1, j)) / 2);
      }
    }
    marginal_cdf.push_back(0);
    for (int j = 0; j + 1 < ny; ++j) {
      marginal_cdf.push_back(marginal_cdf.back() + (row(j) + row(j + 1)) / 2);
    }
  }
  T node(int i, int j) const { return at(f, j * nx + i); }
  T up_to(int i, int j) const { return at(row_cdf, j * nx + i); }
  T row(int j) const { return up_to(nx - 1, j); }

  /// Where in a cell whose ends have densities a and b the share u of its mass lies.
  static T linear(T u, T a, T b) {
    const T root = std::sqrt(std::max(T(0), a * a + u * (b * b - a * a)));
    return a + root > 0 ? std::min(u * (a + b) / (a + root), T(1)) : u;
  }
  Xy<T> sample(T u, T v) const {
    const T target = v * marginal_cdf.back();
    const auto above = std::upper_bound(marginal_cdf.begin() + 1, marginal_cdf.end() - 1, target);
    const int j = static_cast<int>(above - marginal_cdf.begin()) - 1;
    const T t =
        linear((target - at(marginal_cdf, j)) / (at(marginal_cdf, j + 1) - at(marginal_cdf, j)),
               row(j), row(j + 1));
    const auto mixed = [&](T a, T b) { return fault == 5 ? a : (1 - t) * a + t * b; };
    const T across = u * mixed(row(j), row(j + 1));
    int low = 0, high = nx - 1;
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      (mixed(up_to(middle, j), up_to(middle, j + 1)) <= across ? low : high) = middle;
    }
    const T begin = mixed(up_to(low, j), up_to(low, j + 1));
    const T end = mixed(up_to(high, j), up_to(high, j + 1));
    const T share = end > begin ? std::clamp((across - begin) / (end - begin), T(0), T(1)) : T(0);
    const T s = linear(share, mixed(node(low, j), node(low, j + 1)),
                       mixed(node(high, j), node(high, j + 1)));
    return {(static_cast<T>(low) + s) / static_cast<T>(nx - 1),
            (static_cast<T>(j) + t) / static_cast<T>(ny - 1)};
  }
  T pdf(Xy<T> p) const {
    if (!(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1)) return 0;
    if (fault == 1) p.x = std::min(p.x + T(0.5) / static_cast<T>(nx - 1), T(1));
    if (fault == 2) p.x = 1 - p.x;
    const int i = cell_of(p.x, nx - 1), j = cell_of(p.y, ny - 1);
    const T s = p.x * static_cast<T>(nx - 1) - static_cast<T>(i);
    const T t = p.y * static_cast<T>(ny - 1) - static_cast<T>(j);
    const int k = fault == 4 ? std::min(j + 1, ny - 2) : j;
    const T value = (1 - t) * ((1 - s) * node(i, k) + s * node(i + 1, k)) +
                    t * ((1 - s) * node(i, k + 1) + s * node(i + 1, k + 1));
    const T cells = static_cast<T>((nx - 1) * (ny - 1));
    return value / marginal_cdf.back() * (fault == 3 ? T(1) : cells);
  }
};

/// A lobe as a goniometer measures it: a peak, a ridge, noise, a dark corner.
template <class T>
std::vector<T> measured_values(int nx, int ny, bool periodic) {
  std::vector<T> values;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int column = periodic && i == nx - 1 ? 0 : i;
      const double x = static_cast<double>(column) / (nx - 1),
                   y = static_cast<double>(j) / (ny - 1);
      const double peak = 6 * std::exp(-30 * ((x - 0.3) * (x - 0.3) + (y - 0.4) * (y - 0.4)));
      const double ridge = 0.8 * std::exp(-60 * (y - 0.75) * (y - 0.75));
      const double noise = 0.05 * ((column * 5 + j * 3) % 4);
      values.push_back(static_cast<T>(y < 0.1 && !periodic ? 0 : 0.1 + peak + ridge + noise));
    }
  }
  return values;
}

/// A sky interpolated between texels, equirectangular; importance times sinθ at the nodes.
template <class T>
struct SmoothMap {
  int fault;
  std::optional<BilinearTable<T>> table;

  SmoothMap(int which, int w, int h) : fault(which) {
    std::vector<T> values = measured_values<T>(w + 1, h + 1, true);
    for (int k = 0; k < (w + 1) * (h + 1); ++k) {
      ref(values, k) *= std::sin(pi_v<T> * static_cast<T>(k / (w + 1)) / static_cast<T>(h));
    }
    for (T& v : values) v = std::max(v, T(0));  // sin π in float is below 0
    table.emplace(which > 2 ? which - 2 : 0, w + 1, h + 1, std::move(values));
  }
  Xyz<T> sample(T u, T v) const {
    const Xy<T> p = table->sample(u, v);
    return from_latitude(p.x, p.y);
  }
  T pdf(const Xyz<T>& w) const {
    const T sine = std::sqrt(w.x * w.x + w.y * w.y);
    if (!(sine > 0)) return 0;
    Xy<T> p = to_latitude(w);
    p.y = std::atan2(sine, w.z) / pi_v<T>;  // acos is 0 within 3e-4 of the pole in float
    const T density = table->pdf(p) / (2 * pi_v<T> * pi_v<T>);
    return fault == 1 ? density : fault == 2 ? density * sine : density / sine;
  }
};

/// Isotropic measured lobe over the upper hemisphere with θ = π/2·x², so that the table is finest
/// around the normal: dω = sinθ dθ dφ = sinθ · πx dx · 2π dy.
///
/// @source Dupuy, Jakob 2018 (TOG 37:6), "An Adaptive Parameterization for Efficient Material
/// Acquisition and Rendering", §4
template <class T>
struct MeasuredLobe {
  int fault;
  BilinearTable<T> table;

  Xyz<T> sample(T u, T v) const {
    const Xy<T> p = table.sample(u, v);
    const T theta = pi_v<T> / 2 * p.x * p.x, phi = 2 * pi_v<T> * p.y;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  }
  T pdf(const Xyz<T>& w) const {
    const T sine = std::sqrt(w.x * w.x + w.y * w.y);
    if (!(w.z >= 0 && sine > 0)) return 0;
    const T theta = std::atan2(sine, w.z), turn = std::atan2(w.y, w.x) / (2 * pi_v<T>);
    const T x = std::min(std::sqrt(2 * theta / pi_v<T>), T(1));
    const T density = table.pdf({x, turn < 0 ? turn + 1 : turn});
    return density / (2 * pi_v<T> * pi_v<T> * (fault == 1 ? T(1) : x) * (fault == 2 ? T(1) : sine));
  }
};

template <class T>
Pair measured_lobe(int fault = 0, int table_fault = 0) {
  return pair_of<Xyz<T>>(
      "measured lobe", Domain::hemisphere(),
      MeasuredLobe<T>{fault,
                      BilinearTable<T>(table_fault, 24, 17, measured_values<T>(24, 17, false))});
}

}  // namespace plumbline::tests::corpus
