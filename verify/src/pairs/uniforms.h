#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <plumbline/verify/pair.h>

namespace plumbline::verify {

/// Random numbers for one sample, in the precision of the code that takes them.
inline Uniforms draw_uniforms(Random& random, int numbers, double epsilon) {
  Uniforms u{};
  for (int i = 0; i < numbers; ++i) {
    u[static_cast<std::size_t>(i)] =
        epsilon > 0x1p-40 ? static_cast<double>(random.uniform_float()) : random.uniform();
  }
  return u;
}

/// A multiple of 2^-20 inside (0, 1), so that steps of differences are exact in float too.
inline double on_grid_of_differences(double u) {
  return std::clamp(std::round(u * 0x1p20) * 0x1p-20, 0x1p-20, 1 - 0x1p-20);
}

/// Such a number, uniform in the middle, and as often close to one end: maps are steep there.
inline double draw_for_differences(Random& random) {
  double u = random.uniform();
  if (random.uniform() < 0.5) {
    const double small = std::exp2(-16 * random.uniform() - 1);
    u = random.uniform() < 0.5 ? small : 1 - small;
  }
  return on_grid_of_differences(u);
}

}  // namespace plumbline::verify
