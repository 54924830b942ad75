#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline::reports {

/// All repetitions of one measurement, for comparison with those of other nights. JSON format
/// "plumbline.distribution/1".
struct Distribution {
  std::string name;             ///< the same every night: "bsdf_cost/lambertian/sample"
  std::string unit;             ///< of the values: "ns"
  bool lower_is_better = true;  ///< written as "better": "lower" or "higher"
  std::vector<double> values;   ///< in the order in which they were measured

  bool operator==(const Distribution&) const = default;
};

/// A number that is the same at every run of the same code with the same seeds. JSON format
/// "plumbline.counter/1".
struct Counter {
  std::string name;  ///< "speed/veach/mis/power/sobol/64 spp/rays"
  std::string unit;  ///< what is counted: "rays"
  std::uint64_t value = 0;

  bool operator==(const Counter&) const = default;
};

/// One run of the gate, or of a part of it, with a seed that nobody chose. JSON format
/// "plumbline.seed_run/1".
struct SeedRun {
  std::uint64_t seed = 0;
  std::string commit;                 ///< shortened, with "-dirty" where the tree differed
  std::string time;                   ///< UTC, "2024-03-01T12:00:00Z"
  std::uint64_t tests = 0;            ///< how many ran
  std::vector<std::string> failures;  ///< names of the tests that failed

  bool operator==(const SeedRun&) const = default;
};

enum class PartStatus { passed, failed, timed_out, skipped };

/// "passed", "failed", "timed out" or "skipped".
std::string_view to_string(PartStatus status);

/// The status that a word stands for; nullopt if none.
std::optional<PartStatus> part_status(std::string_view word);

/// One part of a night: "mutants".
struct HistoryPart {
  std::string name;
  PartStatus status = PartStatus::passed;
  double seconds = 0;  ///< wall clock
  std::string note;    ///< why it was skipped or failed; may be empty

  bool operator==(const HistoryPart&) const = default;
};

/// @throws FormatError where a distribution or counter has no name, or a distribution no values
std::string to_json(const Distribution& distribution);
std::string to_json(const Counter& counter);
std::string to_json(const SeedRun& run);

/// @throws FormatError
Distribution parse_distribution(std::string_view json);
/// @throws FormatError
Counter parse_counter(std::string_view json);
/// @throws FormatError
SeedRun parse_seed_run(std::string_view json);

}  // namespace plumbline::reports
