#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "seen_ratios.h"

/// Samples that have the density of other points than pdf() is asked at.
namespace plumbline::verify {

/// Alike in no two directions, nor with any of them exchanged.
inline double lopsided(const Vec3& x) {
  return 2 + 0.5 * x[0] + 0.3 * x[1] + 0.2 * x[2] + 0.2 * x[0] * x[1] - 0.15 * x[1] * x[2] +
         0.1 * x[0] * x[0];
}

inline Vec3 turned_by(const Vec3& w, double degrees) {
  const double a = degrees * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
  return {c * w[0] - s * w[1], s * w[0] + c * w[1], w[2]};
}

inline Said said_of_moved_points(const Domain& domain, const OfPoint& pdf, const OfPoint& samples) {
  std::vector<Vec3> points;
  for (const Point2& p : even_points(kRatiosPerView))
    points.push_back(domain.chart().from_square(p));
  SeenRatios seen(domain, pdf, points, [&](const Vec3& x) { return samples(x) / pdf(x); });
  return simplest(Observations::of_density(seen.evidence()),
                  argument_hypotheses(seen.evidence(), of_pdf(), false));
}

}  // namespace plumbline::verify
