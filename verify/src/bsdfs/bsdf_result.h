#pragma once

#include <string>

#include <plumbline/verify/bsdf.h>

namespace plumbline::verify {

/// The empty result of a check of a BSDF.
inline CheckResult bsdf_result(CheckKind kind, const std::string& name,
                               const ContractOptions& options) {
  CheckResult r;
  r.kind = kind;
  r.subject = name + "/" + std::string(to_string(kind));
  r.seed = options.seed;
  return r;
}

/// η² of the medium that a direction points into.
inline double eta_squared(const Vec3& w, double eta) { return w[2] < 0 ? eta * eta : 1; }

/// What f(wo, wi)·|cosθi| is multiplied by to become the share of the power.
inline double power_factor(const ErasedBsdf& bsdf, const Vec3& wo, const Vec3& wi, double eta) {
  return bsdf.without_eta_squared ? 1 : eta_squared(wi, eta) / eta_squared(wo, eta);
}

/// What f(wo, wi) is divided by to be the same both ways. f without η² is η_i²/η_o² times the
/// other.
inline double reciprocity_divisor(const ErasedBsdf& bsdf, const Vec3& wo, const Vec3& wi,
                                  double eta) {
  return eta_squared(bsdf.without_eta_squared ? wi : wo, eta);
}

/// Samples that show which atoms there are.
inline constexpr int kAtomProbes = 1'000;

}  // namespace plumbline::verify
