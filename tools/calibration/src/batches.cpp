#include "batches.h"

#include <cmath>

namespace plumbline::calibration {

namespace {

/// n equal samples, by doubling.
verify::Moments repeated(double x, std::uint64_t n) {
  verify::Moments sum, power;
  power.add(x);
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) sum.merge(power);
    power.merge(power);
  }
  return sum;
}

/// Gaps between the ones are geometric.
std::uint64_t count_ones(double p, std::uint64_t n, verify::Random& random) {
  const double scale = 1 / std::log1p(-p);
  std::uint64_t ones = 0;
  for (double at = 0;; ++ones) {
    at += 1 + std::floor(std::log(1 - random.uniform()) * scale);
    if (at > static_cast<double>(n)) return ones;
  }
}

verify::Moments draw_bernoulli(double p, std::uint64_t n, verify::Random& random) {
  const std::uint64_t ones = count_ones(p, n, random);
  verify::Moments m = repeated(0, n - ones);
  m.merge(repeated(1, ones));
  return m;
}

}  // namespace

verify::Moments bernoulli_moments(double p, std::uint64_t n, std::uint64_t seed) {
  verify::Random random(seed);
  return draw_bernoulli(p, n, random);
}

verify::MomentSampler bernoulli_sampler(double p, std::uint64_t seed) {
  return [p, random = verify::Random(seed)](std::uint64_t, std::uint64_t count) mutable {
    return draw_bernoulli(p, count, random);
  };
}

}  // namespace plumbline::calibration
