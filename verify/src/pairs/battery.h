#pragma once

#include <string>
#include <vector>

#include <plumbline/verify/pair.h>

#include "diagnosis/diagnosis.h"
#include "diagnosis/evidence.h"

namespace plumbline::verify {

/// Results of check_pair without their cause, and what the checks saw.
struct PairOutcome {
  std::vector<CheckResult> results;
  ViewEvidence view;     ///< points to the pair
  bool nothing = false;  ///< every sample was rejected: whatever passed looked at nothing
  bool atoms = false;    ///< some are known, or were sampled
};

/// check_pair, without the result that stands for `nothing`: black from one direction may be right.
PairOutcome judge_pair(const SamplingPair& pair, const ContractOptions& options);

/// Inconclusive: nothing is wrong with black, and every check of it passes, but more often than not
/// something else is meant.
///
CheckResult nothing_sampled(const std::string& name, const ContractOptions& options,
                            const std::string& reason, const std::string& advice);

/// The report and all its failing results get the cause: they share one.
void name_cause(const Cause& cause, Report& report);

}  // namespace plumbline::verify
