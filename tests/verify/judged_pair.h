#pragma once

#include "pairs/battery.h"

namespace plumbline::verify {

/// All of a pair's battery, with the bins that a diagnosis looks at.
inline PairOutcome judge_pair(const SamplingPair& pair, const ContractOptions& options) {
  Progress progress(pair.name, options);
  PairBattery battery(pair, options, progress);
  battery.judge_points();
  battery.judge_samples();
  PairOutcome outcome = battery.outcome();
  outcome.view.bins = battery.bins_seen();
  return outcome;
}

}  // namespace plumbline::verify
