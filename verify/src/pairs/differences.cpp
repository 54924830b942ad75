#include "pairs/differences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "pairs/batches.h"

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

/// The map around u along one number, at places that are known before any of them is asked for.
class Along {
 public:
  /// @param first_step  the longest step; a short one sees a seam only where it is very near
  Along(const Uniforms& u, std::size_t d, double epsilon, double first_step) : u_(u), d_(d) {
    // Steps are powers of two and u a multiple of 2^-20, so that u ± h is exact in float too.
    longest_ = std::exp2(std::floor(std::log2(std::min({first_step, u[d] / 2, (1 - u[d]) / 2}))));
    if (!rounds_to_float(epsilon)) return;
    for (double h = 0x1p-20; h <= 0x1p-17 && h < u[d] && u[d] + h < 1; h *= 2) ++roundings_;
  }

  static bool rounds_to_float(double epsilon) { return epsilon > 0x1p-40; }

  void add_points(std::vector<Uniforms>& points) const {
    double h = longest_;
    for (std::size_t i = 0; i < kSteps; ++i, h /= 2) add_pair(h, points);
    h = 0x1p-20;
    for (std::size_t i = 0; i < roundings_; ++i, h *= 2) add_pair(h, points);
  }

  std::size_t points() const { return 2 * (kSteps + roundings_); }

  /// Ridders: differences at halved steps, extrapolated; the best is where neither the
  /// extrapolation nor rounding (`unit`: what each coordinate of the map is off by) leaves a larger
  /// error.
  ///
  /// @param at    samples at the points
  /// @param here  at u
  std::optional<Derivative> derivative(std::span<const Record> at, const Vec3& here,
                                       double unit) const {
    if (unit > 0x1p-40) unit = rounding(at.subspan(2 * kSteps), here, unit);
    std::array<std::array<Vec3, kSteps>, kSteps> table;
    Derivative best;
    best.error = std::numeric_limits<double>::infinity();
    double h = longest_;
    for (std::size_t i = 0; i < kSteps; ++i, h /= 2) {
      const Record &above = at[2 * i], &below = at[2 * i + 1];
      if (!above || !below || above->mass > 0 || below->mass > 0) {
        if (i == 0) return std::nullopt;
        break;
      }
      table[0][i] = combine(0.5 / h, above->x, -0.5 / h, below->x);
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

 private:
  static constexpr std::size_t kSteps = 8;

  void add_pair(double h, std::vector<Uniforms>& points) const {
    for (const double step : {h, -h}) {
      Uniforms& beside = points.emplace_back(u_);
      beside[d_] += step;
    }
  }

  /// What each coordinate of the map is off by around u: its steps, if the code rounds something on
  /// the way that the result magnifies (a sine from 1 − cos² in float), else `unit`. Second
  /// differences at steps so small that a smooth map is straight over them.
  double rounding(std::span<const Record> at, const Vec3& here, double unit) const {
    for (std::size_t i = 0; i < roundings_; ++i) {
      const Record &a = at[2 * i], &b = at[2 * i + 1];
      if (!a || !b) break;
      const Vec3 bend = combine(0.5, combine(1, a->x, -1, here), 0.5, combine(1, b->x, -1, here));
      unit = std::max(unit, norm(bend));
    }
    return unit;
  }

  Uniforms u_;
  std::size_t d_;
  double longest_;
  std::size_t roundings_ = 0;  // steps that show how the map rounds
};

/// The map on one side of u along one number: at h, h/2 and h/4 for several h.
class OneSide {
 public:
  /// @param side  1 or −1
  OneSide(const Uniforms& u, std::size_t d, int side) : u_(u), d_(d), side_(side) {}

  static constexpr std::size_t points() { return 3 * kSteps.size(); }

  /// Those that lie outside are asked for at u.
  void add_points(std::vector<Uniforms>& points) const {
    for (const double step : kSteps) {
      for (const double h : {step, step / 2, step / 4}) {
        points.push_back(u_);
        if (inside(h)) points.back()[d_] += side_ * h;
      }
    }
  }

  std::optional<Derivative> derivative(std::span<const Record> at, const Vec3& here,
                                       double unit) const {
    std::optional<Derivative> best;
    for (std::size_t k = 0; k < kSteps.size(); ++k) {
      const auto next = extrapolated(at.subspan(3 * k, 3), here, unit, kSteps[k]);
      if (next && (!best || next->error < best->error)) best = next;
    }
    return best;
  }

 private:
  static constexpr std::array<double, 4> kSteps = {0x1p-9, 0x1p-11, 0x1p-13, 0x1p-15};

  bool inside(double h) const {
    const double to = u_[d_] + side_ * h;
    return to > 0 && to < 1;
  }

  /// Twice, from three differences.
  std::optional<Derivative> extrapolated(std::span<const Record> at, const Vec3& here, double unit,
                                         double h) const {
    std::array<Vec3, 3> slope;
    for (std::size_t i = 0; i < slope.size(); ++i, h /= 2) {
      if (!inside(h) || !at[i] || at[i]->mass > 0) return std::nullopt;
      slope[i] = combine(side_ / h, at[i]->x, -side_ / h, here);
    }
    const Vec3 coarse = combine(2, slope[1], -1, slope[0]),
               fine = combine(2, slope[2], -1, slope[1]);
    const Vec3 value = combine(4.0 / 3, fine, -1.0 / 3, coarse);
    // The shortest difference enters eight thirds times; h is half its step by now.
    const double rounding = 8.0 / 3 * 2 * unit / (2 * h);
    return Derivative{value, norm(combine(1, value, -1, fine)) + rounding};
  }

  Uniforms u_;
  std::size_t d_;
  double side_;
};

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

namespace {

/// Of every choice of sides that gives one.
///
/// @param at  samples at u, then on both sides along each number
std::vector<DensityAt> densities_beside(std::span<const OneSide> sides, std::span<const Record> at,
                                        double epsilon) {
  std::vector<DensityAt> densities;
  const Record& here = at[0];
  if (!here || here->mass > 0) return densities;
  const double unit = epsilon * largest_coordinate(here->x);
  std::vector<std::optional<Derivative>> by;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto of_side = at.subspan(1 + i * OneSide::points(), OneSide::points());
    by.push_back(sides[i].derivative(of_side, here->x, unit));
  }
  const auto add = [&](const Derivative& du, const std::optional<Derivative>& dv) {
    if (const auto density = density_from(du, dv)) densities.push_back(*density);
  };
  for (std::size_t i = 0; i < 2; ++i) {
    if (!by[i]) continue;
    if (by.size() == 2) add(*by[i], std::nullopt);
    for (std::size_t j = 2; j < by.size(); ++j) {
      if (by[j]) add(*by[i], by[j]);
    }
  }
  return densities;
}

}  // namespace

std::vector<std::vector<DensityAt>> densities_on_one_side(const Map& map,
                                                          std::span<const Uniforms> u,
                                                          int dimension, double epsilon) {
  std::vector<OneSide> sides;
  std::vector<Uniforms> points;
  for (const Uniforms& center : u) {
    points.push_back(center);
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
      for (const int side : {1, -1}) sides.emplace_back(center, d, side).add_points(points);
    }
  }
  const std::vector<Record> samples = ask(map, points);
  const std::size_t each = 2 * static_cast<std::size_t>(dimension);
  const std::size_t points_each = 1 + each * OneSide::points();
  std::vector<std::vector<DensityAt>> densities;
  for (std::size_t i = 0; i < u.size(); ++i) {
    densities.push_back(densities_beside(std::span(sides).subspan(i * each, each),
                                         std::span(samples).subspan(i * points_each, points_each),
                                         epsilon));
  }
  return densities;
}

namespace {

/// All that is asked for around one u.
struct Around {
  std::vector<Along> numbers;

  Around(const Uniforms& u, int dimension, double epsilon, double first_step) {
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
      numbers.emplace_back(u, d, epsilon, first_step);
    }
  }

  std::size_t points() const {
    std::size_t sum = 1;
    for (const Along& along : numbers) sum += along.points();
    return sum;
  }

  /// @param at  samples at u, then at the points along each number
  std::optional<DensityAt> density(std::span<const Record> at, double epsilon) const {
    const Record& here = at[0];
    if (!here || here->mass > 0) return std::nullopt;
    const double unit = epsilon * largest_coordinate(here->x);
    std::array<std::optional<Derivative>, 2> by;
    std::size_t first = 1;
    for (std::size_t d = 0; d < numbers.size(); ++d) {
      by[d] = numbers[d].derivative(at.subspan(first, numbers[d].points()), here->x, unit);
      if (!by[d]) return std::nullopt;
      first += numbers[d].points();
    }
    return density_from(*by[0], by[1]);
  }
};

}  // namespace

std::vector<std::optional<DensityAt>> densities_by_differences(const Map& map,
                                                               std::span<const Uniforms> u,
                                                               int dimension, double epsilon,
                                                               double first_step) {
  std::vector<std::optional<DensityAt>> densities;
  std::vector<Around> around;
  std::vector<Uniforms> points;
  const auto flush = [&] {
    const std::vector<Record> samples = ask(map, points);
    std::size_t first = 0;
    for (const Around& a : around) {
      densities.push_back(a.density(std::span(samples).subspan(first, a.points()), epsilon));
      first += a.points();
    }
    around.clear();
    points.clear();
  };
  for (const Uniforms& center : u) {
    const Around& a = around.emplace_back(center, dimension, epsilon, first_step);
    points.push_back(center);
    for (const Along& along : a.numbers) along.add_points(points);
    if (points.size() >= map.batch()) flush();
  }
  flush();
  return densities;
}

std::optional<DensityAt> density_by_differences(const Map& map, const Uniforms& u, int dimension,
                                                double epsilon, double first_step) {
  return densities_by_differences(map, {&u, 1}, dimension, epsilon, first_step).front();
}

}  // namespace plumbline::verify
