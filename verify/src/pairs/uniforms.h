#pragma once

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

}  // namespace plumbline::verify
