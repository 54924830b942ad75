#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <plumbline/renderer/core/light/light.h>
#include "light_examples.h"

namespace plumbline::tests {

/// 1 − cos of the cone that light `i` of many_lights is seen in.
inline double one_minus_cos(std::uint32_t i) {
  return std::ldexp(1.0, -1 - static_cast<int>(i % 7));
}

/// Lights of very different size and brightness that overlap in direction: seen from the origin
/// all lie around the same axis, one behind the other.
inline std::vector<renderer::Light> many_lights(std::uint32_t count) {
  std::vector<renderer::Light> lights;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float distance = 3 + 2 * static_cast<float>(i);
    const auto h = static_cast<float>(one_minus_cos(i));
    lights.emplace_back(renderer::SphereLight{{0, 0, distance},
                                              distance * std::sqrt(h * (2 - h)),
                                              false,
                                              kRadiance * (0.5f + static_cast<float>(i % 11))});
  }
  return lights;
}

inline renderer::LightSet light_set(std::uint32_t count, renderer::LightSelection selection) {
  std::vector<std::uint32_t> groups(count);
  std::iota(groups.begin(), groups.end(), 0u);
  return {many_lights(count), groups, selection, 1};
}

/// Variance of 1/pdf over the cone of light `i` and 0 elsewhere, where pdf is the sum over all
/// lights. All cones lie around one axis, so the sum is constant between one edge and the next, and
/// E[X²] = ∫ dω/pdf is a sum over rings of 2π Δ(1 − cosθ)/pdf.
inline double variance_of_solid_angle(const renderer::LightSet& lights, std::uint32_t count,
                                      std::uint32_t i) {
  std::vector<double> edges{0};
  for (std::uint32_t k = 0; k < count; ++k) edges.push_back(one_minus_cos(k));
  std::sort(edges.begin(), edges.end());
  const double two_pi = 2 * renderer::pi<double>(), h = one_minus_cos(i);
  double square = 0;
  for (std::size_t ring = 0; ring + 1 < edges.size() && edges[ring + 1] <= h; ++ring) {
    double pdf = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      if (one_minus_cos(k) >= edges[ring + 1]) {
        pdf += lights.pmf<double>(k) / (two_pi * one_minus_cos(k));
      }
    }
    if (edges[ring + 1] > edges[ring]) square += two_pi * (edges[ring + 1] - edges[ring]) / pdf;
  }
  return square - two_pi * h * two_pi * h;
}

}  // namespace plumbline::tests
