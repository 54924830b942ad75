#include <plumbline/renderer/core/light/light.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace plumbline::renderer {
namespace {

/// Surface [m²]; 0 of a light that has none.
double area_of(const Light& light) {
  return std::visit(
      [](const auto& l) {
        if constexpr (requires { l.template area<double>(); }) {
          return l.template area<double>();
        } else {
          return 0.0;
        }
      },
      light);
}

/// Emitted power by luminance [W]: π L per area of an emitting side; of an infinite light what
/// passes through the cross-section of the scene, from all directions.
class PowerOf {
 public:
  explicit PowerOf(double scene_radius) : cross_section_(pi<double>() * sqr(scene_radius)) {}

  double operator()(const PointLight& l) const {
    return 4 * pi<double>() * brightness(l.intensity);
  }
  double operator()(const ConstantEnvironment& l) const {
    return cross_section_ * 4 * pi<double>() * brightness(l.radiance);
  }
  double operator()(const EnvironmentMap& l) const {
    return cross_section_ * 4 * pi<double>() * l.table->mean_luminance *
           static_cast<double>(l.scale);
  }
  double operator()(const SunAndSky& l) const {
    const double sun = 2 * pi<double>() * static_cast<double>(l.one_minus_cos_angle);
    return cross_section_ * (sun * brightness(l.sun) + 4 * pi<double>() * brightness(l.sky));
  }
  template <class Surface>
  double operator()(const Surface& l) const {
    double sides = 1;
    if constexpr (requires { l.two_sided; }) sides = l.two_sided ? 2 : 1;
    return sides * pi<double>() * l.template area<double>() * brightness(l.radiance);
  }

 private:
  static double brightness(const Rgbf& c) { return luminance(rgb_cast<double>(c)); }

  double cross_section_;
};

/// One weight per group.
std::vector<double> group_weights(const std::vector<Light>& lights,
                                  const std::vector<std::uint32_t>& groups,
                                  const std::vector<double>& group_areas, LightSelection selection,
                                  double scene_radius) {
  std::vector<double> weights(group_areas.size(), 1.0);
  if (selection == LightSelection::area) {
    const double total = std::accumulate(group_areas.begin(), group_areas.end(), 0.0);
    const auto with_area =
        std::count_if(group_areas.begin(), group_areas.end(), [](double area) { return area > 0; });
    const double average = with_area > 0 ? total / static_cast<double>(with_area) : 1.0;
    for (std::size_t g = 0; g < weights.size(); ++g) {
      weights[g] = group_areas[g] > 0 ? group_areas[g] : average;
    }
  } else if (selection == LightSelection::power) {
    std::fill(weights.begin(), weights.end(), 0.0);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      weights[groups[i]] += std::visit(PowerOf(scene_radius), lights[i]);
    }
  }
  return weights;
}

std::vector<std::uint32_t> each_its_own(std::size_t count) {
  std::vector<std::uint32_t> groups(count);
  std::iota(groups.begin(), groups.end(), 0u);
  return groups;
}

}  // namespace

LightSet::LightSet(std::vector<Light> lights, const std::vector<std::uint32_t>& groups,
                   LightSelection selection, double scene_radius)
    : lights_(std::move(lights)) {
  if (lights_.empty()) return;
  std::vector<double> group_areas(*std::max_element(groups.begin(), groups.end()) + 1);
  for (std::size_t i = 0; i < lights_.size(); ++i) group_areas[groups[i]] += area_of(lights_[i]);
  std::vector<double> weights(lights_.size());
  const auto of_groups = group_weights(lights_, groups, group_areas, selection, scene_radius);
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const double group_area = group_areas[groups[i]];
    weights[i] = of_groups[groups[i]] * (group_area > 0 ? area_of(lights_[i]) / group_area : 1);
  }
  selection_ = DiscreteDistribution(weights);
}

LightSet::LightSet(const std::vector<Light>& lights)
    : LightSet(lights, each_its_own(lights.size()), LightSelection::uniform, 0) {}

}  // namespace plumbline::renderer
