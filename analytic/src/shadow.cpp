#include <plumbline/analytic/shadow.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "piecewise.h"

namespace plumbline::analytic {
namespace {

using std::numbers::pi;

/// ∫ dy/(a² + y²)² from 0 to y.
double inner_integral(double a, double y) {
  return (a * y / (a * a + y * y) + std::atan(y / a)) / (2 * a * a * a);
}

}  // namespace

double disk_part_irradiance(double radius, double height, double x, double y, double from_x) {
  // On the disk x' = R sin t, half a chord R cos t: what was a square root at the rim is smooth.
  const double low = std::asin(std::clamp(from_x / radius, -1.0, 1.0));
  const auto chord = [&](double t) {
    const double half = radius * std::cos(t);
    const double a = std::hypot(height, radius * std::sin(t) - x);
    return (inner_integral(a, half - y) + inner_integral(a, half + y)) * half;
  };
  return height * height * integrate_smooth(chord, low, pi / 2, 1e-13).value;
}

double disk_irradiance(double radius, double height, double lateral) {
  const double sum = height * height + lateral * lateral + radius * radius;
  const double root = std::sqrt(sum * sum - 4 * lateral * lateral * radius * radius);
  // 1 − (sum − 2 R²)/root without cancelling: (root² − (sum − 2R²)²)/(root (root + sum − 2R²)),
  // whose numerator is 4 R² H².
  return 2 * pi * radius * radius * height * height / (root * (root + sum - 2 * radius * radius));
}

double eclipsed_irradiance(const SphereCone& light, const SphereCone& blocker) {
  if (!(light.z >= std::sin(light.half_angle))) {
    throw std::invalid_argument("the light must stand wholly above the horizon");
  }
  const double along = light.x * blocker.x + light.y * blocker.y + light.z * blocker.z;
  const double cx = light.y * blocker.z - light.z * blocker.y;
  const double cy = light.z * blocker.x - light.x * blocker.z;
  const double cz = light.x * blocker.y - light.y * blocker.x;
  const double apart = std::atan2(std::hypot(cx, cy, cz), along);
  if (apart + light.half_angle <= blocker.half_angle) return 0;
  const double full = pi * std::sin(light.half_angle) * std::sin(light.half_angle) * light.z;
  if (apart >= light.half_angle + blocker.half_angle) return full;

  // On the ring at angle a from the light's axis cosθ = z cos a + s sin a cos φ. With the azimuth
  // counted from the blocker, a symmetric part |φ| < Φ is covered, and of s only the component
  // towards the blocker, n·e, stays in the integral over it.
  const double toward = apart > 0 ? (blocker.z - light.z * along) / std::sin(apart) : 0;
  const auto covered_ring = [&](double a) {
    double half_width = pi;
    const double denominator = std::sin(a) * std::sin(apart);
    const double cosine = std::cos(blocker.half_angle) - std::cos(a) * std::cos(apart);
    if (cosine >= denominator) return 0.0;
    if (cosine > -denominator) half_width = std::acos(cosine / denominator);
    return 2 * std::sin(a) *
           (light.z * std::cos(a) * half_width + toward * std::sin(a) * std::sin(half_width));
  };
  const double covered =
      integrate_pieces(
          covered_ring,
          make_cuts(0, light.half_angle,
                    {std::abs(apart - blocker.half_angle), apart + blocker.half_angle}),
          1e-8 * full)
          .value;
  return std::max(0.0, full - covered);
}

}  // namespace plumbline::analytic
