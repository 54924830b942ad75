#pragma once

#include <array>
#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_sample.h>
#include <plumbline/renderer/core/bsdf/fresnel.h>
#include <plumbline/renderer/core/bsdf/ggx_conductor.h>
#include <plumbline/renderer/core/bsdf/lambertian.h>

namespace plumbline::renderer {

/// A rough dielectric coat over a diffuse base. Black from behind.
///
/// The base gets what the coat lets in from wo and wi, and is scaled so that at base albedo 1 all
/// that the coat does not reflect comes back out:
///
///   f = f_coat + albedo/π (1 − E(wo)) (1 − E(wi)) / (1 − E_mean),
///
/// E the directional albedo of the coat, E_mean its cosine-weighted mean. So f is reciprocal, and
/// its own albedo is E + albedo (1 − E) ≤ 1.
/// @source Kelemen, Szirmay-Kalos 2001, "A microfacet based coupled specular-matte BRDF model with
///         importance sampling", Section 2.2
class ClearCoat {
 public:
  /// Tabulates E, which takes some milliseconds.
  ///
  /// @param eta     index of the coat over the index outside, > 1
  /// @param alpha   roughness of the coat, 1e-4 … 1
  /// @param albedo  of the base, per channel, [0, 1]
  ClearCoat(float eta, float alpha, const Rgbf& albedo)
      : coat_{{alpha, alpha}, {}}, reflectance_{{eta}}, base_{albedo} {
    tabulate();
  }

  float eta() const { return reflectance_.interface.eta; }
  float alpha() const { return coat_.ggx.alpha_x; }
  const Rgbf& base_albedo() const { return base_.albedo; }

  static constexpr BsdfParts parts() { return {.density = true}; }

  /// @param wo, wi  unit vectors in the local frame, pointing away from the surface
  /// @return        f [1/sr], without the cosine; 0 unless both are above the horizon
  template <class T>
  Rgb<T> eval(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return evaluate(wo, wi).f;
  }

  template <class T>
  BsdfValue<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi) const {
    if (!(wo.z > T(0) && wi.z > T(0))) return {};
    return evaluate_from(coat_at(wo.z), wo, wi);
  }

  /// @param u  in [0, 1)²; u.x chooses the lobe and is then rescaled
  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec2<T>& u) const {
    if (!(wo.z > T(0))) return std::nullopt;
    const CoatAt<T> coat = coat_at(wo.z);
    const auto choice = choose_lobe(u.x, coat.probability);
    const Vec3<T> wi = direction(wo, choice.lobe, Vec2<T>{choice.u, u.y});
    if (!(wi.z > T(0))) return std::nullopt;
    const BsdfValue<T> both = evaluate_from(coat, wo, wi);
    return density_sample(wi, both.f * T(wi.z / both.pdf_w), both.pdf_w, T(1), choice.lobe);
  }

  /// @return pdf_w [1/sr] of `sample(wo, u)`: both lobes
  template <class T>
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return evaluate(wo, wi).pdf_w;
  }

  /// Lobe 0 is the coat, lobe 1 the base.
  static constexpr std::uint32_t lobe_count() { return 2; }

  template <class T>
  T lobe_probability(const Vec3<T>& wo, std::uint32_t lobe) const {
    const T coat = coat_at(wo.z).probability;
    return lobe == 0 ? coat : T(T(1) - coat);
  }

  template <class T>
  std::optional<BsdfSample<T>> sample_lobe(const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const {
    auto result =
        lobe == 0 ? coat_.sample_with(reflectance_, wo, u) : base_.sample(wo, Vec2<T>{u.y, u.x});
    if (result) result->lobe = lobe;
    return result;
  }

  template <class T>
  T pdf_lobe(const Vec3<T>& wo, const Vec3<T>& wi, std::uint32_t lobe) const {
    return lobe == 0 ? coat_.pdf(wo, wi) : base_.pdf(wo, wi);
  }

 private:
  static constexpr int kNodes = 65;

  /// Of the coat, as seen from a direction.
  template <class T>
  struct CoatAt {
    T albedo, probability;  // by the light that each lobe gives back
  };

  /// The coat's reflectance from outside, in the place of ConductorFresnel.
  struct Reflectance {
    BareInterface interface;

    template <class T>
    [[gnu::always_inline]] Rgb<T> operator()(const T& cos2_o) const {
      // From the thinner side T will do.
      const T eta = T(interface.eta), gap = (eta - T(1)) * (eta + T(1));
      return to_rgb(fresnel_dielectric(cos2_o, eta, gap).reflected);
    }
  };

  template <class T>
  [[gnu::always_inline]] BsdfValue<T> evaluate_from(const CoatAt<T>& seen, const Vec3<T>& wo,
                                                    const Vec3<T>& wi) const {
    const T share = (T(1) - seen.albedo) * (T(1) - coat_at(wi.z).albedo) * T(share_scale_);
    const BsdfValue<T> coat = coat_.evaluate_with(reflectance_, wo, wi);
    return {coat.f + base_.eval(wo, wi) * share,
            seen.probability * coat.pdf_w + (T(1) - seen.probability) * base_.pdf(wo, wi)};
  }

  /// The base gets the numbers the other way round: what was rescaled to choose a lobe turns the
  /// azimuth. As the height it would lose the digits that wi next to the horizon needs.
  template <class T>
  [[gnu::always_inline]] Vec3<T> direction(const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const {
    return lobe == 0 ? reflect(wo, coat_.ggx.sample_visible(wo, u))
                     : square_to_cosine_hemisphere(Vec2<T>{u.y, u.x});
  }

  /// At a cosine, between nodes that are equally spaced in its fourth root: E is steep at grazing,
  /// and bends where the cosine is of the size of the roughness, down to 1e-4.
  template <class T>
  [[gnu::always_inline]] CoatAt<T> coat_at(const T& cosine) const {
    const T place = safe_sqrt(safe_sqrt(cosine)) * T(kNodes - 1);
    const int below = std::min(static_cast<int>(place), kNodes - 2);
    const auto node = static_cast<std::size_t>(below);
    const T part = place - T(below);
    const CoatAt<float>&a = table_[node], &b = table_[node + 1];
    return {T(a.albedo) + (T(b.albedo) - T(a.albedo)) * part,
            T(a.probability) + (T(b.probability) - T(a.probability)) * part};
  }

  double integrate_albedo(double cosine) const;
  void tabulate();

  GgxConductor coat_;  // lends its lobe; what that reflects is up to `reflectance_`
  Reflectance reflectance_;
  Lambertian base_;
  std::array<CoatAt<float>, kNodes> table_{};
  float share_scale_ = 1;  // 1/(1 − E_mean)
};

}  // namespace plumbline::renderer
