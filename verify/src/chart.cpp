#include "chart.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumbline::verify {

namespace {

constexpr double kPi = std::numbers::pi;

class SphereChart final : public Chart {
 public:
  Vec3 from_square(const Point2& p) const override {
    const double phi = 2 * kPi * p[1];
    const double radius = 2 * std::sqrt(p[0] * (1 - p[0]));  // sqrt(1 − z²) with z = 1 − 2 p
    return {radius * std::cos(phi), radius * std::sin(phi), 1 - 2 * p[0]};
  }

  Point2 to_square(const Vec3& w) const override {
    // (1 − z)/2 from x and y where z is near ±1: there float directions keep no digits in z.
    const double radius2 = w[0] * w[0] + w[1] * w[1];
    const double half = radius2 / (2 * (1 + std::abs(w[2])));
    const double phi = std::atan2(w[1], w[0]) / (2 * kPi);
    return {std::clamp(w[2] >= 0 ? half : 1 - half, 0.0, 1.0), phi < 0 ? phi + 1 : phi};
  }

  double measure() const override { return 4 * kPi; }

  Vec3 near(const Vec3& w, double distance, double angle) const override {
    // Any two axes that span the tangent plane will do.
    const int smallest = std::abs(w[0]) < std::abs(w[1])
                             ? (std::abs(w[0]) < std::abs(w[2]) ? 0 : 2)
                             : (std::abs(w[1]) < std::abs(w[2]) ? 1 : 2);
    Vec3 axis{};
    axis[static_cast<std::size_t>(smallest)] = 1;
    const Vec3 s = normalized(cross(axis, w));
    const Vec3 t = cross(w, s);
    Vec3 moved;
    for (std::size_t i = 0; i < 3; ++i) {
      moved[i] = w[i] + distance * (std::cos(angle) * s[i] + std::sin(angle) * t[i]);
    }
    return normalized(moved);
  }

 private:
  static Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Vec3 normalized(const Vec3& v) {
    const double length = std::hypot(v[0], v[1], v[2]);
    return {v[0] / length, v[1] / length, v[2] / length};
  }
};

}  // namespace

const Chart& sphere_chart() {
  static const SphereChart chart;
  return chart;
}

}  // namespace plumbline::verify
