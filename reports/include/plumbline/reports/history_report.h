#pragma once

#include <string>

#include <plumbline/reports/history.h>
#include <plumbline/reports/history_record.h>

namespace plumbline::reports {

/// Judges all runs of one kind on one machine together: changes of every tracked number, and the
/// sequences of every mean, agreement, ratio of variances, proportion and chi-square check, as
/// docs/statistics.md says, "Over nights".
///
/// Sequences take runs of kind "nightly" alone, each seed once, and checks that are expected to
/// pass and were not waived; they begin again where the hash of the code under test, the reference
/// or the tolerance is another. A night adds to a mean what its record says of it: as many batches
/// of equally many samples as it drew, with the mean, variance and skewness that it found; an
/// agreement is a mean difference, but for one that is the worst of several. A night in which one
/// batch carries a variance adds nothing to a ratio.
///
/// @param machine  the runs' comparable_key
/// @throws HistoryError, std::system_error as History does
HistoryRecord judge_runs(const History& history, const std::string& machine,
                         const std::string& kind);

}  // namespace plumbline::reports
