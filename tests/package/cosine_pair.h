#pragma once

#include <array>
#include <cmath>

#include <plumbline/verify/pair.h>

/// What the consumers check: a cosine-weighted direction with its density, right if `scale` is 1.
inline plumbline::verify::Report check_cosine(double scale) {
  using Direction = std::array<double, 3>;
  constexpr double kPi = 3.14159265358979323846;
  return plumbline::verify::check_pair(plumbline::verify::sampling_pair<Direction>(
      "cosine", plumbline::verify::Domain::sphere(),
      [](double u, double v) {
        const double radius = std::sqrt(u);
        return Direction{radius * std::cos(2 * kPi * v), radius * std::sin(2 * kPi * v),
                         std::sqrt(1 - u)};
      },
      [scale](const Direction& w) { return w[2] > 0 ? scale * w[2] / kPi : 0.0; }));
}
