#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline::reports {

/// Times of two revisions that ran the same work side by side (`./run compare-runs`). JSON format
/// "plumbline.duet/1".
struct DuetRecord {
  std::string part;                    ///< "bsdf-sample/ggx_conductor"
  std::string revision_a, revision_b;  ///< full hashes; with a plus, a tree that differed from it
  bool identical_code = false;         ///< both are the same program, byte for byte

  double confidence = 0;  ///< of the interval, two-sided; corrected for all parts of the run
  double ratio = 1;       ///< time of b over that of a
  double low = 1, high = 1;

  /// Processor time [s] of each side in each slice, in the order in which they ran: equally long,
  /// and empty where only counters were compared.
  std::vector<double> a_seconds, b_seconds;

  /// Per unit of work: "rays", "samples", "bytes", "heap_bytes", "heap_blocks", "instructions", and
  /// "result", a hash of what was computed.
  std::map<std::string, std::uint64_t> counters_a, counters_b;

  bool operator==(const DuetRecord&) const = default;
};

/// Times that differ by less than this say nothing: where code comes to lie changes with sources
/// that are not part of it.
inline constexpr double kDuetMargin = 0.01;

/// "slower" or "faster" where the whole interval lies beyond the margin, "no change" where it lies
/// within it, else "undecided"; "identical code" and "not timed" where there are no times.
std::string_view verdict(const DuetRecord& record);

/// @throws FormatError where the sides have not as many times
std::string to_json(const DuetRecord& record);

/// @throws FormatError
DuetRecord parse_duet_record(std::string_view json);

}  // namespace plumbline::reports
