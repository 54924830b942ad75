#include <array>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_microfacet.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fourth::on;
using fourth::said;
using fourth::TrowbridgeReitz;

template <class T>
T cosine_inside(T cosine, T eta) {
  return std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
}

/// Paint under a smooth sheet of water, whose mirror is left to somebody else: Lambert's law
/// inside, and refraction on the way out.
template <class T>
struct UnderWater {
  T albedo = T(0.5), eta = T(1.4);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> inside = cosine_hemisphere(u.x, u.y);
    const V3<T> flat{eta * inside.x, eta * inside.y, 0};
    const T z2 = 1 - dot(flat, flat);
    if (!(z2 > 0)) return std::nullopt;
    const V3<T> wi{flat.x, flat.y, std::sqrt(z2)};
    const T in = 1 - fresnel_dielectric(wo.z, eta), out = 1 - fresnel_dielectric(wi.z, eta);
    const T q = pdf(wo, wi);
    if (fault == 1) return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
    return Sampled<T>{wi, albedo * in * out, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return wi.z / (pi_v<T> * (fault == 1 ? T(1) : eta * eta));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T in = 1 - fresnel_dielectric(wo.z, eta), out = 1 - fresnel_dielectric(wi.z, eta);
    return albedo * in * out / (pi_v<T> * (fault == 2 ? T(1) : eta * eta));
  }
};

/// Candy paint: a sharp coat, coloured lacquer, and metal below that is rougher.
template <class T>
struct Candy {
  int fault = 0;
  TrowbridgeReitz<T> coat{T(0.12), T(0.12)}, metal{T(0.45), T(0.45)};
  T coat_share = T(0.4), eta = T(1.5), thickness = T(0.3);

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const TrowbridgeReitz<T>& s = u.z < coat_share ? coat : metal;
    const V3<T> wi = mirrored_at(wo, s.visible(wo, u.x, u.y));
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    const TrowbridgeReitz<T>& of_coat = fault == 2 ? metal : coat;
    const T both = coat_share * of_coat.visible_density(wo, m) +
                   (1 - coat_share) * metal.visible_density(wo, m);
    return both / (4 * dot(wo, m));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    const T f = fresnel_dielectric(dot(wo, m), eta), g = 4 * wo.z * wi.z;
    T way = 1 / cosine_inside(wi.z, eta);
    if (fault != 1) way += 1 / cosine_inside(wo.z, eta);
    const T through = (1 - f) * (1 - f) * std::exp(-thickness * way);
    return f * coat.d(m) * coat.g2(wo, wi) / g +
           through * T(0.8) * metal.d(m) * metal.g2(wo, wi) / g;
  }
};

/// Polished stone: a mirror by Fresnel's share of the light, over a matt body.
template <class T>
struct Stone {
  T albedo = T(0.4);
  int fault = 0;

  struct Record {
    V3<T> wi;
    T weight, pdf;
    bool is_delta;
  };
  static T mirror(T cosine) { return fresnel_dielectric(cosine, T(1.7)); }
  T mirror_share(const V3<T>& wo) const {
    const T f = mirror(wo.z);
    return f / (f + (1 - f) * albedo);
  }
  Record sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return {wo, 0, 0, false};
    const T p = mirror_share(wo);
    if (u.x < p) {
      return {{-wo.x, -wo.y, wo.z}, mirror(wo.z) / p, fault == 1 ? mirror(wo.z) : p, true};
    }
    const T left = (u.x - p) / (fault == 2 ? T(1) : 1 - p);
    const V3<T> wi = cosine_hemisphere(below_one(left), u.y);
    const T q = pdf(wo, wi);
    return {wi, eval(wo, wi) * wi.z / q, q, false};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return (1 - mirror_share(wo)) * wi.z / pi_v<T>;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return (1 - mirror(wo.z)) * (1 - mirror(wi.z)) * albedo / pi_v<T>;
  }
};

BsdfOptions stone_options(std::vector<double> angles) {
  BsdfOptions options = seen_from(std::move(angles));
  options.conventions.zero_pdf_is_failure = true;
  return options;
}

/// Diffuse, highlight and clear coat with one number for the choice, as engines' standard material.
///
/// @source Burley 2012, "Physically Based Shading at Disney", appendix B
template <class T>
struct Standard {
  int fault = 0;
  T roughness = T(0.55), gloss = T(0.3), colour = T(0.5), specular = T(0.3), clearcoat = T(0.6);

  static T lerp(T a, T b, T x) { return a + (b - a) * x; }
  TrowbridgeReitz<T> facets() const { return {sqr(roughness), sqr(roughness)}; }
  T coat_alpha(bool of_pdf) const {
    return of_pdf && fault == 2 ? lerp(T(0.05), T(0.3), gloss) : lerp(T(0.3), T(0.05), gloss);
  }
  /// Wider tails than GGX.
  static T coat_d(T cos_h, T alpha) {
    const T a2 = alpha * alpha;
    return (a2 - 1) / (pi_v<T> * std::log(a2) * (1 + (a2 - 1) * cos_h * cos_h));
  }
  std::array<T, 3> shares() const {
    const T sum = colour + specular + clearcoat / 4;
    return {colour / sum, specular / sum, clearcoat / 4 / sum};
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const auto share = shares();
    V3<T> wi{};
    if (u.x < share[0]) {
      wi = cosine_hemisphere(u.y, u.z);
    } else if (u.x < share[0] + share[1]) {
      wi = mirrored_at(wo, facets().visible(wo, u.y, u.z));
    } else {
      const T a2 = sqr(coat_alpha(false));
      const T cos_h = safe_sqrt((1 - std::pow(a2, 1 - u.y)) / (1 - a2));
      const V3<T> m = spherical(cos_h, 2 * pi_v<T> * u.z);
      if (!(dot(wo, m) > 0)) return std::nullopt;
      wi = mirrored_at(wo, m);
    }
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const auto share = shares();
    const V3<T> m = unit(wo + wi);
    const T coat = coat_d(m.z, coat_alpha(true)) * (fault == 1 ? T(1) : m.z);
    return share[0] * wi.z / pi_v<T> +
           (share[1] * facets().visible_density(wo, m) + share[2] * coat) / (4 * dot(wo, m));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    const T c = dot(wo, m), g = 4 * wo.z * wi.z;
    const TrowbridgeReitz<T> mask{T(0.25), T(0.25)};
    const T coat = clearcoat / 4 * schlick(T(0.04), c) * coat_d(m.z, coat_alpha(false));
    return colour / pi_v<T> +
           specular * schlick(T(0.2), c) * facets().d(m) * facets().g2(wo, wi) / g +
           coat * mask.g1(wo) * mask.g1(wi) / g;
  }
};

}  // namespace

void add_sealed_layers_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fourth paint under water/double", "pdf without 1/eta squared",
           said("pdf of what is refracted out lacks 1/eta^2 of the solid angles"),
           {CauseKind::eta_squared, CauseKind::constant}, UnderWater<double>{0.5, 1.4, on(1)},
           seen_from({10, 60}));
  twin<F3>(cases, "fourth paint under water/float", "f without 1/eta squared",
           said("f lacks the 1/eta^2 of radiance on its way out, the weight has it"),
           {CauseKind::eta_squared, CauseKind::value_constant},
           UnderWater<float>{0.4F, 1.33F, on(2)}, seen_from({10, 60}));
  twin<D3>(cases, "fourth candy paint/double", "lacquer on the way in alone",
           said("f has what the lacquer takes along wi, not what it takes along wo"),
           {CauseKind::asymmetric}, Candy<double>{on(1)}, seen_from({30, 70}));
  twin<D3>(cases, "fourth candy paint/double", "metal's alpha for the coat",
           said("pdf of the coat has the roughness of the metal below"), {CauseKind::roughness},
           Candy<double>{on(2)}, seen_from({20, 60}));
  twin<D3>(cases, "fourth polished stone/double", "mirror states F",
           said("B19: the mirror's record states F, it is chosen with F/(F + (1 - F) albedo)"),
           {CauseKind::atom_as_density, CauseKind::fresnel}, Stone<double>{0.4, on(1)},
           stone_options({20, 60}));
  twin<F3>(cases, "fourth polished stone/float", "number not divided",
           said("L6: the share is taken off the number of the body, the rest is not divided"),
           {CauseKind::numbers_reused}, Stone<float>{0.4F, on(2)}, stone_options({30, 75}));
  twin<D3>(cases, "fourth standard/double", "coat without cos h",
           said("pdf of the clear coat lacks the cosine of h"), {CauseKind::cosine},
           Standard<double>{on(1)}, seen_from({10, 60}));
  twin<D3>(cases, "fourth standard/double", "ends of the gloss exchanged in pdf",
           said("pdf has the ends of the gloss exchanged, alpha rises with it"),
           {CauseKind::roughness}, Standard<double>{on(2)}, seen_from({10, 60}));
}

}  // namespace plumbline::tests::corpus
