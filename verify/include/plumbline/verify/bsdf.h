#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/verify/detail/erase_bsdf.h>
#include <plumbline/verify/detail/report.h>
#include <plumbline/verify/pair.h>

namespace plumbline::verify {

/// Something of a BSDF that a wrong pdf may have lost or gained, for the diagnosis: G1, a Fresnel
/// term.
struct BsdfSuspect {
  std::string name;
  std::function<double(const Vec3& wo, const Vec3& wi)> value;
};

/// What a BSDF is held to, and how its author writes things down.
struct BsdfOptions {
  BsdfConventions conventions;
  ContractOptions contract;

  // Directions. Each angle from the normal is looked at from both faces, at a random azimuth.
  std::vector<double> angles = {0, 60, 80, 88, 89.9};  ///< degrees
  int random_directions = 1;                           ///< more per face, uniform on the hemisphere
  bool front = true, back = true;

  /// Refractive index below the surface over that above. Radiance BSDFs hold its square across a
  /// refraction, which reciprocity and energy take out again.
  double eta = 1;

  bool reciprocal = true;          ///< f(wo, wi)/η_o² = f(wi, wo)/η_i²
  bool conserves_energy = true;    ///< albedo ≤ 1 for every wo and channel
  double energy_tolerance = 1e-3;  ///< of the albedo: what the cubature is asked for

  /// Known directional albedo of one channel, atoms included; empty if unknown.
  std::function<double(const Vec3& wo)> albedo;
  std::size_t albedo_channel = 0;  ///< the channel that `albedo` is of

  std::vector<BsdfSuspect> suspects;
};

/// The whole battery on a BSDF: check_pair for each direction, and reciprocity, energy and atoms.
/// All directions are in the local frame, z the normal, pointing away from the surface.
///
/// Results are named name/face angle/check. A BSDF that gives no sample from any direction stays
/// inconclusive: most likely a convention is not stated.
Report check_bsdf(const std::string& name, const ErasedBsdf& bsdf, const BsdfOptions& options = {});

/// The same on an object of any type that has `sample`, `pdf` and `eval`; see erase_bsdf.h for what
/// is understood.
///
/// @tparam Direction  its vector type; may be left out where `pdf` is neither a template nor
///                    overloaded
/// @tparam Numbers    type of the random numbers that `sample` takes, where it cannot be found out
template <class Direction = void, class Numbers = void, class B>
Report check_bsdf(const std::string& name, const B& bsdf, const BsdfOptions& options = {}) {
  return check_bsdf(name, erase_bsdf<Direction, Numbers>(bsdf, options.conventions), options);
}

/// A BSDF seen from one direction, as a sampling pair over the sphere.
SamplingPair bsdf_pair(const std::string& name, const ErasedBsdf& bsdf, const Vec3& wo,
                       const BsdfOptions& options = {});

/// f(wo, wi)/η_o² = f(wi, wo)/η_i² at sampled and random pairs of directions.
CheckResult check_reciprocity(const std::string& name, const ErasedBsdf& bsdf,
                              const BsdfOptions& options = {});

/// Directional albedo ∫f·|cosθ| + atoms by cubature: at most 1, and the known one where that is
/// given.
CheckResult check_energy(const std::string& name, const ErasedBsdf& bsdf, const Vec3& wo,
                         const BsdfOptions& options = {});

/// Atoms lie in the mirror direction, or in the refracted one by Snell's law. Left out of
/// `check_bsdf` where there are none.
CheckResult check_atoms(const std::string& name, const ErasedBsdf& bsdf, const Vec3& wo,
                        const BsdfOptions& options = {});

}  // namespace plumbline::verify
