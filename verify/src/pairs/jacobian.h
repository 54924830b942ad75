#pragma once

#include <plumbline/verify/pair.h>

#include "diagnosis/diagnosis.h"

namespace plumbline::verify {

/// The result of the Jacobian check with the ratio of true to stated density at its points.
struct JacobianOutcome {
  CheckResult result;
  RatioEvidence evidence;
};

JacobianOutcome judge_jacobian(const SamplingPair& pair, const ContractOptions& options);

}  // namespace plumbline::verify
