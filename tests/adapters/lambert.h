#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include <plumbline/verify/bsdf.h>
#include <plumbline_tests/support.h>

/// One correct BSDF, of which each test writes down something in another way.
namespace plumbline::tests {

using std::numbers::pi;

struct V {
  double x, y, z;
};

struct Record {
  V wi;
  double pdf, weight;
};

/// White at 50 %, on the front only, in Plumbline's own conventions.
struct Lambert {
  static constexpr double kAlbedo = 0.5;

  std::optional<Record> sample(const V& wo, double u, double v) const {
    if (wo.z <= 0) return std::nullopt;
    const double radius = std::sqrt(u), phi = 2 * pi * v, z = std::sqrt(1 - u);
    return Record{{radius * std::cos(phi), radius * std::sin(phi), z}, z / pi, kAlbedo};
  }
  double pdf(const V& wo, const V& wi) const { return wo.z > 0 && wi.z > 0 ? wi.z / pi : 0; }
  double eval(const V& wo, const V& wi) const { return wo.z > 0 && wi.z > 0 ? kAlbedo / pi : 0; }
};

/// Enough for mistakes as gross as a wrong convention.
inline verify::BsdfOptions quick(const verify::BsdfConventions& conventions = {}) {
  verify::BsdfOptions o;
  o.conventions = conventions;
  o.contract.seed = check_seed("adapters");
  o.angles = {40};
  o.random_directions = 0;
  o.back = false;
  o.contract.points = 1000;
  o.contract.jacobian_points = 100;
  o.contract.finest_bins = 256;
  o.contract.first_look = o.contract.samples = 50'000;
  o.contract.deviation = 0.1;
  return o;
}

/// Whether every check gives what it should.
template <class Direction = void, class Numbers = void, class B>
bool passes(const B& bsdf, const verify::BsdfConventions& conventions = {}) {
  for (const verify::CheckResult& r :
       verify::check_bsdf<Direction, Numbers>("lambert", bsdf, quick(conventions))) {
    if (!r.as_expected()) return false;
  }
  return true;
}

}  // namespace plumbline::tests
