#include "pairs/seams.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plumbline::verify {

bool more_than_seams(double points, double of) {
  constexpr double kSeamPoints = 2, kSeamShare = 0.002;
  return points > std::max(kSeamPoints, kSeamShare * of);
}

bool agree(double pdf, const DensityAt& density, double tolerance) {
  return std::abs(pdf / density.value - 1) <= tolerance + 4 * density.relative_error;
}

std::vector<Closely> look_closely(const Map& map, const std::vector<Differing>& points,
                                  int dimension, double epsilon, double tolerance) {
  std::vector<Closely> seen(points.size());
  const auto look = [&](std::size_t i, const DensityAt& d) {
    if (!(d.relative_error <= tolerance)) return;
    const DensityAt& far = points[i].far;
    const double apart = std::abs(far.value / d.value - 1);
    const bool contradicts = apart > tolerance + 4 * (far.relative_error + d.relative_error);
    seen[i].contradicts = seen[i].contradicts || contradicts;
    const bool known = d.relative_error <= tolerance / 4 || contradicts;
    if (known && agree(points[i].pdf, d, tolerance)) seen[i].agrees = true;
  };
  std::vector<Uniforms> u;
  for (const Differing& point : points) u.push_back(point.u);
  for (const double step : kShortSteps) {
    const auto near = densities_by_differences(map, u, dimension, epsilon, step);
    for (std::size_t i = 0; i < u.size(); ++i) {
      if (near[i]) look(i, *near[i]);
    }
  }
  const auto beside = densities_on_one_side(map, u, dimension, epsilon);
  for (std::size_t i = 0; i < u.size(); ++i) {
    for (const DensityAt& d : beside[i]) look(i, d);
  }
  return seen;
}

}  // namespace plumbline::verify
