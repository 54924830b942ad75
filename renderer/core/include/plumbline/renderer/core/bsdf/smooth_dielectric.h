#pragma once

#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_sample.h>
#include <plumbline/renderer/core/bsdf/fresnel.h>
#include <plumbline/renderer/core/bsdf/ggx.h>

namespace plumbline::renderer {

/// Polished glass: an atom in the mirror direction and one in the refracted direction, like
/// Mitsuba's `dielectric`. Lobe 0 reflects, lobe 1 refracts; each is chosen with its share of the
/// power, so that η = 1 is invisible and total reflection loses nothing.
struct SmoothDielectric {
  BareInterface interface;

  static constexpr BsdfParts parts() { return {.atoms = true, .transmission = true}; }

  template <class T>
  Rgb<T> eval(const Vec3<T>&, const Vec3<T>&) const {
    return {};
  }

  /// @param u  in [0, 1)²; only u.x is used
  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec2<T>& u) const {
    return sample_with(interface, wo, u);
  }

  template <class T>
  T pdf(const Vec3<T>&, const Vec3<T>&) const {
    return T(0);
  }

  static constexpr std::uint32_t lobe_count() { return 2; }

  template <class T>
  T lobe_probability(const Vec3<T>& wo, std::uint32_t lobe) const {
    return lobe_probability_with(interface, wo, lobe);
  }

  template <class T>
  std::optional<BsdfSample<T>> sample_lobe(const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const {
    return sample_lobe_with(interface, wo, lobe, u);
  }

  template <class T>
  T pdf_lobe(const Vec3<T>&, const Vec3<T>&, std::uint32_t) const {
    return T(0);
  }

  /// The same at another interface of the same index: what a film makes of it.
  template <class T, class Interface>
  std::optional<BsdfSample<T>> sample_with(const Interface& film, const Vec3<T>& wo,
                                           const Vec2<T>& u) const {
    if (wo.z == T(0)) return std::nullopt;
    const auto power = split_at<T>(film, wo);
    const T reflect = mean(power.reflected);
    if (u.x < reflect) return as_part(reflected(wo, power), T(1), reflect);
    return as_part(refracted(wo, power), T(1), T(mean(power.transmitted)));
  }

  template <class T, class Interface>
  T lobe_probability_with(const Interface& film, const Vec3<T>& wo, std::uint32_t lobe) const {
    const auto power = split_at<T>(film, wo);
    return lobe == 0 ? mean(power.reflected) : mean(power.transmitted);
  }

  template <class T, class Interface>
  std::optional<BsdfSample<T>> sample_lobe_with(const Interface& film, const Vec3<T>& wo,
                                                std::uint32_t lobe, const Vec2<T>&) const {
    if (wo.z == T(0)) return std::nullopt;
    const auto power = split_at<T>(film, wo);
    if (lobe == 0) return reflected(wo, power);
    if (!(mean(power.transmitted) > T(0))) return std::nullopt;
    return refracted(wo, power);
  }

 private:
  template <class T, class Interface>
  static auto split_at(const Interface& film, const Vec3<T>& wo) {
    return film.template split<T>(sqr(static_cast<Wide<T>>(wo.z)), wo.z > T(0));
  }

  template <class T, class S>
  static BsdfSample<T> reflected(const Vec3<T>& wo, const PowerSplit<S>& power) {
    return {.wi = mirror(wo), .weight = to_rgb(power.reflected), .mass = T(1)};
  }

  /// Snell: the tangential part shrinks by 1/η. Radiance shrinks by 1/η², as the solid angle does.
  ///
  /// @source Veach 1997, Section 5.2
  template <class T, class S>
  BsdfSample<T> refracted(const Vec3<T>& wo, const PowerSplit<S>& power) const {
    using W = Wide<T>;
    const W eta = relative_index<T>(interface.eta, wo.z > T(0));
    const auto z = static_cast<W>(wo.z);
    const W cos_t = refracted_cosine(z, eta) / eta;
    const T shrink = static_cast<T>(W(1) / eta);
    const Vec3<T> wi{T(-wo.x * shrink), T(-wo.y * shrink),
                     static_cast<T>(z > W(0) ? W(-cos_t) : cos_t)};
    return {.wi = wi,
            .weight = to_rgb(power.transmitted) * sqr(shrink),
            .mass = T(1),
            .radiance_scale = sqr(shrink),
            .lobe = 1};
  }
};

}  // namespace plumbline::renderer
