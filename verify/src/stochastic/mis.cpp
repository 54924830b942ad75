#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "directions.h"
#include "means/joint_agreement.h"
#include "stochastic/views.h"
#include "streams.h"
#include "text.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

/// Light from far away, sampled in proportion to it: L = 1 in a cap, or 1 + cos of the angle from
/// an axis.
class DistantLight {
 public:
  /// @param half_angle  [rad] of a cap
  static DistantLight cap(const Vec3& axis, double half_angle) {
    return {axis, std::cos(half_angle)};
  }
  static DistantLight sky(const Vec3& axis) { return {axis, -1}; }

  std::string name() const { return (is_sky() ? "sky towards " : "cap around ") + place(axis_); }

  double radiance(const Vec3& w) const {
    const double t = dot(w, axis_);
    if (is_sky()) return std::max(0.0, 1 + t);
    return t >= least_ ? 1 : 0;
  }

  double pdf(const Vec3& w) const { return radiance(w) / power_; }

  /// radiance / pdf, wherever that is not 0/0.
  double power() const { return power_; }

  Vec3 sample(Random& random) const {
    const double u = random.uniform(), phi = 2 * std::numbers::pi * random.uniform();
    // Of a sky t has the distribution function (1 + t)²/4.
    const double t = is_sky() ? 2 * std::sqrt(u) - 1 : 1 - u * (1 - least_);
    const double r = std::sqrt(std::max(0.0, 1 - t * t));
    return sum(scaled(axis_, t),
               sum(scaled(side_, r * std::cos(phi)), scaled(other_side_, r * std::sin(phi))));
  }

 private:
  DistantLight(const Vec3& axis, double least)
      : axis_(axis),
        side_(normalized(cross(axis, std::abs(axis[0]) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}))),
        other_side_(cross(axis, side_)),
        least_(least),
        // ∫(1 + cos) dw = 4π over the sphere; a cap takes 2π (1 − cos of its half-angle).
        power_(least < -0.5 ? 4 * std::numbers::pi : 2 * std::numbers::pi * (1 - least)) {}

  bool is_sky() const { return least_ < -0.5; }

  Vec3 axis_, side_, other_side_;
  double least_, power_;
};

constexpr double kNarrowCap = 0.3, kWideCap = 0.9;  // half-angles [rad]
constexpr std::size_t kLights = 3, kHeuristics = 2;

/// Weight of the technique whose density is `mine` beside one of the density `other`, one sample of
/// each. NaN where one is.
///
/// @source Veach 1997, Eqs. 9.8 (balance) and 9.13 (power, β = 2)
double mis_weight(double mine, double other, std::size_t heuristic) {
  const double ratio = other / mine;
  return 1 / (1 + (heuristic == 0 ? ratio : ratio * ratio));
}

class MisMean {
 public:
  explicit MisMean(const StochasticView& view) : view_(view) {
    Random random = random_for(view.seed, Stream::stochastic_lights);
    const auto lit = [&] {
      const auto n = static_cast<double>(view.pilot.size());
      return view.pilot.empty() ? view.wo
                                : view.pilot[static_cast<std::size_t>(random.uniform() * n)];
    };
    lights_.push_back(DistantLight::cap(lit(), kNarrowCap));
    lights_.push_back(DistantLight::cap(lit(), kWideCap));
    lights_.push_back(DistantLight::sky(uniform_direction(random)));
    static constexpr const char* kNames[] = {", balance heuristic", ", power heuristic"};
    for (std::size_t l = 0; l < kLights; ++l) {
      for (std::size_t h = 0; h < kHeuristics; ++h) {
        for (std::size_t c = 0; c < view.channels; ++c) {
          quantities_.push_back({lights_[l].name() + kNames[h], quantities_.size()});
        }
      }
    }
  }

  CheckResult run() {
    Random of_mis = random_for(view_.seed, Stream::stochastic_mis);
    Random of_light = random_for(view_.seed, Stream::stochastic_light_points);
    return agree_jointly(
        mean_options(view_, "mis"), quantities_,
        [&](std::uint64_t count, JointMoments& moments) {
          for (std::uint64_t i = 0; i < count; ++i) add_combined(of_mis, moments);
        },
        [&](std::uint64_t count, JointMoments& moments) {
          for (std::uint64_t i = 0; i < count; ++i) add_light_alone(of_light, moments);
        });
  }

 private:
  std::size_t index(std::size_t light, std::size_t heuristic, std::size_t channel) const {
    return (light * kHeuristics + heuristic) * view_.channels + channel;
  }

  void add_combined(Random& random, JointMoments& moments) const {
    std::vector<double> value(quantities_.size());
    for (std::size_t l = 0; l < kLights; ++l) {
      const Vec3 wi = lights_[l].sample(random);
      const Channels f = view_.bsdf.eval(view_.wo, wi, random);
      const double pdf = pdf_or_nan(view_.bsdf.pdf(view_.wo, wi, random));
      for (std::size_t h = 0; h < kHeuristics; ++h) {
        const double factor =
            mis_weight(lights_[l].pdf(wi), pdf, h) * std::abs(wi[2]) * lights_[l].power();
        for (std::size_t c = 0; c < view_.channels; ++c) value[index(l, h, c)] += f[c] * factor;
      }
    }
    add_bsdf_sample(random, value);
    for (std::size_t i = 0; i < value.size(); ++i) moments.add(i, value[i]);
  }

  void add_bsdf_sample(Random& random, std::vector<double>& value) const {
    const std::optional<SampleRecord> s = view_.bsdf.sample(view_.wo, random);
    if (!s || is_atom(*s)) return;
    const double pdf = pdf_or_nan(s->pdf ? *s->pdf : view_.bsdf.pdf(view_.wo, s->x, random));
    for (std::size_t l = 0; l < kLights; ++l) {
      const double radiance = lights_[l].radiance(s->x);
      if (radiance == 0) continue;
      for (std::size_t h = 0; h < kHeuristics; ++h) {
        const double factor = mis_weight(pdf, lights_[l].pdf(s->x), h) * radiance;
        for (std::size_t c = 0; c < view_.channels; ++c) {
          value[index(l, h, c)] += s->weight[c] * factor;
        }
      }
    }
  }

  /// Points of the regions and of the light by the balance heuristic: both densities are exact.
  void add_light_alone(Random& random, JointMoments& moments) const {
    const Regions::Point p = view_.regions.draw(random);
    const Channels f_at_p = view_.bsdf.eval(view_.wo, p.x, random);
    for (std::size_t l = 0; l < kLights; ++l) {
      const Vec3 wi = lights_[l].sample(random);
      const Channels f = view_.bsdf.eval(view_.wo, wi, random);
      const double at_p = both(l, p.x, p.inverse_density);
      const double at_wi = both(l, wi, view_.regions.inverse_density(wi));
      for (std::size_t c = 0; c < view_.channels; ++c) {
        const double value = f_at_p[c] * at_p + f[c] * at_wi;
        for (std::size_t h = 0; h < kHeuristics; ++h) moments.add(index(l, h, c), value);
      }
    }
  }

  /// |cosθ| L over the sum of both densities.
  double both(std::size_t light, const Vec3& wi, double inverse_density) const {
    const double radiance = lights_[light].radiance(wi);
    // The inverse may be 0 in a region without area; never where the light alone has come.
    return radiance == 0 ? 0
                         : std::abs(wi[2]) * radiance * inverse_density /
                               (1 + lights_[light].pdf(wi) * inverse_density);
  }

  const StochasticView& view_;
  std::vector<DistantLight> lights_;
  std::vector<JointQuantity> quantities_;
};

}  // namespace

CheckResult check_mis_mean(const StochasticView& view) { return MisMean(view).run(); }

}  // namespace plumbline::verify
