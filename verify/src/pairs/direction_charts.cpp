#include "pairs/direction_charts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "turns.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

using std::numbers::pi;

/// Charts of unit vectors.
class SphereChart : public Chart {
 public:
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
  // Near 1 squares are safe, and dearer is what length() does for others.
  double distance(const Vec3& w) const override { return std::abs(std::sqrt(dot(w, w)) - 1); }
};

/// Square = ((1 − z)/2, φ/2π) on the sphere, and the same stretched on a hemisphere.
class DirectionChart final : public SphereChart {
 public:
  /// Of (1 − z)/2, the part that the domain covers.
  DirectionChart(double first, double last) : first_(first), extent_(last - first) {}

  Vec3 from_square(const Point2& p) const override {
    const double half = first_ + extent_ * p[0];  // (1 − z)/2
    const double phi = 2 * pi * p[1];
    const double radius = 2 * std::sqrt(half * (1 - half));  // √(1 − z²)
    return {radius * std::cos(phi), radius * std::sin(phi), 1 - 2 * half};
  }
  Point2 to_square(const Vec3& w) const override {
    // (1 − z)/2 from x and y: near the poles float directions keep no digits of it in z.
    const double radius2 = w[0] * w[0] + w[1] * w[1];
    const double small = radius2 / (2 * (1 + std::abs(w[2])));
    const double half = w[2] >= 0 ? small : 1 - small;
    return {std::clamp((half - first_) / extent_, 0.0, 1.0), turns(w[1], w[0])};
  }
  double element(const Point2&) const override { return 4 * pi * extent_; }
  double distance(const Vec3& w) const override {
    // |z| beyond the horizon, for a hemisphere.
    const double low = 1 - 2 * (first_ + extent_), high = 1 - 2 * first_;
    const double beyond = extent_ < 1 ? std::max(low - w[2], w[2] - high) : 0.0;
    return std::max(SphereChart::distance(w), beyond);
  }

 private:
  double first_, extent_;
};

class LatitudeChart final : public SphereChart {
 public:
  LatitudeChart(const Vec3& up, const Vec3& start)
      : up_(up), start_(start), side_(cross(up, start)) {}

  Vec3 from_square(const Point2& p) const override {
    const double theta = pi * p[0], phi = 2 * pi * p[1];
    return sum(
        scaled(up_, std::cos(theta)),
        scaled(sum(scaled(start_, std::cos(phi)), scaled(side_, std::sin(phi))), std::sin(theta)));
  }
  Point2 to_square(const Vec3& w) const override {
    const double x = dot(w, start_), y = dot(w, side_);
    // By the arc tangent: near the poles an arc cosine of z has no digits left.
    return {std::atan2(std::hypot(x, y), dot(w, up_)) / pi, turns(y, x)};
  }
  // dω = sinθ dθ dφ.
  double element(const Point2& p) const override { return 2 * pi * pi * std::sin(pi * p[0]); }

 private:
  Vec3 up_, start_, side_;
};

class OctahedralChart final : public SphereChart {
 public:
  Vec3 from_square(const Point2& p) const override { return normalized(on_octahedron(p)); }
  Point2 to_square(const Vec3& w) const override {
    const double sum = std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2]);
    double x = w[0] / sum, y = w[1] / sum;
    if (w[2] < 0) {
      const double folded = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
      y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
      x = folded;
    }
    return {std::clamp((x + 1) / 2, 0.0, 1.0), std::clamp((y + 1) / 2, 0.0, 1.0)};
  }
  // The square is the octahedron's shadow, twice as large. A face is 1/√3 from the middle and its
  // shadow 1/√3 of it: dω = cos/r² dA = (1/√3)/r³ · √3 dx dy, and dx dy = 4 dp.
  double element(const Point2& p) const override {
    const double r = length(on_octahedron(p));
    return 4 / (r * r * r);
  }

 private:
  static Vec3 on_octahedron(const Point2& p) {
    double x = 2 * p[0] - 1, y = 2 * p[1] - 1;
    const double z = 1 - std::abs(x) - std::abs(y);
    if (z < 0) {
      const double folded = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
      y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
      x = folded;
    }
    return {x, y, z};
  }
};

}  // namespace

std::shared_ptr<const Chart> direction_chart(double first, double last) {
  return std::make_shared<DirectionChart>(first, last);
}

std::shared_ptr<const Chart> latitude_chart(const Vec3& up, const Vec3& start) {
  return std::make_shared<LatitudeChart>(up, start);
}

std::shared_ptr<const Chart> octahedral_chart() { return std::make_shared<OctahedralChart>(); }

}  // namespace plumbline::verify
