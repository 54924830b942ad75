#pragma once

#include <vector>

#include <plumbline/verify/pair.h>

#include "diagnosis/evidence.h"

namespace plumbline::verify {

/// The result of the Jacobian check with the ratio of true to stated density at its points: of the
/// whole, and of each lobe.
struct JacobianOutcome {
  CheckResult result;
  /// All that fails is less dense than the pdf: one branch of several?
  bool below_everywhere = false;
  std::vector<RatioSeries> ratios;
};

JacobianOutcome judge_jacobian(const SamplingPair& pair, const ContractOptions& options);

}  // namespace plumbline::verify
