#pragma once

#include <cstdint>
#include <optional>

#include <plumbline/renderer/core/math.h>

namespace plumbline::renderer {

/// One sampled direction of a BSDF: a point of a density, or an atom with probability mass. Exactly
/// one of `pdf_w` and `mass` is positive, so an atom that is taken for a density has none.
template <class T>
struct BsdfSample {
  Vec3<T> wi;     ///< unit, local frame, away from the surface
  Rgb<T> weight;  ///< f·|cosθi|/pdf_w, or the atom's albedo over its mass [1]; always finite
  T pdf_w{0};     ///< [1/sr], the same value as pdf(wo, wi); 0 for an atom
  T mass{0};      ///< [1] with which the atom was chosen; 0 for a density
  T radiance_scale{1};     ///< (η_o/η_i)² across a refraction, contained in `weight`; else 1
  std::uint32_t lobe = 0;  ///< which of the BSDF's lobes it came from

  bool is_atom() const { return mass > T(0); }
};

/// A sample of a density, written where the caller wants it: a record put together elsewhere and
/// copied is read in wider pieces than it was written in, which the processor waits for.
template <class T>
[[gnu::always_inline]] inline std::optional<BsdfSample<T>> density_sample(
    const Vec3<T>& wi, const Rgb<T>& weight, const T& pdf_w, const T& radiance_scale = T(1),
    std::uint32_t lobe = 0) {
  std::optional<BsdfSample<T>> result;
  BsdfSample<T>& sample = result.emplace();
  sample.wi = wi;
  sample.weight = weight;
  sample.pdf_w = pdf_w;
  sample.radiance_scale = radiance_scale;
  sample.lobe = lobe;
  return result;
}

/// An atom, in the same way.
template <class T>
[[gnu::always_inline]] inline std::optional<BsdfSample<T>> atom_sample(
    const Vec3<T>& wi, const Rgb<T>& weight, const T& mass, const T& radiance_scale = T(1),
    std::uint32_t lobe = 0) {
  auto result = density_sample(wi, weight, T(0), radiance_scale, lobe);
  result->mass = mass;
  return result;
}

/// A BSDF at a pair of directions. Both numbers lean on the same half vector, so asked together
/// they cost little more than one of them.
template <class T>
struct BsdfValue {
  Rgb<T> f;    ///< [1/sr], as `eval` gives it
  T pdf_w{0};  ///< [1/sr], as `pdf` gives it
};

/// eval and pdf of a BSDF together, by its own `evaluate` where it has one.
///
/// @param set  of a nested BSDF, what its children stand in; else nothing
template <class T, class B, class... Set>
BsdfValue<T> evaluate_bsdf(const Vec3<T>& wo, const Vec3<T>& wi, const B& bsdf, const Set&... set) {
  if constexpr (requires { bsdf.evaluate(set..., wo, wi); }) {
    return bsdf.evaluate(set..., wo, wi);
  } else {
    return {bsdf.eval(set..., wo, wi), bsdf.pdf(set..., wo, wi)};
  }
}

/// What a BSDF is made of, whatever the directions.
struct BsdfParts {
  bool density = false;       ///< eval and pdf are positive somewhere
  bool atoms = false;         ///< sample may return atoms
  bool transmission = false;  ///< light passes to the other side

  friend BsdfParts operator|(const BsdfParts& a, const BsdfParts& b) {
    return {a.density || b.density, a.atoms || b.atoms, a.transmission || b.transmission};
  }
  friend bool operator==(const BsdfParts&, const BsdfParts&) = default;
};

/// A record of one lobe, as seen from a BSDF that chooses this lobe with `probability` and gives it
/// `share` of its own light: the density is not touched, which is the caller's to sum over lobes.
template <class T>
BsdfSample<T> as_part(BsdfSample<T> lobe, const T& share, const T& probability) {
  lobe.weight = lobe.weight * T(share / probability);
  lobe.mass = lobe.mass * probability;
  return lobe;
}

/// A choice between two lobes, with the number that made it made uniform again.
template <class T>
struct TwoLobeChoice {
  std::uint32_t lobe;
  T u;  ///< in [0, 1), independent of the choice
};

/// @param u            in [0, 1)
/// @param probability  of lobe 0, in [0, 1]
template <class T>
TwoLobeChoice<T> choose_lobe(const T& u, const T& probability) {
  const T one_minus_ulp = T(1) - std::numeric_limits<T>::epsilon() / T(2);
  if (u < probability) return {0, std::min(T(u / probability), one_minus_ulp)};
  return {1, std::min(T((u - probability) / (T(1) - probability)), one_minus_ulp)};
}

}  // namespace plumbline::renderer
