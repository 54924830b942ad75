#pragma once

#include <vector>

#include <plumbline/verify/pair.h>

#include "diagnosis/diagnosis.h"
#include "diagnosis/evidence.h"

namespace plumbline::verify {

/// Results of check_pair without their cause, and what the checks saw.
struct PairOutcome {
  std::vector<CheckResult> results;
  ViewEvidence view;  ///< points to the pair
};

PairOutcome judge_pair(const SamplingPair& pair, const ContractOptions& options);

/// All failing results get the cause: they share one.
void name_cause(const Cause& cause, std::vector<CheckResult>& results);

}  // namespace plumbline::verify
