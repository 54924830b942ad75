#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <plumbline/verify/mean.h>
#include <plumbline/verify/pair.h>

#include "parts.h"

namespace plumbline::duet {
namespace {

using verify::CheckResult;
using verify::SamplingPair;
using verify::Vec3;

/// Cosine-weighted directions: cheap, so that the checks' own time is what is measured.
SamplingPair cosine_pair() {
  const auto sample = [](double u, double v) {
    const double r = std::sqrt(u), phi = 2 * std::numbers::pi * v;
    return Vec3{r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
  };
  const auto pdf = [](const Vec3& w) { return w[2] > 0 ? w[2] / std::numbers::pi : 0; };
  return verify::sampling_pair<Vec3>("cosine", verify::Domain::sphere(), sample, pdf);
}

verify::ContractOptions little_effort() {
  verify::ContractOptions options;
  options.points = 200;
  options.jacobian_points = 100;
  options.evaluations = 2000;
  options.first_look = 1000;
  options.samples = 1000;
  options.finest_bins = 16;
  return options;
}

Counters counters_of(const CheckResult& result) {
  Counters counters;
  counters.samples = result.samples;
  counters.result = with_bits(with_bits(0, result.estimate.value_or(0)), result.bound.value_or(0));
  return counters;
}

using PairCheck = CheckResult (*)(const SamplingPair&, const verify::ContractOptions&);

Part pair_part(const char* name, PairCheck check) {
  return {name,
          [check](Size) -> Work {
            return [pair = cosine_pair(), options = little_effort(), check] {
              return counters_of(check(pair, options));
            };
          },
          false};
}

/// A mean of 1/3, known: how many samples does it take until that is proven?
Counters decide_mean() {
  verify::MeanOptions options;
  options.subject = "u²";
  options.reference = 1.0 / 3;
  options.tolerance = 0.05;
  verify::MeanCheck check(options);
  std::uint64_t drawn = 0;
  while (!check.done()) {
    verify::Moments batch;
    for (std::uint64_t wanted = check.samples_wanted(); wanted > 0; --wanted, ++drawn) {
      const double golden = static_cast<double>(drawn) * std::numbers::phi;
      const double u = golden - std::floor(golden);
      batch.add(u * u);
    }
    check.add(batch);
  }
  return counters_of(check.result());
}

std::vector<Part> make_verify_parts() {
  return {pair_part("verify/chi_square", verify::check_chi_square),
          pair_part("verify/integral", verify::check_integral),
          pair_part("verify/jacobian", verify::check_jacobian),
          {"verify/mean", [](Size) -> Work { return decide_mean; }, false}};
}

}  // namespace

std::span<const Part> verify_parts() {
  static const std::vector<Part> parts = make_verify_parts();
  return parts;
}

}  // namespace plumbline::duet
