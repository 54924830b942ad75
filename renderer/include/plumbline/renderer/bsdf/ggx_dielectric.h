#pragma once

#include <optional>

#include <plumbline/renderer/bsdf/bsdf_sample.h>
#include <plumbline/renderer/bsdf/fresnel.h>
#include <plumbline/renderer/bsdf/ggx.h>

namespace plumbline::renderer {

/// Rough glass: single scattering between GGX microfacets that reflect or refract, like Mitsuba's
/// `roughdielectric` with the distribution `ggx`. Lobe 0 reflects, lobe 1 refracts.
///
/// Which of the two is sampled is decided before the normal is, by a guess of the reflectance over
/// the visible normals: two numbers are all that `sample` gets, and the normal takes both. Seen
/// from inside, wo is mirrored at the surface and η inverted.
struct GgxDielectric {
  Ggx ggx;
  BareInterface interface;  ///< η ≠ 1: without a step of the index the refracted lobe is an atom

  static constexpr BsdfParts parts() { return {.density = true, .transmission = true}; }

  /// @param wo, wi  unit vectors in the local frame, pointing away from the surface
  /// @return        f [1/sr], without the cosine, for radiance
  template <class T>
  Rgb<T> eval(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return evaluate(wo, wi).f;
  }

  template <class T>
  BsdfValue<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return evaluate_with(interface, wo, wi);
  }

  /// @param u  in [0, 1)²; u.x chooses the lobe and is then rescaled
  /// @return   nullopt where the normal leads to the wrong side, or is to refract what it reflects
  ///           totally
  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec2<T>& u) const {
    return sample_with(interface, wo, u);
  }

  /// @return pdf_w [1/sr] of `sample(wo, u)`
  template <class T>
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
    const std::uint32_t lobe = wo.z * wi.z > T(0) ? 0 : 1;
    return lobe_probability(wo, lobe) * pdf_lobe(wo, wi, lobe);
  }

  static constexpr std::uint32_t lobe_count() { return 2; }

  template <class T>
  T lobe_probability(const Vec3<T>& wo, std::uint32_t lobe) const {
    const T eta = static_cast<T>(relative_index<T>(interface.eta, wo.z > T(0)));
    const T reflect = mean_reflectance(upright(wo, wo), eta);
    const T probability = std::clamp(reflect, T(kLeastProbability), T(T(1) - T(kLeastProbability)));
    return lobe == 0 ? probability : T(T(1) - probability);
  }

  template <class T>
  std::optional<BsdfSample<T>> sample_lobe(const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const {
    return sample_lobe_with(interface, wo, lobe, u);
  }

  /// @source reflection: see GgxConductor::pdf. Refraction: visible normals, Heitz 2018, Eq. 3,
  /// with
  ///         the Jacobian η_i² |wi·h| / |η_o wo + η_i wi|² of Walter et al. 2007, Eq. 17
  template <class T>
  T pdf_lobe(const Vec3<T>& wo, const Vec3<T>& wi, std::uint32_t lobe) const {
    const auto half = half_vector(wo, wi);
    if (!half || half->refracts != (lobe == 1)) return T(0);
    return density(*half, upright(wo, wo));
  }

  /// The same at another interface of the same index: what a film makes of it.
  ///
  /// @source Walter et al. 2007, Eqs. 20 and 21 (o the side of wo): f = F G1(wi)/cosθi pdf_w of the
  ///         lobe, or (1 − F)/η² instead of F, where G1/cosθ = 2/(cosθ + S) takes the cosine out
  template <class T, class Interface>
  BsdfValue<T> evaluate_with(const Interface& film, const Vec3<T>& wo, const Vec3<T>& wi) const {
    const auto half = half_vector(wo, wi);
    if (!half) return {};
    const T lobe_pdf = density(*half, upright(wo, wo));
    const T pdf_w = lobe_probability(wo, half->refracts ? 1 : 0) * lobe_pdf;
    const Vec3<T> i = upright(wi, wi);
    const T common = T(2) * lobe_pdf / (i.z + ggx.stretched_length(i));
    if (!half->refracts) {
      const auto power = film.template split<T>(half->wide_cos_o, wo.z > T(0));
      return {to_rgb(power.reflected) * common, pdf_w};
    }
    // Both sides give the same share; the thinner one has no critical angle to lose digits at.
    const bool thin_outside = interface.eta > 1;
    const bool from_thin = (wo.z > T(0)) == thin_outside;
    const auto power =
        film.template split<T>(from_thin ? half->wide_cos_o : half->wide_cos_i, thin_outside);
    const T eta = static_cast<T>(relative_index<T>(interface.eta, wo.z > T(0)));
    return {to_rgb(power.transmitted) * T(common / sqr(eta)), pdf_w};
  }

  template <class T, class Interface>
  std::optional<BsdfSample<T>> sample_with(const Interface& film, const Vec3<T>& wo,
                                           const Vec2<T>& u) const {
    const T reflect = lobe_probability(wo, 0);
    const auto choice = choose_lobe(u.x, reflect);
    const T probability = choice.lobe == 0 ? reflect : T(T(1) - reflect);
    auto result = sample_lobe_with(film, wo, choice.lobe, Vec2<T>{choice.u, u.y});
    if (!result) return std::nullopt;
    // The lobes do not overlap: the other one adds no density.
    result->weight = result->weight / probability;
    result->pdf_w = result->pdf_w * probability;
    return result;
  }

  template <class T, class Interface>
  std::optional<BsdfSample<T>> sample_lobe_with(const Interface& film, const Vec3<T>& wo,
                                                std::uint32_t lobe, const Vec2<T>& u) const {
    using std::sqrt;
    using W = Wide<T>;
    if (wo.z == T(0)) return std::nullopt;
    const Vec3<T> up = upright(wo, wo);
    const auto visible = ggx.sample_visible(up, u);
    const W eta = relative_index<T>(interface.eta, wo.z > T(0));
    const T length = sqrt(length_squared(visible.normal));
    const T cosine = std::min(T(visible.cosine / length), T(1));
    const W wide_cosine = static_cast<W>(cosine);
    const auto power = film.template split<T>(wide_cosine, wo.z > T(0));
    BsdfSample<T> result;
    result.lobe = lobe;
    if (lobe == 0) {
      result.wi = reflect(up, visible);
      if (!(result.wi.z > T(0))) return std::nullopt;
      result.weight = to_rgb(power.reflected) * ggx.masking(result.wi);
    } else {
      // wi = ((cos − g) h − wo)/η with g = η cosθt: Walter et al. 2007, Eq. 40
      const T g = static_cast<T>(refracted_cosine(wide_cosine, eta));
      const T inverse_eta = static_cast<T>(W(1) / eta);
      result.wi = (visible.normal * T((cosine - g) / length) - up) * inverse_eta;
      if (!(g > T(0) && result.wi.z < T(0))) return std::nullopt;
      result.radiance_scale = sqr(inverse_eta);
      result.weight = to_rgb(power.transmitted) * T(ggx.masking(result.wi) * sqr(inverse_eta));
    }
    result.wi = upright(wo, result.wi);
    result.pdf_w = pdf_lobe(wo, result.wi, lobe);
    return result;
  }

 private:
  /// Least probability of a lobe: some normals reflect, and some refract, where the guess says that
  /// none do.
  static constexpr float kLeastProbability = 0.05f;

  /// Mirrors w at the surface if wo is inside.
  template <class T>
  static Vec3<T> upright(const Vec3<T>& wo, const Vec3<T>& w) {
    return wo.z < T(0) ? Vec3<T>{w.x, w.y, T(-w.z)} : w;
  }

  template <class T>
  struct HalfVector {
    bool refracts;
    Vec3<T> normal;  // unnormalised, on the side of wo made upright
    T cos_o, cos_i;  // |wo·h|, |wi·h|
    Wide<T> wide_cos_o, wide_cos_i;
    T inverse_square;  // of η: η²/|wo + η wi|², refraction only
  };

  /// pdf_w of the lobe that the half vector belongs to, wo made upright.
  template <class T>
  T density(const HalfVector<T>& half, const Vec3<T>& up) const {
    const T visible = ggx.density(half.normal) / (up.z + ggx.stretched_length(up));
    if (!half.refracts) return visible / T(2);
    return T(2) * visible * half.cos_o * half.cos_i * half.inverse_square;
  }

  /// The normal that takes wo to wi. Wide, because η wi rounded to float would move a normal at
  /// α = 1e-4 by a thousandth of its lobe.
  ///
  /// @return nullopt if it does not show its front to wo, or refracts to the side of wo
  /// @source Walter et al. 2007, Eqs. 13 and 16
  template <class T>
  std::optional<HalfVector<T>> half_vector(const Vec3<T>& wo, const Vec3<T>& wi) const {
    using std::sqrt;
    using W = Wide<T>;
    if (wo.z * wi.z == T(0)) return std::nullopt;
    const Vec3<W> o = vec_cast<W>(upright(wo, wo)), i = vec_cast<W>(upright(wo, wi));
    const bool refracts = i.z < W(0);
    const W eta = refracts ? relative_index<T>(interface.eta, wo.z > T(0)) : W(1);
    Vec3<W> h = o + i * eta;
    const W square = length_squared(h);
    if (h.z < W(0)) h = -h;
    const W scale = W(1) / sqrt(square);
    const W cos_o = dot(o, h) * scale, cos_i = refracts ? W(-dot(i, h) * scale) : cos_o;
    if (!(cos_o > W(0) && cos_i > W(0))) return std::nullopt;
    return HalfVector<T>{refracts,
                         vec_cast<T>(h),
                         static_cast<T>(cos_o),
                         static_cast<T>(cos_i),
                         std::min(cos_o, W(1)),
                         std::min(cos_i, W(1)),
                         static_cast<T>(W(sqr(eta) / square))};
  }

  /// A guess of the mean reflectance of the normals that wo sees: Schlick's at three normals of
  /// mean height on the cap of Ggx::sample_visible, at the nodes of Chebyshev in azimuth.
  template <class T>
  T mean_reflectance(const Vec3<T>& wo, const T& eta) const {
    using std::sqrt;
    const T stretch = ggx.stretched_length(wo);
    const T wz = wo.z / stretch, wt = safe_sqrt(T(T(1) - sqr(wz)));
    const T z = (T(1) - wz) / T(2), t = sqrt(T(T(1) - sqr(z)));
    const T alpha2 = T(ggx.alpha_x) * T(ggx.alpha_y);
    T sum(0);
    for (const float cos_phi : {-0.8660254f, 0.0f, 0.8660254f}) {
      const T across = wt * t * T(cos_phi);
      const T height2 = sqr(T(z + wz)), tangent2 = sqr(wt) + sqr(t) + T(2) * across;
      sum = sum +
            schlick(T(stretch * (T(1) + across + wz * z) / sqrt(T(alpha2 * tangent2 + height2))),
                    eta);
    }
    return sum / T(3);
  }

  /// @source Schlick 1994, from the cosine on the thinner side, so that total reflection is met
  template <class T>
  static T schlick(const T& cos_o, const T& eta) {
    const T cosine = eta < T(1) ? T(refracted_cosine(cos_o, eta) / eta) : cos_o;
    const T x = std::max(T(T(1) - cosine), T(0));
    const T normal = sqr(T((eta - T(1)) / (eta + T(1))));
    return normal + (T(1) - normal) * sqr(sqr(x)) * x;
  }
};

}  // namespace plumbline::renderer
