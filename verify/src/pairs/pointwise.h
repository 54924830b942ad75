#pragma once

#include <vector>

#include <plumbline/verify/pair.h>

#include "diagnosis/diagnosis.h"

namespace plumbline::verify {

struct PointwiseOutcome {
  CheckResult result;
  RatioEvidence evidence;
};

/// One outcome per property that the pair can be held to.
std::vector<PointwiseOutcome> judge_pointwise(const SamplingPair& pair,
                                              const ContractOptions& options);

}  // namespace plumbline::verify
