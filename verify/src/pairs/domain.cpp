#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <plumbline/verify/detail/domain.h>

#include "vec3.h"

namespace plumbline::verify {

namespace {

constexpr double kPi = std::numbers::pi;

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
    const double r = radius_ * std::sqrt(p[0]), phi = 2 * kPi * p[1];
    return {r * std::cos(phi), r * std::sin(phi), 0};
  }
  Point2 to_square(const Vec3& x) const override {
    const double r2 = (x[0] * x[0] + x[1] * x[1]) / (radius_ * radius_);
    const double phi = std::atan2(x[1], x[0]) / (2 * kPi);
    return {std::min(r2, 1.0), phi < 0 ? phi + 1 : phi};
  }
  double element(const Point2&) const override { return kPi * radius_ * radius_; }
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

/// Square = ((1 − z)/2, φ/2π) on the sphere, and the same stretched on a hemisphere.
class DirectionChart final : public Chart {
 public:
  /// Of (1 − z)/2, the part that the domain covers.
  DirectionChart(double first, double last) : first_(first), extent_(last - first) {}

  Vec3 from_square(const Point2& p) const override {
    const double half = first_ + extent_ * p[0];  // (1 − z)/2
    const double phi = 2 * kPi * p[1];
    const double radius = 2 * std::sqrt(half * (1 - half));  // √(1 − z²)
    return {radius * std::cos(phi), radius * std::sin(phi), 1 - 2 * half};
  }
  Point2 to_square(const Vec3& w) const override {
    // (1 − z)/2 from x and y: near the poles float directions keep no digits of it in z.
    const double radius2 = w[0] * w[0] + w[1] * w[1];
    const double small = radius2 / (2 * (1 + std::abs(w[2])));
    const double half = w[2] >= 0 ? small : 1 - small;
    const double phi = std::atan2(w[1], w[0]) / (2 * kPi);
    return {std::clamp((half - first_) / extent_, 0.0, 1.0), phi < 0 ? phi + 1 : phi};
  }
  double element(const Point2&) const override { return 4 * kPi * extent_; }
  std::optional<double> break_line() const override {
    return extent_ < 1 ? std::nullopt : std::optional(0.5);
  }

  Vec3 near(const Vec3& w, double distance, double angle) const override {
    const Vec3 axis = std::abs(w[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    const Vec3 s = normalized(cross(axis, w));
    const Vec3 t = cross(w, s);
    Vec3 moved;
    for (std::size_t i = 0; i < 3; ++i) {
      moved[i] = w[i] + distance * (std::cos(angle) * s[i] + std::sin(angle) * t[i]);
    }
    return normalized(moved);
  }
  double distance(const Vec3& w) const override {
    const double length_error = std::abs(std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) - 1);
    // |z| beyond the horizon, for a hemisphere.
    const double beyond = outside(w[2], 1 - 2 * (first_ + extent_), 1 - 2 * first_);
    return std::max(length_error, extent_ < 1 ? beyond : 0.0);
  }

 private:
  double first_, extent_;
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

}  // namespace

Domain::Domain(std::string name, int dimension, std::shared_ptr<const Chart> chart)
    : name_(std::move(name)), dimension_(dimension), chart_(std::move(chart)) {}

Domain Domain::interval(double low, double high) {
  if (!(low < high)) throw std::invalid_argument("Domain::interval: needs low < high");
  return {"interval", 1, std::make_shared<IntervalChart>(low, high)};
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

Domain Domain::sphere() {
  Domain domain("sphere", 2, std::make_shared<DirectionChart>(0, 1));
  domain.directions_ = true;
  return domain;
}

Domain Domain::hemisphere(bool upper) {
  Domain domain(
      upper ? "upper hemisphere" : "lower hemisphere", 2,
      upper ? std::make_shared<DirectionChart>(0, 0.5) : std::make_shared<DirectionChart>(0.5, 1));
  domain.directions_ = true;
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
