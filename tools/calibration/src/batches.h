#pragma once

#include <cstdint>
#include <vector>

#include <plumbline/calibration/samplers.h>

namespace plumbline::calibration {

/// Samples in batches, as the variance ratio takes them.
template <class Draw>
std::vector<verify::Moments> batches(std::uint64_t seed, Draw draw, int count, std::uint64_t size) {
  const verify::MomentSampler draw_more = sampler(seed, draw);
  std::vector<verify::Moments> result;
  result.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) result.push_back(draw_more(0, size));
  return result;
}

/// Moments of n samples that are 1 with probability p, else 0. Takes time like the number of ones,
/// so that events of 1e-4 can be looked at by the million.
verify::Moments bernoulli_moments(double p, std::uint64_t n, std::uint64_t seed);

/// A sampler of a mean check made of them.
verify::MomentSampler bernoulli_sampler(double p, std::uint64_t seed);

}  // namespace plumbline::calibration
