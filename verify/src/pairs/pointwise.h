#pragma once

#include <vector>

#include <plumbline/verify/pair.h>

#include "diagnosis/evidence.h"

namespace plumbline::verify {

struct PointwiseOutcome {
  CheckResult result;
  RatioSeries ratios;  ///< empty where the property is none of a ratio
};

/// One outcome per property that the pair can be held to.
std::vector<PointwiseOutcome> judge_pointwise(const SamplingPair& pair,
                                              const ContractOptions& options);

}  // namespace plumbline::verify
