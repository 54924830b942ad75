#include "even_chart.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace plumbline::tests {
namespace {

using std::numbers::pi;

double dot(const Direction& a, const Direction& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Direction combine(const std::array<Direction, 3>& axes, const Direction& by) {
  Direction sum{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += by[i] * axes[i][k];
  }
  return sum;
}

double in_turns(double angle) {
  const double turns = angle / (2 * pi);
  return turns < 0 ? turns + 1 : turns;
}

/// Where u falls among steps of the given heights, and how far into its step, in [0, 1].
struct Place {
  std::size_t step;
  double fraction;
};

class Staircase {
 public:
  explicit Staircase(const std::vector<double>& heights) : top_{0} {
    for (const double h : heights) top_.push_back(top_.back() + h);
  }

  double height() const { return top_.back(); }

  Place find(double u) const {
    const double target = u * height();
    // The last step that begins at or below it has a height, or all behind it would be at its top.
    auto above = std::upper_bound(top_.begin(), top_.end(), target);
    if (above == top_.end()) above = std::lower_bound(top_.begin(), top_.end(), height());
    const auto step = static_cast<std::size_t>(above - top_.begin()) - 1;
    return {step, std::clamp((target - top_[step]) / (top_[step + 1] - top_[step]), 0.0, 1.0)};
  }

  double to_unit(const Place& place) const {
    const double low = top_[place.step], high = top_[place.step + 1];
    return (low + place.fraction * (high - low)) / height();
  }

 private:
  std::vector<double> top_;
};

/// A position in a number of equal parts, as part and fraction.
Place part_of(double position, int parts) {
  const double scaled = std::clamp(position, 0.0, 1.0) * parts;
  const double part = std::min(std::floor(scaled), static_cast<double>(parts - 1));
  return {static_cast<std::size_t>(part), scaled - part};
}

struct Pixels {
  int width, height;
  std::vector<double> weights;
  std::array<Direction, 3> axes;
  std::vector<Staircase> columns;
  Staircase rows{{}};

  double cos_top(std::size_t row) const { return std::cos(pi * static_cast<double>(row) / height); }
  double solid_angle(std::size_t row) const {
    return 2 * pi / width * (cos_top(row) - cos_top(row + 1));
  }
};

Pixels make_pixels(int width, int height, const std::vector<double>& weights,
                   const std::array<Direction, 3>& axes) {
  Pixels pixels{width, height, weights, axes, {}};
  std::vector<double> masses;
  for (std::size_t row = 0; row < static_cast<std::size_t>(height); ++row) {
    const auto first = weights.begin() + static_cast<std::ptrdiff_t>(row) * width;
    pixels.columns.emplace_back(std::vector<double>(first, first + width));
    masses.push_back(pixels.columns.back().height() * pixels.solid_angle(row));
  }
  pixels.rows = Staircase(masses);
  return pixels;
}

}  // namespace

EvenChart pixel_chart(int width, int height, const std::vector<double>& weights,
                      const std::array<Direction, 3>& axes) {
  const Pixels pixels = make_pixels(width, height, weights, axes);
  EvenChart chart;
  chart.from_square = [pixels](const SquarePoint& p) {
    const Place row = pixels.rows.find(p[0]);
    const Place column = pixels.columns[row.step].find(p[1]);
    const double top = pixels.cos_top(row.step), bottom = pixels.cos_top(row.step + 1);
    const double cos_theta = top + row.fraction * (bottom - top);
    const double sin_theta = std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta));
    const double phi = 2 * pi * (static_cast<double>(column.step) + column.fraction) / pixels.width;
    return combine(pixels.axes, {sin_theta * std::sin(phi), cos_theta, -sin_theta * std::cos(phi)});
  };
  chart.to_square = [pixels](const Direction& w) {
    const double x = dot(w, pixels.axes[0]), y = dot(w, pixels.axes[1]), z = dot(w, pixels.axes[2]);
    const double theta = std::atan2(std::hypot(x, z), y);
    Place row = part_of(theta / pi, pixels.height);
    const double top = pixels.cos_top(row.step), bottom = pixels.cos_top(row.step + 1);
    row.fraction = (std::cos(theta) - top) / (bottom - top);
    const Place column = part_of(in_turns(std::atan2(x, -z)), pixels.width);
    return SquarePoint{pixels.rows.to_unit(row), pixels.columns[row.step].to_unit(column)};
  };
  chart.solid_angle = [pixels](const SquarePoint& p) {
    const Place row = pixels.rows.find(p[0]);
    const Place column = pixels.columns[row.step].find(p[1]);
    const std::size_t pixel = row.step * static_cast<std::size_t>(pixels.width) + column.step;
    return pixels.rows.height() / pixels.weights[pixel];
  };
  return chart;
}

EvenChart cone_chart(const Direction& axis, double one_minus_cos) {
  // Any two directions across the axis do for the azimuth.
  const Direction other = std::abs(axis[0]) < 0.6 ? Direction{1, 0, 0} : Direction{0, 1, 0};
  Direction s{axis[1] * other[2] - axis[2] * other[1], axis[2] * other[0] - axis[0] * other[2],
              axis[0] * other[1] - axis[1] * other[0]};
  const double length = std::sqrt(dot(s, s));
  for (double& c : s) c /= length;
  const Direction t{axis[1] * s[2] - axis[2] * s[1], axis[2] * s[0] - axis[0] * s[2],
                    axis[0] * s[1] - axis[1] * s[0]};
  const std::array<Direction, 3> frame{s, t, axis};
  EvenChart chart;
  chart.from_square = [frame, one_minus_cos](const SquarePoint& p) {
    const double h = p[0] < 0.5 ? 2 * p[0] * one_minus_cos
                                : one_minus_cos + (2 * p[0] - 1) * (2 - one_minus_cos);
    const double sin_theta = std::sqrt(std::max(0.0, h * (2 - h)));
    const double phi = 2 * pi * p[1];
    return combine(frame, {sin_theta * std::cos(phi), sin_theta * std::sin(phi), 1 - h});
  };
  chart.to_square = [frame, one_minus_cos](const Direction& w) {
    // |w − axis|² = 2 (1 − cosθ): the cosine has too few digits near the axis.
    double h = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      h += (w[k] - frame[2][k]) * (w[k] - frame[2][k]) / 2;
    }
    const double share = h < one_minus_cos
                             ? h / one_minus_cos / 2
                             : 0.5 + std::min(1.0, (h - one_minus_cos) / (2 - one_minus_cos)) / 2;
    return SquarePoint{share, in_turns(std::atan2(dot(w, frame[1]), dot(w, frame[0])))};
  };
  chart.solid_angle = [one_minus_cos](const SquarePoint& p) {
    return 4 * pi * (p[0] < 0.5 ? one_minus_cos : 2 - one_minus_cos);
  };
  return chart;
}

}  // namespace plumbline::tests
