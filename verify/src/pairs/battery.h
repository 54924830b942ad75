#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/verify/pair.h>

#include "diagnosis/diagnosis.h"
#include "diagnosis/evidence.h"
#include "pairs/binned_pair.h"
#include "pairs/jacobian.h"
#include "progress.h"

namespace plumbline::verify {

/// Results of check_pair without their cause, and what the checks saw.
struct PairOutcome {
  std::vector<CheckResult> results;
  ViewEvidence view;     ///< points to the pair
  bool nothing = false;  ///< every sample was rejected: whatever passed looked at nothing
  bool atoms = false;    ///< some are known, or were sampled
};

/// check_pair part by part, so that what is known soon of many pairs can come first; without the
/// result that stands for `nothing`: black from one direction may be right.
class PairBattery {
 public:
  /// @param pair, options, progress  kept by the caller
  PairBattery(const SamplingPair& pair, const ContractOptions& options, Progress& progress);

  /// Pointwise, Jacobian, inverse: no statistics, a fiftieth of the time, and most faults show.
  void judge_points();

  /// Integral and chi-square. After the points.
  void judge_samples();

  /// Some are known, or were sampled.
  bool has_atoms() const { return !binned_->counts().atoms.empty(); }

  /// What was found, but for the bins of the evidence. Once, at the end.
  PairOutcome outcome();

  /// What only the diagnosis of a failure looks at, and asks the pdf thousands of times.
  std::vector<BinSeen> bins_seen() const;

 private:
  const SamplingPair& pair_;
  const ContractOptions& options_;
  Progress& progress_;
  PairOutcome outcome_;
  JacobianOutcome jacobian_;
  std::size_t jacobian_at_ = 0;  // of the results
  std::optional<BinnedPair> binned_;
};

/// Inconclusive: nothing is wrong with black, and every check of it passes, but more often than not
/// something else is meant.
CheckResult nothing_sampled(const std::string& name, const ContractOptions& options,
                            const std::string& reason, const std::string& advice);

/// The report and all its failing results get the cause: they share one.
void name_cause(const Cause& cause, Report& report);

}  // namespace plumbline::verify
