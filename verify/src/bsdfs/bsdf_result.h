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

/// Samples that show which atoms there are.
inline constexpr int kAtomProbes = 1'000;

}  // namespace plumbline::verify
