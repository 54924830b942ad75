#pragma once

#include <cstddef>
#include <vector>

#include <plumbline/reports/history.h>
#include <plumbline/reports/history_record.h>
#include <plumbline/verify/detail/result.h>
#include <plumbline/verify/history/confidence_sequence.h>

namespace plumbline::reports::detail {

/// What a mean check's record says of its samples, as batches of a fixed size. Figures that are
/// missing leave it empty.
///
/// @param samples_per_batch  ≥ 1
verify::history::BatchMoments batches_of(const verify::CheckResult& check,
                                         std::uint64_t samples_per_batch);

/// The sequences of all checks of the runs, by kind and subject. `runs` are the axis.
std::vector<TrackedSequence> follow_checks(const History& history,
                                           const std::vector<HistoryRun>& runs);

}  // namespace plumbline::reports::detail
