#pragma once

#include <cmath>

#include <plumbline/verify/detail/vector_access.h>

namespace plumbline::verify {

/// Smith's masking of the GGX distribution. @source Walter et al. 2007, Eq. 34
inline double smith_g1(const Vec3& w, double alpha) {
  const double tan2 = (w[0] * w[0] + w[1] * w[1]) / (w[2] * w[2]);
  return 2 / (1 + std::sqrt(1 + alpha * alpha * tan2));
}

}  // namespace plumbline::verify
