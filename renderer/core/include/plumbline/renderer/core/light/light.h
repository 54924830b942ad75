#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include <plumbline/renderer/core/light/constant_environment.h>
#include <plumbline/renderer/core/light/disk_light.h>
#include <plumbline/renderer/core/light/environment_map.h>
#include <plumbline/renderer/core/light/light_sample.h>
#include <plumbline/renderer/core/light/point_light.h>
#include <plumbline/renderer/core/light/rectangle_light.h>
#include <plumbline/renderer/core/light/sphere_light.h>
#include <plumbline/renderer/core/light/sun_and_sky.h>
#include <plumbline/renderer/core/light/triangle_light.h>
#include <plumbline/renderer/core/sampling/discrete.h>
#include <plumbline/renderer/core/sampling/pcg32.h>

namespace plumbline::renderer {

/// What every light offers, in any scalar: a direction sample at a reference point, and its
/// density.
template <class L>
concept LightModel = requires(const L& light, const Vec3<double>& v, const Vec2<double>& u) {
  { light.sample(v, u) } -> std::same_as<std::optional<LightSample<double>>>;
  { light.pdf(v, v) } -> std::same_as<double>;
};

/// Every light of the renderer.
using Light = std::variant<SphereLight, RectangleLight, DiskLight, TriangleLight,
                           ConstantEnvironment, EnvironmentMap, SunAndSky, PointLight>;

static_assert(LightModel<SphereLight> && LightModel<RectangleLight> && LightModel<DiskLight> &&
              LightModel<TriangleLight> && LightModel<ConstantEnvironment> &&
              LightModel<EnvironmentMap> && LightModel<SunAndSky> && LightModel<PointLight>);

template <class T>
std::optional<LightSample<T>> sample(const Light& light, const Vec3<T>& ref, const Vec2<T>& u) {
  return std::visit([&](const auto& l) { return l.sample(ref, u); }, light);
}

/// @return pdf_w [1/sr] of `sample(light, ref, u)`; 0 for an atom
template <class T>
T pdf(const Light& light, const Vec3<T>& ref, const Vec3<T>& wi) {
  return std::visit([&](const auto& l) { return l.pdf(ref, wi); }, light);
}

/// The same where a ray along wi is known to end on the light.
template <class T>
T pdf_at_hit(const Light& light, const Vec3<T>& ref, const Vec3<T>& wi) {
  return std::visit(
      [&](const auto& l) -> T {
        if constexpr (requires { l.pdf_at_hit(ref, wi); }) {
          return l.pdf_at_hit(ref, wi);
        } else {
          return l.pdf(ref, wi);
        }
      },
      light);
}

/// What a ray in the direction `wi` that ends on the light's front finds there [W/(m² sr)]. No ray
/// ends on a point light.
inline Rgbf radiance(const Light& light, const Vec3f& wi) {
  return std::visit(
      [&](const auto& l) -> Rgbf {
        if constexpr (requires { l.radiance_along(wi); }) {
          return l.radiance_along(wi);
        } else if constexpr (requires { l.radiance; }) {
          return l.radiance;
        } else {
          return {};
        }
      },
      light);
}

/// How one of the lights of a scene is chosen.
enum class LightSelection {
  uniform,  ///< every light alike
  area,     ///< by surface; a light without any counts like the average of those that have one
  power     ///< by emitted power; of an infinite light by what meets the scene's bounding sphere
};

/// All lights of a scene with the way one of them is chosen.
class LightSet {
 public:
  LightSet() = default;

  /// @param groups        which lights are one to the user (the triangles of a mesh): numbers from
  ///                      0 on, one per light. A group is chosen as a whole, in it a light by area.
  /// @param scene_radius  of a sphere around all surfaces [m]
  LightSet(std::vector<Light> lights, const std::vector<std::uint32_t>& groups,
           LightSelection selection, double scene_radius);

  /// Each light a group of its own, chosen uniformly.
  explicit LightSet(const std::vector<Light>& lights);

  bool empty() const { return lights_.empty(); }
  std::size_t size() const { return lights_.size(); }
  const Light& operator[](std::uint32_t i) const { return lights_[i]; }

  /// A light, and where on it.
  template <class T>
  struct Choice {
    std::uint32_t light;
    T pmf;      ///< [1]
    Vec2<T> u;  ///< uniform in [0, 1)², independent of the choice
  };

  /// Chooses by the first coordinate and stretches what the choice leaves of it over [0, 1) again:
  /// of points that form a net, those that fall to one light form a net on it.
  /// @param u  in [0, 1)²; not for an empty set
  template <class T>
  Choice<T> choose(const Vec2<T>& u) const {
    if (size() < 2) return {0, T(1), u};
    const auto choice = selection_.sample(u.x);
    return {choice.index, choice.pmf, {with_digits_below(choice, u), u.y}};
  }

  /// Probability [1] that `choose` and `sample` choose a light.
  template <class T>
  T pmf(std::uint32_t light) const {
    return selection_.pmf<T>(light);
  }

  /// Chooses a light, then a direction towards it. `pdf_w` or `mass` of the result includes the
  /// choice.
  /// @param u  in [0, 1)²
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>& ref, const Vec2<T>& u) const {
    if (empty()) return std::nullopt;
    const Choice<T> choice = choose(u);
    auto result = renderer::sample(lights_[choice.light], ref, choice.u);
    if (!result) return std::nullopt;
    result->pdf_w = result->pdf_w * choice.pmf;
    result->mass = result->mass * choice.pmf;
    return result;
  }

  /// Density with which `sample(ref, …)` produces the point of light `light` that a ray along wi is
  /// known to end on: what MIS needs at an emissive hit. Points of different lights are different
  /// points of path space, so the other lights that may lie along the same direction do not enter;
  /// the density of the direction alone is the sum over all lights.
  ///
  /// @return pdf_w [1/sr], selection included
  template <class T>
  T pdf_at_hit(std::uint32_t light, const Vec3<T>& ref, const Vec3<T>& wi) const {
    return pmf<T>(light) * renderer::pdf_at_hit(lights_[light], ref, wi);
  }

 private:
  /// The first coordinate after the choice. In float it had 24 digits, of which a choice among
  /// 1,000 lights leaves 14, too coarse to aim with: more follow from a hash of the point.
  template <class T>
  static T with_digits_below(const DiscreteDistribution::Choice<T>& choice, const Vec2<T>& u) {
    if constexpr (std::is_same_v<T, float>) {
      const auto x = std::bit_cast<std::uint32_t>(u.x), y = std::bit_cast<std::uint32_t>(u.y);
      const float digits =
          to_unit(static_cast<std::uint32_t>(mix_bits(std::uint64_t{x} << 32 | y)));
      return std::min(choice.u + 0x1p-24f * digits / choice.pmf, 1 - 0x1p-24f);
    } else {
      return choice.u;
    }
  }

  std::vector<Light> lights_;
  DiscreteDistribution selection_;
};

}  // namespace plumbline::renderer
