#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <plumbline/verify/detail/domain.h>

#include "pairs/direction_charts.h"
#include "turns.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

using std::numbers::pi;

double outside(double x, double low, double high) { return std::max({0.0, low - x, x - high}); }

Vec3 moved_in_plane(const Vec3& x, double distance, double angle) {
  return {x[0] + distance * std::cos(angle), x[1] + distance * std::sin(angle), x[2]};
}

class IntervalChart final : public Chart {
 public:
  IntervalChart(double low, double high) : low_(low), high_(high) {}

  Vec3 from_square(const Point2& p) const override { return {low_ + (high_ - low_) * p[0], 0, 0}; }
  Point2 to_square(const Vec3& x) const override {
    return {std::clamp((x[0] - low_) / (high_ - low_), 0.0, 1.0), 0.5};
  }
  double element(const Point2&) const override { return high_ - low_; }
  Vec3 near(const Vec3& x, double distance, double angle) const override {
    return {x[0] + std::copysign(distance, std::cos(angle)), 0, 0};
  }
  double distance(const Vec3& x) const override { return outside(x[0], low_, high_); }

 private:
  double low_, high_;
};

// Ends at infinity are approached, never reached.
constexpr double kLastBelowOne = 1 - 0x1p-53;

/// x = scale·t/(1 − t): half of the square lies below the scale.
class HalfLineChart final : public Chart {
 public:
  explicit HalfLineChart(double scale) : scale_(scale) {}

  Vec3 from_square(const Point2& p) const override {
    const double t = std::min(p[0], kLastBelowOne);
    return {scale_ * t / (1 - t), 0, 0};
  }
  Point2 to_square(const Vec3& x) const override {
    return {std::clamp(x[0] / (scale_ + x[0]), 0.0, kLastBelowOne), 0.5};
  }
  double element(const Point2& p) const override {
    const double rest = 1 - std::min(p[0], kLastBelowOne);
    return scale_ / (rest * rest);
  }
  /// Far out rounding is in proportion to x.
  Vec3 near(const Vec3& x, double distance, double angle) const override {
    return {x[0] + std::copysign(distance * (scale_ + std::abs(x[0])), std::cos(angle)), 0, 0};
  }
  double distance(const Vec3& x) const override { return std::max(0.0, -x[0] / scale_); }

 private:
  double scale_;
};

/// x = center + scale·tan(π(t − ½)): half of the square lies within the scale.
class LineChart final : public Chart {
 public:
  LineChart(double center, double scale) : center_(center), scale_(scale) {}

  Vec3 from_square(const Point2& p) const override {
    return {center_ + scale_ * std::tan(pi * (within(p[0]) - 0.5)), 0, 0};
  }
  Point2 to_square(const Vec3& x) const override {
    return {within(0.5 + std::atan((x[0] - center_) / scale_) / pi), 0.5};
  }
  double element(const Point2& p) const override {
    const double cosine = std::cos(pi * (within(p[0]) - 0.5));
    return pi * scale_ / (cosine * cosine);
  }
  Vec3 near(const Vec3& x, double distance, double angle) const override {
    const double size = scale_ + std::abs(x[0]);
    return {x[0] + std::copysign(distance * size, std::cos(angle)), 0, 0};
  }
  double distance(const Vec3&) const override { return 0; }

 private:
  static double within(double t) { return std::clamp(t, 0x1p-53, kLastBelowOne); }

  double center_, scale_;
};

class SquareChart final : public Chart {
 public:
  Vec3 from_square(const Point2& p) const override { return {p[0], p[1], 0}; }
  Point2 to_square(const Vec3& x) const override {
    return {std::clamp(x[0], 0.0, 1.0), std::clamp(x[1], 0.0, 1.0)};
  }
  double element(const Point2&) const override { return 1; }
  Vec3 near(const Vec3& x, double distance, double angle) const override {
    return moved_in_plane(x, distance, angle);
  }
  double distance(const Vec3& x) const override {
    return std::max(outside(x[0], 0, 1), outside(x[1], 0, 1));
  }
};

/// Polar: the square's first coordinate is the squared radius, which preserves area.
class DiskChart final : public Chart {
 public:
  explicit DiskChart(double radius) : radius_(radius) {}

  Vec3 from_square(const Point2& p) const override {
    const double r = radius_ * std::sqrt(p[0]), phi = 2 * pi * p[1];
    return {r * std::cos(phi), r * std::sin(phi), 0};
  }
  Point2 to_square(const Vec3& x) const override {
    const double r2 = (x[0] * x[0] + x[1] * x[1]) / (radius_ * radius_);
    return {std::min(r2, 1.0), turns(x[1], x[0])};
  }
  double element(const Point2&) const override { return pi * radius_ * radius_; }
  Vec3 near(const Vec3& x, double distance, double angle) const override {
    return moved_in_plane(x, distance * radius_, angle);
  }
  double distance(const Vec3& x) const override {
    return std::max(0.0, std::hypot(x[0], x[1]) / radius_ - 1);
  }

 private:
  double radius_;
};

/// The square's first coordinate is (x + y)², its second y/(x + y): preserves area up to the factor
/// ½.
class TriangleChart final : public Chart {
 public:
  Vec3 from_square(const Point2& p) const override {
    const double sum = std::sqrt(p[0]);
    return {sum * (1 - p[1]), sum * p[1], 0};
  }
  Point2 to_square(const Vec3& x) const override {
    const double sum = x[0] + x[1];
    return {std::clamp(sum * sum, 0.0, 1.0), sum > 0 ? std::clamp(x[1] / sum, 0.0, 1.0) : 0.5};
  }
  double element(const Point2&) const override { return 0.5; }
  Vec3 near(const Vec3& x, double distance, double angle) const override {
    return moved_in_plane(x, distance, angle);
  }
  double distance(const Vec3& x) const override {
    return std::max({0.0, -x[0], -x[1], x[0] + x[1] - 1});
  }
};

class SurfaceChart final : public Chart {
 public:
  SurfaceChart(std::function<Vec3(const Point2&)> from_square,
               std::function<Point2(const Vec3&)> to_square,
               std::function<double(const Point2&)> area_element)
      : from_(std::move(from_square)), to_(std::move(to_square)), area_(std::move(area_element)) {}

  Vec3 from_square(const Point2& p) const override { return from_(p); }
  Point2 to_square(const Vec3& x) const override { return to_(x); }
  double element(const Point2& p) const override { return area_(p); }
  Vec3 near(const Vec3& x, double distance, double angle) const override {
    const Point2 p = to_(x);
    return from_({std::clamp(p[0] + distance * std::cos(angle), 0.0, 1.0),
                  std::clamp(p[1] + distance * std::sin(angle), 0.0, 1.0)});
  }
  double distance(const Vec3& x) const override {
    const Vec3 y = from_(to_(x));
    return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
  }

 private:
  std::function<Vec3(const Point2&)> from_;
  std::function<Point2(const Vec3&)> to_;
  std::function<double(const Point2&)> area_;
};

/// Between equal parts of [0, 1].
std::vector<double> even_lines(std::size_t parts) {
  std::vector<double> lines;
  for (std::size_t i = 1; i < parts; ++i) {
    lines.push_back(static_cast<double>(i) / static_cast<double>(parts));
  }
  return lines;
}

}  // namespace

Domain::Domain(std::string name, int dimension, std::shared_ptr<const Chart> chart)
    : name_(std::move(name)), dimension_(dimension), chart_(std::move(chart)) {}

Domain Domain::interval(double low, double high) {
  if (!(low < high)) throw std::invalid_argument("Domain::interval: needs low < high");
  return {"interval", 1, std::make_shared<IntervalChart>(low, high)};
}

Domain Domain::half_line(double scale) {
  if (!(scale > 0) || std::isinf(scale)) {
    throw std::invalid_argument("Domain::half_line: the scale is positive and finite");
  }
  return {"half-line", 1, std::make_shared<HalfLineChart>(scale)};
}

Domain Domain::line(double center, double scale) {
  if (!std::isfinite(center) || !(scale > 0) || std::isinf(scale)) {
    throw std::invalid_argument(
        "Domain::line: the center is finite, the scale positive and finite");
  }
  return {"line", 1, std::make_shared<LineChart>(center, scale)};
}

Domain Domain::discrete(std::size_t size) {
  if (size == 0) throw std::invalid_argument("Domain::discrete: needs at least one point");
  Domain domain("discrete set", 0, nullptr);
  domain.size_ = size;
  return domain;
}

Domain Domain::unit_square() { return {"unit square", 2, std::make_shared<SquareChart>()}; }

Domain Domain::disk(double radius) {
  if (!(radius > 0)) throw std::invalid_argument("Domain::disk: needs a positive radius");
  return {"disk", 2, std::make_shared<DiskChart>(radius)};
}

Domain Domain::triangle() { return {"triangle", 2, std::make_shared<TriangleChart>()}; }

Domain Domain::of_directions(std::string name, std::shared_ptr<const Chart> chart) {
  Domain domain(std::move(name), 2, std::move(chart));
  domain.directions_ = true;
  return domain;
}

Domain Domain::sphere() {
  return of_directions("sphere", direction_chart(0, 1)).with_breaks({0.5});
}

Domain Domain::hemisphere(bool upper) {
  return upper ? of_directions("upper hemisphere", direction_chart(0, 0.5))
               : of_directions("lower hemisphere", direction_chart(0.5, 1));
}

Domain Domain::equirectangular(std::size_t columns, std::size_t rows, const Vec3& up,
                               const Vec3& start) {
  const bool at_right_angles = std::abs(length(up) - 1) < 1e-6 &&
                               std::abs(length(start) - 1) < 1e-6 &&
                               std::abs(dot(up, start)) < 1e-6;
  if (columns == 0 || rows == 0 || !at_right_angles) {
    throw std::invalid_argument(
        "Domain::equirectangular: needs pixels, and unit vectors at right angles");
  }
  return of_directions("latitude-longitude map", latitude_chart(up, start))
      .with_breaks(even_lines(rows), even_lines(columns));
}

Domain Domain::octahedral(std::size_t pixels_per_side) {
  if (pixels_per_side == 0) throw std::invalid_argument("Domain::octahedral: needs pixels");
  return of_directions("octahedral map", octahedral_chart())
      .with_breaks({0.5}, {0.5})  // where the octahedron's edges run
      .with_breaks(even_lines(pixels_per_side), even_lines(pixels_per_side));
}

Domain Domain::with_breaks(const std::vector<double>& first,
                           const std::vector<double>& second) const {
  Domain domain = *this;
  const std::array<const std::vector<double>*, 2> added{&first, &second};
  for (std::size_t d = 0; d < 2; ++d) {
    std::vector<double>& lines = domain.breaks_[d];
    lines.insert(lines.end(), added[d]->begin(), added[d]->end());
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  }
  return domain;
}

Domain Domain::surface(std::function<Vec3(const Point2&)> from_square,
                       std::function<Point2(const Vec3&)> to_square,
                       std::function<double(const Point2&)> area_element) {
  return {"surface", 2,
          std::make_shared<SurfaceChart>(std::move(from_square), std::move(to_square),
                                         std::move(area_element))};
}

}  // namespace plumbline::verify
