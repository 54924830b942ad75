#pragma once

#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_sample.h>
#include <plumbline/renderer/core/bsdf/fresnel.h>
#include <plumbline/renderer/core/bsdf/ggx.h>

namespace plumbline::renderer {

/// Polished metal: one atom in the mirror direction. Black from behind, like Mitsuba's `conductor`.
struct SmoothConductor {
  ConductorFresnel fresnel;

  static constexpr BsdfParts parts() { return {.atoms = true}; }

  template <class T>
  Rgb<T> eval(const Vec3<T>&, const Vec3<T>&) const {
    return {};
  }

  /// @return the mirror direction with mass 1; nullopt from behind
  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec2<T>& u) const {
    return sample_with(fresnel, wo, u);
  }

  template <class T>
  T pdf(const Vec3<T>&, const Vec3<T>&) const {
    return T(0);
  }

  /// The same under another reflectance, a function of the cosine's square: what a film makes of
  /// it.
  template <class T, class Reflectance>
  std::optional<BsdfSample<T>> sample_with(const Reflectance& reflectance, const Vec3<T>& wo,
                                           const Vec2<T>&) const {
    if (!(wo.z > T(0))) return std::nullopt;
    return atom_sample(mirror(wo), reflectance(sqr(wo.z)), T(1));
  }
};

}  // namespace plumbline::renderer
