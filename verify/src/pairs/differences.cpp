#include "pairs/differences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plumbline::verify {

namespace {

/// A derivative along one uniform number, with its error.
struct Derivative {
  Vec3 value{};
  double error = 0;
};

double norm(const Vec3& v) { return std::hypot(v[0], v[1], v[2]); }

Vec3 combine(double a, const Vec3& x, double b, const Vec3& y) {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}

/// Largest coordinate that a difference subtracts, for its rounding error.
double largest_coordinate(const Vec3& x) {
  return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
}

/// Central difference; steps are powers of two and u a multiple of 2^-20, so that u ± h is exact in
/// float too.
std::optional<Vec3> difference(const Map& map, Uniforms u, std::size_t d, double h) {
  const double center = u[d];
  u[d] = center + h;
  const auto above = map(u);
  u[d] = center - h;
  const auto below = map(u);
  if (!above || !below || above->mass > 0 || below->mass > 0) return std::nullopt;
  return combine(0.5 / h, above->x, -0.5 / h, below->x);
}

/// What each coordinate of the map is off by around u: its steps, if the code rounds something on
/// the way that the result magnifies (a sine from 1 − cos² in float), else `unit`. Second
/// differences at steps so small that a smooth map is straight over them.
double rounding_around(const Map& map, const Uniforms& u, std::size_t d, double unit) {
  const auto here = map(u);
  for (double h = 0x1p-20; here && h <= 0x1p-17 && h < u[d] && u[d] + h < 1; h *= 2) {
    Uniforms above = u, below = u;
    above[d] += h;
    below[d] -= h;
    const auto a = map(above), b = map(below);
    if (!a || !b) break;
    const Vec3 bend =
        combine(0.5, combine(1, a->x, -1, here->x), 0.5, combine(1, b->x, -1, here->x));
    unit = std::max(unit, norm(bend));
  }
  return unit;
}

/// Ridders: differences at halved steps, extrapolated; the best is where neither the extrapolation
/// nor rounding (`unit`: what each coordinate of the map is off by) leaves a larger error.
///
/// @param first_step  the longest step; a short one sees a seam only where it is very near
std::optional<Derivative> derivative(const Map& map, const Uniforms& u, std::size_t d, double unit,
                                     double first_step) {
  constexpr int kSteps = 8;
  if (unit > 0x1p-40) unit = rounding_around(map, u, d, unit);
  double h = std::exp2(std::floor(std::log2(std::min({first_step, u[d] / 2, (1 - u[d]) / 2}))));
  std::array<std::array<Vec3, kSteps>, kSteps> table;
  Derivative best;
  best.error = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kSteps; ++i, h /= 2) {
    const auto next = difference(map, u, d, h);
    if (!next) {
      if (i == 0) return std::nullopt;
      break;
    }
    table[0][i] = *next;
    double factor = 4;
    for (std::size_t j = 1; j <= i; ++j, factor *= 4) {
      table[j][i] =
          combine(factor / (factor - 1), table[j - 1][i], -1 / (factor - 1), table[j - 1][i - 1]);
      const double error =
          std::max({norm(combine(1, table[j][i], -1, table[j - 1][i])),
                    norm(combine(1, table[j][i], -1, table[j - 1][i - 1])), 4 * unit / h});
      if (error <= best.error) best = {table[j][i], error};
    }
  }
  return best;
}

/// Differences between u and points on one side of it at h, h/2 and h/4, extrapolated twice.
std::optional<Derivative> one_sided_at(const Map& map, const Uniforms& u, const Vec3& here,
                                       std::size_t d, double unit, double h) {
  std::array<Vec3, 3> slope;
  for (std::size_t i = 0; i < slope.size(); ++i, h /= 2) {
    Uniforms beside = u;
    beside[d] += h;
    if (!(beside[d] > 0 && beside[d] < 1)) return std::nullopt;
    const auto there = map(beside);
    if (!there || there->mass > 0) return std::nullopt;
    slope[i] = combine(1 / h, there->x, -1 / h, here);
  }
  const Vec3 coarse = combine(2, slope[1], -1, slope[0]), fine = combine(2, slope[2], -1, slope[1]);
  const Vec3 value = combine(4.0 / 3, fine, -1.0 / 3, coarse);
  // The shortest difference enters eight thirds times; h is half its step by now.
  const double rounding = 8.0 / 3 * 2 * unit / std::abs(2 * h);
  return Derivative{value, norm(combine(1, value, -1, fine)) + rounding};
}

std::optional<Derivative> one_sided(const Map& map, const Uniforms& u, const Vec3& here,
                                    std::size_t d, double unit, int side) {
  std::optional<Derivative> best;
  for (const double step : {0x1p-9, 0x1p-11, 0x1p-13, 0x1p-15}) {
    const auto next = one_sided_at(map, u, here, d, unit, side * step);
    if (next && (!best || next->error < best->error)) best = next;
  }
  return best;
}

/// @param dv  of a map of one number: none
std::optional<DensityAt> density_from(const Derivative& du, const std::optional<Derivative>& dv) {
  const Vec3& a = du.value;
  double area = norm(a), error = du.error;
  if (dv) {
    const Vec3& b = dv->value;
    area = norm({a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
    error = du.error * norm(b) + dv->error * norm(a);
  }
  if (!(area > 0)) return std::nullopt;
  return DensityAt{1 / area, error / area};
}

}  // namespace

std::vector<DensityAt> densities_on_one_side(const Map& map, const Uniforms& u, int dimension,
                                             double epsilon) {
  std::vector<DensityAt> densities;
  const auto sample = map(u);
  if (!sample || sample->mass > 0) return densities;
  const double unit = epsilon * largest_coordinate(sample->x);
  const auto sides_of = [&](std::size_t d) {
    return std::array{one_sided(map, u, sample->x, d, unit, 1),
                      one_sided(map, u, sample->x, d, unit, -1)};
  };
  const auto add = [&](const Derivative& du, const std::optional<Derivative>& dv) {
    if (const auto density = density_from(du, dv)) densities.push_back(*density);
  };
  const auto first = sides_of(0);
  const auto second = dimension == 2 ? sides_of(1) : decltype(first){};
  for (const auto& du : first) {
    if (!du) continue;
    if (dimension == 1) add(*du, std::nullopt);
    for (const auto& dv : second) {
      if (dv) add(*du, dv);
    }
  }
  return densities;
}

std::optional<DensityAt> density_by_differences(const Map& map, const Uniforms& u, int dimension,
                                                double epsilon, double first_step) {
  const auto sample = map(u);
  if (!sample || sample->mass > 0) return std::nullopt;
  const double unit = epsilon * largest_coordinate(sample->x);
  const auto du = derivative(map, u, 0, unit, first_step);
  if (!du) return std::nullopt;
  if (dimension == 1) return density_from(*du, std::nullopt);
  const auto dv = derivative(map, u, 1, unit, first_step);
  if (!dv) return std::nullopt;
  return density_from(*du, dv);
}

}  // namespace plumbline::verify
