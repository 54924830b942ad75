#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <plumbline/renderer/light/constant_environment.h>
#include <plumbline/renderer/light/disk_light.h>
#include <plumbline/renderer/light/light_sample.h>
#include <plumbline/renderer/light/rectangle_light.h>
#include <plumbline/renderer/light/sphere_light.h>
#include <plumbline/renderer/light/triangle_light.h>

namespace plumbline::renderer {

/// What every light offers, in any scalar: a direction sample at a reference point, and its
/// density.
template <class L>
concept LightModel = requires(const L& light, const Vec3<double>& v, const Vec2<double>& u) {
  { light.sample(v, u) } -> std::same_as<std::optional<LightSample<double>>>;
  { light.pdf(v, v) } -> std::same_as<double>;
  { light.radiance } -> std::convertible_to<Rgbf>;
};

/// Every light of the renderer. The tests walk this list: an alternative without examples does not
/// compile there (tests/contracts/light_examples.h).
using Light =
    std::variant<SphereLight, RectangleLight, DiskLight, TriangleLight, ConstantEnvironment>;

static_assert(LightModel<SphereLight> && LightModel<RectangleLight> && LightModel<DiskLight> &&
              LightModel<TriangleLight> && LightModel<ConstantEnvironment>);

template <class T>
std::optional<LightSample<T>> sample(const Light& light, const Vec3<T>& ref, const Vec2<T>& u) {
  return std::visit([&](const auto& l) { return l.sample(ref, u); }, light);
}

/// @return pdf_w [1/sr] of `sample(light, ref, u)`
template <class T>
T pdf(const Light& light, const Vec3<T>& ref, const Vec3<T>& wi) {
  return std::visit([&](const auto& l) { return l.pdf(ref, wi); }, light);
}

inline Rgbf radiance(const Light& light) {
  return std::visit([](const auto& l) { return l.radiance; }, light);
}

/// Uniform choice among N lights, as a discrete sampling pair.
struct UniformLightSelection {
  std::uint32_t count = 0;  ///< N ≥ 1

  template <class T>
  struct Choice {
    std::uint32_t light;  ///< in [0, N)
    T pmf;                ///< [1]
    T u;                  ///< uniform in [0, 1) again, independent of the choice
  };

  /// @param u  in [0, 1): its integer part in units of 1/N chooses, the rest is rescaled and reused
  template <class T>
  Choice<T> sample(const T& u) const {
    const T scaled = u * T(count);
    const auto index = std::min(static_cast<std::uint32_t>(scaled), count - 1);
    return {index, pmf<T>(index), std::min(T(scaled - T(index)), kOneMinusUlp<T>)};
  }

  /// @return probability [1] that `sample` chooses `light`
  template <class T>
  T pmf(std::uint32_t light) const {
    return light < count ? T(T(1) / T(count)) : T(0);
  }

 private:
  template <class T>
  static constexpr T kOneMinusUlp = T(1) - std::numeric_limits<T>::epsilon() / T(2);
};

/// All lights of a scene with the way one of them is chosen.
class LightSet {
 public:
  LightSet() = default;
  explicit LightSet(std::vector<Light> lights)
      : lights_(std::move(lights)), selection_{static_cast<std::uint32_t>(lights_.size())} {}

  bool empty() const { return lights_.empty(); }
  std::size_t size() const { return lights_.size(); }
  const Light& operator[](std::uint32_t i) const { return lights_[i]; }

  /// Chooses a light, then a direction towards it. `pdf_w` of the result includes the choice.
  /// @param u  in [0, 1)²
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>& ref, const Vec2<T>& u) const {
    if (empty()) return std::nullopt;
    const auto choice = selection_.sample(u.x);
    auto result = renderer::sample(lights_[choice.light], ref, Vec2<T>{choice.u, u.y});
    if (result) result->pdf_w = result->pdf_w * choice.pmf;
    return result;
  }

  /// Density with which `sample(ref, u)` produces the point of light `light` seen along wi: what
  /// MIS needs at an emissive hit. Points of different lights are different points of path space,
  /// so the other lights that may lie along the same direction do not enter.
  ///
  /// @return pdf_w [1/sr], selection included
  template <class T>
  T pdf(std::uint32_t light, const Vec3<T>& ref, const Vec3<T>& wi) const {
    return selection_.pmf<T>(light) * renderer::pdf(lights_[light], ref, wi);
  }

 private:
  std::vector<Light> lights_;
  UniformLightSelection selection_;
};

}  // namespace plumbline::renderer
