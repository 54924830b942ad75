#pragma once

#include <array>

#include <plumbline/verify/vector_access.h>

namespace plumbline::verify {

using Point2 = std::array<double, 2>;

/// An area-preserving map of the unit square onto a domain: density over the square = density over
/// the domain · measure. Bins and cubature work on the square.
class Chart {
 public:
  virtual ~Chart() = default;

  virtual Vec3 from_square(const Point2& p) const = 0;
  virtual Point2 to_square(const Vec3& x) const = 0;

  /// Total measure of the domain: 4π sr for the sphere.
  virtual double measure() const = 0;

  /// A point at about the given distance from x in the domain, in direction `angle`; for telling a
  /// sample that rounding put just outside the support from one that is nowhere near it.
  virtual Vec3 near(const Vec3& x, double distance, double angle) const = 0;
};

/// Unit directions; square = ((1 − z)/2, φ/2π).
const Chart& sphere_chart();

}  // namespace plumbline::verify
