#pragma once

#include <cstdint>

#include <plumbline/renderer/math.h>

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

/// A BSDF at a pair of directions. Both numbers lean on the same half vector, so asked together
/// they cost little more than one of them.
template <class T>
struct BsdfValue {
  Rgb<T> f;    ///< [1/sr], as `eval` gives it
  T pdf_w{0};  ///< [1/sr], as `pdf` gives it
};

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
