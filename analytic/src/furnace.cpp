#include <plumbline/analytic/furnace.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace plumbline::analytic {
namespace {

void require_furnace(double albedo, double radiance, int max_depth) {
  if (!(albedo >= 0 && albedo <= 1)) throw std::invalid_argument("albedo must be in [0, 1]");
  if (!(radiance >= 0 && radiance <= std::numeric_limits<double>::max())) {
    throw std::invalid_argument("radiance must be finite and not negative");
  }
  if (max_depth < -1) throw std::invalid_argument("max_depth must be -1 (unlimited) or more");
}

}  // namespace

double closed_furnace_radiance(double albedo, double radiance, int max_depth) {
  require_furnace(albedo, radiance, max_depth);
  if (max_depth == -1) {
    if (albedo == 1) {
      throw std::invalid_argument("a closed furnace of albedo 1 has no finite answer at any depth");
    }
    return radiance / (1 - albedo);
  }
  // Term by term: (1 − albedo^k)/(1 − albedo) cancels near albedo 1, and fails at 1. Beyond a few
  // terms, of which a header may ask for billions, by functions that do not cancel.
  constexpr int kFewTerms = 1000;
  if (max_depth > kFewTerms) {
    const double sum =
        albedo == 1 ? max_depth : -std::expm1(max_depth * std::log1p(albedo - 1)) / (1 - albedo);
    return radiance * sum;
  }
  double sum = 0;
  double power = 1;
  for (int i = 0; i < max_depth; ++i) {
    sum += power;
    power *= albedo;
  }
  return radiance * sum;
}

double open_furnace_radiance(double albedo, double radiance, int max_depth) {
  require_furnace(albedo, radiance, max_depth);
  return max_depth == 0 || max_depth == 1 ? 0 : albedo * radiance;
}

}  // namespace plumbline::analytic
