#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/reports/measured.h>
#include <plumbline/verify/detail/result.h>

namespace plumbline::reports {

/// One run on the axis of a history.
struct HistoryNight {
  std::uint64_t run = 0;     ///< its id in the database
  std::string time, commit;  ///< UTC; full hash
  bool dirty = false;
  std::string sources;  ///< hash of the code under test
  std::uint64_t checks = 0, unexpected = 0;
  std::uint64_t failed_parts = 0, skipped_parts = 0;
  std::uint64_t gate_runs = 0, failing_gate_runs = 0;  ///< with fresh seeds
  std::vector<HistoryPart> parts;                      ///< in the order in which they ran

  bool operator==(const HistoryNight&) const = default;
};

/// A change that was found in a number. Nights are places on the axis, from 0.
struct HistoryChange {
  bool drift = false;  ///< over several nights, not between two
  bool regression = false;
  std::uint64_t first_night = 0, last_night = 0;  ///< at the new level; of a step the same
  std::string commit_before;                      ///< the last one measured before
  std::string commit_first, commit_last;          ///< of these two nights
  double before = 0, after = 0;                   ///< typical values, in the number's unit
  double relative = 0, low = 0, high = 0;         ///< after/before − 1, with a 95 % interval
  double means_p_value = 0;                       ///< of the first detector
  double distribution_p_value = 0;                ///< of the second; both 0 for a counter

  bool operator==(const HistoryChange&) const = default;
};

/// A number over the nights. `median`, `low` and `high` are as long as the axis; NaN where a night
/// has not measured it.
struct TrackedNumber {
  std::string name, unit;
  bool counter = false;           ///< the same at every run of the same code
  bool lower_is_better = true;    ///< of a counter: always
  std::vector<double> median;     ///< of a night's repetitions
  std::vector<double> low, high;  ///< quartiles
  std::vector<HistoryChange> changes;
  std::vector<std::uint64_t> odd_nights;  ///< places of nights that were left out as outliers

  bool operator==(const TrackedNumber&) const = default;
};

/// A check over the nights. Of `bound` and `evidence` one is as long as the axis, with NaN where a
/// night adds nothing, to four digits; the other is empty.
///
/// What is bounded: of a mean its bias; of an agreement the difference; of a proportion, and of the
/// logarithm of a ratio, the distance from the middle of the claim, of which the tolerance is half
/// the width. A ratio that is claimed on one side alone has no tolerance, and half the width of its
/// interval is given.
struct TrackedSequence {
  verify::CheckKind check = verify::CheckKind::mean;
  std::string subject;
  verify::Verdict verdict = verify::Verdict::inconclusive;  ///< of all nights since it began
  std::uint64_t nights = 0;                                 ///< since it began, with the same code
  std::optional<double> tolerance;                          ///< of what is bounded
  std::vector<double> bound;     ///< what is bounded is proven to be below, after that night
  std::vector<double> evidence;  ///< of a test: ln of the evidence against, after that night
  std::string reason;            ///< why it failed

  bool operator==(const TrackedSequence&) const = default;
};

/// What the runs of one kind on one machine show together: all that a view of them needs. JSON
/// format "plumbline.history/1".
struct HistoryRecord {
  std::string machine;               ///< comparable_key
  std::string kind;                  ///< of the runs: "nightly"
  std::vector<HistoryNight> nights;  ///< the axis, the oldest first
  std::vector<TrackedNumber> numbers;
  std::vector<TrackedSequence> sequences;
  std::vector<SeedRun> failing_gate_runs;  ///< of all nights

  bool operator==(const HistoryRecord&) const = default;
};

/// @throws FormatError where a list of a number or sequence is not as long as the axis, or a place
///         is not on it
std::string to_json(const HistoryRecord& record);

/// Writes the record as a JSON file.
///
/// @throws FormatError, std::system_error where the file cannot be written
void write_history(const std::filesystem::path& path, const HistoryRecord& record);

/// @throws FormatError
HistoryRecord parse_history(std::string_view json);

}  // namespace plumbline::reports
