#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>

#include <plumbline/renderer/core/bsdf/bsdf_sample.h>
#include <plumbline/renderer/core/bsdf/fresnel.h>
#include <plumbline/renderer/core/bsdf/ggx.h>

namespace plumbline::renderer {

/// Rough glass: single scattering between GGX microfacets that reflect or refract, like Mitsuba's
/// `roughdielectric` with the distribution `ggx`. Lobe 0 reflects, lobe 1 refracts.
///
/// Which of the two is sampled is decided before the normal is, by a table over cosθo: two numbers
/// are all that `sample` gets. Seen from inside, η is inverted.
struct GgxDielectric {
  Ggx ggx;
  BareInterface interface;  ///< η ≠ 1: without a step of the index the refracted lobe is an atom

  /// Tabulates which lobe to choose, which takes about a millisecond.
  GgxDielectric(const Ggx& distribution, const BareInterface& bare);

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
  [[gnu::always_inline]] T lobe_probability(const Vec3<T>& wo, std::uint32_t lobe) const {
    const auto& table = reflects_[wo.z > T(0) ? 1 : 0];
    const T place = (wo.z > T(0) ? wo.z : T(-wo.z)) * T(kNodes - 1);
    const int below = std::min(static_cast<int>(place), kNodes - 2);
    const auto node = static_cast<std::size_t>(below);
    const T part = place - T(below), low = T(table[node]);
    const T reflect = low + (T(table[node + 1]) - low) * part;
    return lobe == 0 ? reflect : T(T(1) - reflect);
  }

  template <class T>
  std::optional<BsdfSample<T>> sample_lobe(const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const {
    return sample_lobe_with(interface, wo, lobe, u);
  }

  /// @source reflection: see GgxConductor::pdf. Refraction: visible normals, Heitz 2018, Eq. 3,
  ///         with the Jacobian η_i² |wi·h| / |η_o wo + η_i wi|² of Walter et al. 2007, Eq. 17
  template <class T>
  T pdf_lobe(const Vec3<T>& wo, const Vec3<T>& wi, std::uint32_t lobe) const {
    const auto half = half_vector(wo, wi);
    if (!half || half->refracts != (lobe == 1)) return T(0);
    return ggx.density(half->normal) * T(half->jacobian / ggx.visible_area(wo));
  }

  /// The same at another interface of the same index: what a film makes of it.
  ///
  /// @source Walter et al. 2007, Eqs. 20 and 21 (o the side of wo): f = F G1(wi)/cosθi pdf_w of the
  ///         lobe, or (1 − F)/η² instead of F, where G1/cosθ = 2/(cosθ + S) takes the cosine out
  template <class T, class Interface>
  BsdfValue<T> evaluate_with(const Interface& film, const Vec3<T>& wo, const Vec3<T>& wi) const {
    const auto half = half_vector(wo, wi);
    if (!half) return {};
    const T lobe_pdf = ggx.density(half->normal) * T(half->jacobian / ggx.visible_area(wo));
    const T pdf_w = lobe_probability(wo, half->refracts ? 1 : 0) * lobe_pdf;
    const T common = lobe_pdf * T(T(2) / ggx.visible_area(wi));
    if (!half->refracts) {
      const auto reflected = film.template split<T>(half->cos2_o, wo.z > T(0)).reflected;
      return {to_rgb(reflected) * common, pdf_w};
    }
    // Both sides give the same share; the thinner one has no critical angle to lose digits at.
    const Wide<T> cos2 = has_critical_angle(wo) ? half->cos2_i : half->cos2_o;
    const auto transmitted = film.template split<T>(cos2, interface.eta > 1).transmitted;
    const T eta = static_cast<T>(relative_index<T>(interface.eta, wo.z > T(0)));
    return {to_rgb(transmitted) * T(common / sqr(eta)), pdf_w};
  }

  template <class T, class Interface>
  std::optional<BsdfSample<T>> sample_with(const Interface& film, const Vec3<T>& wo,
                                           const Vec2<T>& u) const {
    if (wo.z == T(0)) return std::nullopt;
    const T reflect = lobe_probability(wo, 0);
    const auto choice = choose_lobe(u.x, reflect);
    const T probability = choice.lobe == 0 ? reflect : T(T(1) - reflect);
    return scatter(film, wo, choice.lobe, probability, Vec2<T>{choice.u, u.y});
  }

  template <class T, class Interface>
  std::optional<BsdfSample<T>> sample_lobe_with(const Interface& film, const Vec3<T>& wo,
                                                std::uint32_t lobe, const Vec2<T>& u) const {
    if (wo.z == T(0)) return std::nullopt;
    return scatter(film, wo, lobe, T(1), u);
  }

 private:
  /// Least probability of a lobe: some normals reflect, and some refract, where next to none do.
  static constexpr float kLeastProbability = 0.05f;
  static constexpr int kNodes = 65;  // of the table, equally spaced in |cosθo|

  /// One lobe, chosen with `probability`. The lobes do not overlap: the other adds no density.
  template <class T, class Interface>
  [[gnu::always_inline]] std::optional<BsdfSample<T>> scatter(const Interface& film,
                                                              const Vec3<T>& wo, std::uint32_t lobe,
                                                              const T& probability,
                                                              const Vec2<T>& u) const {
    using std::sqrt;
    using W = Wide<T>;
    const Vec3<T> up = upright(wo, wo);
    const auto visible = ggx.sample_visible(up, u);
    const T inverse_length = T(1) / sqrt(length_squared(visible.normal));
    T cosine = std::min(T(visible.cosine * inverse_length), T(1));
    W cos2 = sqr(static_cast<W>(cosine));
    if (has_critical_angle(wo)) {
      const Vec3<W> normal = vec_cast<W>(visible.normal);
      cos2 = std::min(W(sqr(dot(vec_cast<W>(up), normal)) / length_squared(normal)), W(1));
      cosine = static_cast<T>(safe_sqrt(cos2));
    }
    if (lobe == 0) {
      const Vec3<T> wi = reflect(up, visible);
      if (!(wi.z > T(0))) return std::nullopt;
      const auto reflected = film.template split<T>(cos2, wo.z > T(0)).reflected;
      const Vec3<T> there = upright(wo, wi);
      return density_sample(there, to_rgb(reflected) * T(ggx.masking(wi) / probability),
                            T(probability * pdf_lobe(wo, there, 0)));
    }
    // wi = ((cos − g) h − wo)/η with g = η cosθt: Walter et al. 2007, Eq. 40
    const W eta = relative_index<T>(interface.eta, wo.z > T(0));
    const W gap = (eta - W(1)) * (eta + W(1));
    T g = safe_sqrt(static_cast<T>(gap + cos2));
    const T shrink = static_cast<T>(W(1) / eta);
    // |wi| is 1 only where that cosine is the scalar product of wo with this very normal, which may
    // be all rounding error: what two opposite vectors left. From outside the cosine so far is not.
    // The record is of the direction handed out, and takes the scalar product too, but in float:
    // there it has lost the digits that Fresnel's formulas need, and the other cosine has them.
    T along = cosine, depth = g;
    if (!has_critical_angle(wo)) {
      along = dot(up, visible.normal) * inverse_length;
      depth = safe_sqrt(static_cast<T>(gap + sqr(static_cast<W>(along))));
      if constexpr (!std::is_same_v<T, float>) {
        cosine = along;
        cos2 = sqr(static_cast<W>(along));
        g = depth;
      }
    }
    const Vec3<T> wi = (visible.normal * T((along - depth) * inverse_length) - up) * shrink;
    if (!(cosine > T(0) && g > T(0) && wi.z < T(0))) return std::nullopt;
    const auto transmitted = film.template split<T>(cos2, wo.z > T(0)).transmitted;
    // The Jacobian as in half_vector, with |wo + η wi| = |cos − g| = |η² − 1|/(cos + g).
    const T density = probability * ggx.density(visible.normal) / visible.area;
    const T jacobian = T(2) * cosine * g * sqr(T((cosine + g) / static_cast<T>(gap))) / shrink;
    return density_sample(upright(wo, wi),
                          to_rgb(transmitted) * T(ggx.masking(wi) * sqr(shrink) / probability),
                          T(density * jacobian), sqr(shrink), 1);
  }

  /// Whether wo is on the denser side, where a cosine in float would not do.
  template <class T>
  bool has_critical_angle(const Vec3<T>& wo) const {
    return (wo.z > T(0)) != (interface.eta > 1);
  }

  /// Mirrors w at the surface if wo is inside.
  template <class T>
  static Vec3<T> upright(const Vec3<T>& wo, const Vec3<T>& w) {
    return wo.z < T(0) ? Vec3<T>{w.x, w.y, T(-w.z)} : w;
  }

  template <class T>
  struct HalfVector {
    bool refracts;
    Vec3<T> normal;          // unnormalised, on the side of wo
    Wide<T> cos2_o, cos2_i;  // squares of wo·h and wi·h
    T jacobian;              // 2 (wo·h) |∂h/∂wi|
  };

  /// The normal that takes wo to wi. Wide, because η wi rounded to float would move a normal at
  /// α = 1e-4 by a thousandth of its lobe.
  ///
  /// @return nullopt if it does not show its front to wo, or refracts to the side of wo
  /// @source Walter et al. 2007, Eqs. 13 and 16
  template <class T>
  [[gnu::always_inline]] std::optional<HalfVector<T>> half_vector(const Vec3<T>& wo,
                                                                  const Vec3<T>& wi) const {
    using W = Wide<T>;
    if (wo.z * wi.z == T(0)) return std::nullopt;
    if (wo.z * wi.z > T(0)) {
      const Vec3<T> h = wo + wi;
      const W square = has_critical_angle(wo) ? length_squared(vec_cast<W>(wo) + vec_cast<W>(wi))
                                              : static_cast<W>(length_squared(h));
      const W cos2 = std::min(W(square / W(4)), W(1));
      return HalfVector<T>{false, h, cos2, cos2, T(0.5)};
    }
    const Vec3<W> o = vec_cast<W>(wo), i = vec_cast<W>(wi);
    const W eta = relative_index<T>(interface.eta, wo.z > T(0));
    Vec3<W> h = o + i * eta;
    if (h.z * o.z < W(0)) h = -h;
    const W o_h = dot(o, h), i_h = -dot(i, h);
    if (!(o_h > W(0) && i_h > W(0))) return std::nullopt;
    const W scale = W(1) / length_squared(h), cos2_o = sqr(o_h) * scale, cos2_i = sqr(i_h) * scale;
    return HalfVector<T>{true, vec_cast<T>(h), std::min(cos2_o, W(1)), std::min(cos2_i, W(1)),
                         static_cast<T>(W(2) * o_h * i_h * sqr(W(eta * scale)))};
  }

  double reflection_probability(double cosine, bool outside) const;

  std::array<std::array<float, kNodes>, 2> reflects_{};  // seen from inside, from outside
};

}  // namespace plumbline::renderer
