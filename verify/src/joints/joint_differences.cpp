#include "joints/joint_differences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "joints/cube.h"
#include "joints/joint_bins.h"
#include "pairs/batches.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kHalvings = 8;
// In place of 0, of columns of size 1: there is no map that is flat to that.
constexpr double kFlat = 1e-100;
constexpr double kLeastStep = 0x1p-20;
constexpr std::size_t kLeastSteps = 4;

Vec3 weighted(double a, const Vec3& x, double b, const Vec3& y) {
  return sum(scaled(x, a), scaled(y, b));
}

double largest_component(const Vec3& x) {
  return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
}

/// Steps along one number. They are powers of two and u a multiple of 2^-20, so that u ± h is exact
/// in float too.
struct Steps {
  double longest = 0;
  std::size_t least = 0;  // so many from 2^-20 upwards, which show how a map in float rounds

  Steps(double u, double epsilon, double first) {
    longest = std::exp2(std::floor(std::log2(std::min({first, u / 2, (1 - u) / 2}))));
    if (!(epsilon > 0x1p-40)) return;
    for (double h = kLeastStep; least < kLeastSteps && h < u && u + h < 1; h *= 2) ++least;
  }

  std::size_t count() const { return kHalvings + least; }
  double at(std::size_t i) const {
    return i < kHalvings ? std::ldexp(longest, -static_cast<int>(i))
                         : std::ldexp(kLeastStep, static_cast<int>(i - kHalvings));
  }
};

/// A factor's derivative along one number, with its error.
struct Slope {
  Vec3 value{};
  double error = std::numeric_limits<double>::infinity();
};

/// What a factor's coordinates are off by around a point, from second differences at steps so small
/// that a smooth map is straight over them.
double rounding_around(std::span<const MaybeJoint> at, const Steps& steps, const Vec3& here,
                       std::size_t f, double unit) {
  for (std::size_t i = kHalvings; i < steps.count(); ++i) {
    const MaybeJoint &a = at[2 * i], &b = at[2 * i + 1];
    if (!a || !b) break;
    unit = std::max(unit, length(weighted(0.5, weighted(1, a->x[f], -1, here), 0.5,
                                          weighted(1, b->x[f], -1, here))));
  }
  return unit;
}

/// Ridders: differences at halved steps, extrapolated; the best is where neither the extrapolation
/// nor rounding leaves a larger error.
///
/// @param at    samples at u + h, u − h for each step
/// @param unit  what each coordinate of the map is off by
std::optional<Slope> slope_of(std::span<const MaybeJoint> at, const Steps& steps, std::size_t f,
                              double unit) {
  std::array<std::array<Vec3, kHalvings>, kHalvings> table;
  Slope best;
  for (std::size_t i = 0; i < kHalvings; ++i) {
    const MaybeJoint &above = at[2 * i], &below = at[2 * i + 1];
    if (!above || !below) {
      if (i == 0) return std::nullopt;
      break;
    }
    const double h = steps.at(i);
    table[0][i] = weighted(0.5 / h, above->x[f], -0.5 / h, below->x[f]);
    double factor = 4;
    for (std::size_t j = 1; j <= i; ++j, factor *= 4) {
      table[j][i] =
          weighted(factor / (factor - 1), table[j - 1][i], -1 / (factor - 1), table[j - 1][i - 1]);
      const double error =
          std::max({length(weighted(1, table[j][i], -1, table[j - 1][i])),
                    length(weighted(1, table[j][i], -1, table[j - 1][i - 1])), 4 * unit / h});
      if (error <= best.error) best = {table[j][i], error};
    }
  }
  return best;
}

/// ∂x/∂u: a column for each number, of three coordinates for each factor.
class Tangents {
 public:
  Tangents(const JointDomain& domain, std::size_t numbers) : domain_(domain), numbers_(numbers) {}

  Slope& at(std::size_t factor, std::size_t number) { return slopes_[factor][number]; }

  std::optional<JointDensity> density() {
    double volume = 1;
    for (std::size_t f = 0; f < domain_.factors().size(); ++f) {
      // Nanometres beside directions: each factor is brought to size 1.
      double squares = 0;
      for (std::size_t d = 0; d < numbers_; ++d) squares += dot(at(f, d).value, at(f, d).value);
      const double scale = std::sqrt(squares);
      if (!(scale > 0) || !std::isfinite(scale)) return std::nullopt;
      volume *= std::pow(scale, domain_.factors()[f].dimension());
      for (std::size_t d = 0; d < numbers_; ++d) {
        at(f, d).value = scaled(at(f, d).value, 1 / scale);
        at(f, d).error /= scale;
      }
    }
    return triangulate(volume);
  }

 private:
  using Columns = std::array<std::array<double, 12>, kMostDimensions>;
  using Square = std::array<std::array<double, kMostDimensions>, kMostDimensions>;

  /// J = QR by Gram and Schmidt: the determinant is that of R, and d log det = tr(J⁺ dJ).
  std::optional<JointDensity> triangulate(double volume) const {
    Columns q{};
    Square r{};
    for (std::size_t d = 0; d < numbers_; ++d) {
      for (std::size_t f = 0; f < domain_.factors().size(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) q[d][3 * f + i] = slopes_[f][d].value[i];
      }
      for (std::size_t e = 0; e < d; ++e) {
        for (std::size_t i = 0; i < 12; ++i) r[e][d] += q[e][i] * q[d][i];
        for (std::size_t i = 0; i < 12; ++i) q[d][i] -= r[e][d] * q[e][i];
      }
      double squares = 0;
      for (const double c : q[d]) squares += c * c;
      r[d][d] = std::max(std::sqrt(squares), kFlat);
      for (double& c : q[d]) c /= r[d][d];
      volume *= r[d][d];
    }
    if (!(volume > 0) || !std::isfinite(volume)) return std::nullopt;
    const double error = relative_error(r);
    return JointDensity{{1 / volume, error}, 1 / (volume * (1 + error))};
  }

  double relative_error(const Square& r) const {
    double error = 0;
    for (std::size_t row = numbers_; row-- > 0;) {
      // The row of R⁻¹, by substitution.
      std::array<double, kMostDimensions> inverse{};
      inverse[row] = 1 / r[row][row];
      for (std::size_t c = row + 1; c < numbers_; ++c) {
        for (std::size_t k = row; k < c; ++k) inverse[c] -= inverse[k] * r[k][c];
        inverse[c] /= r[c][c];
      }
      double squares = 0, off = 0;
      for (const double c : inverse) squares += c * c;
      for (std::size_t f = 0; f < domain_.factors().size(); ++f) {
        off += slopes_[f][row].error * slopes_[f][row].error;
      }
      error += std::sqrt(squares * off);
    }
    return error;
  }

  const JointDomain& domain_;
  std::size_t numbers_;
  std::array<std::array<Slope, kMostDimensions>, 4> slopes_{};
};

std::optional<JointDensity> density_around(const JointPair& pair, const std::vector<Steps>& steps,
                                           std::span<const MaybeJoint> at) {
  const MaybeJoint& here = at[0];
  if (!here) return std::nullopt;
  Tangents tangents(pair.domain, steps.size());
  std::size_t first = 1;
  for (std::size_t d = 0; d < steps.size(); ++d) {
    const auto along = at.subspan(first, 2 * steps[d].count());
    for (std::size_t f = 0; f < pair.domain.factors().size(); ++f) {
      const Vec3& x = here->x[f];
      const double unit =
          rounding_around(along, steps[d], x, f, pair.epsilon * largest_component(x));
      const auto slope = slope_of(along, steps[d], f, unit);
      if (!slope) return std::nullopt;
      tangents.at(f, d) = *slope;
    }
    first += along.size();
  }
  return tangents.density();
}

}  // namespace

std::vector<std::optional<JointDensity>> joint_densities_by_differences(
    const JointPair& pair, const std::vector<JointUniforms>& u, double first_step) {
  std::vector<std::optional<JointDensity>> densities;
  std::vector<std::vector<Steps>> around;
  std::vector<JointUniforms> points;
  const auto flush = [&] {
    const std::vector<MaybeJoint> samples = ask(pair.sample, points);
    std::size_t first = 0;
    for (const std::vector<Steps>& steps : around) {
      std::size_t count = 1;
      for (const Steps& s : steps) count += 2 * s.count();
      densities.push_back(density_around(pair, steps, std::span(samples).subspan(first, count)));
      first += count;
    }
    around.clear();
    points.clear();
  };
  for (const JointUniforms& center : u) {
    std::vector<Steps>& steps = around.emplace_back();
    points.push_back(center);
    for (std::size_t d = 0; d < static_cast<std::size_t>(pair.numbers); ++d) {
      const Steps& s = steps.emplace_back(center[d], pair.epsilon, first_step);
      for (std::size_t i = 0; i < s.count(); ++i) {
        for (const double side : {1.0, -1.0}) points.emplace_back(center)[d] += side * s.at(i);
      }
    }
    if (points.size() >= pair.sample.batch()) flush();
  }
  flush();
  return densities;
}

}  // namespace plumbline::verify
