#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/reports/environment.h>
#include <plumbline/reports/errors.h>
#include <plumbline/reports/measured.h>
#include <plumbline/reports/results.h>
#include <plumbline/verify/detail/result.h>

namespace SQLite {  // NOLINT(readability-identifier-naming)
class Database;
}  // namespace SQLite

namespace plumbline::reports {

/// What every run has, without its measurements.
struct HistoryRun {
  std::int64_t id = 0;     ///< given by the history, growing in the order in which runs arrived
  std::string kind;        ///< "nightly" or "test"
  std::uint64_t seed = 0;  ///< of its checks
  std::string sources;     ///< hash of the sources of the code under test
  RunEnvironment environment;
  std::vector<HistoryPart> parts;
  std::vector<SeedRun> seed_runs;

  bool operator==(const HistoryRun&) const = default;
};

/// What a run measured. Of the checks the numbers are kept; figures too where statistics go on from
/// them (mean, agreement, variance_ratio, proportion), and the whole record of one that did not
/// give its expected verdict.
struct HistoryData {
  std::vector<verify::CheckResult> checks;
  std::vector<Distribution> distributions;
  std::vector<Counter> counters;
};

/// How many checks of a run there were.
struct CheckCounts {
  std::uint64_t checks = 0, unexpected = 0;
};

/// Which runs: all, where nothing is said.
struct RunFilter {
  std::optional<std::string> kind;
  std::optional<std::string> comparable;  ///< the key of the runs' environments
};

/// One distribution over the runs that have it.
struct DistributionSeries {
  std::string name, unit;
  bool lower_is_better = true;
  struct Run {
    std::int64_t id = 0;
    std::vector<double> values;
  };
  std::vector<Run> runs;  ///< in the order of the runs
};

/// One deterministic counter over the runs that have it.
struct CounterSeries {
  std::string name, unit;
  struct Run {
    std::int64_t id = 0;
    std::uint64_t value = 0;
  };
  std::vector<Run> runs;  ///< in the order of the runs
};

/// What two runs must have in common for their numbers to be compared: processor, cores, compiler
/// and flags, as one line of text.
std::string comparable_key(const RunEnvironment& environment);

/// The runs of a tree, night by night, in one SQLite file (docs/nights.md).
///
/// Any number of processes may append and read at once: each run is one transaction, and one that
/// is killed in the middle of it leaves nothing of it. A file of an earlier version is brought up
/// to date as it is opened.
class History {
 public:
  static constexpr int kVersion = 1;  ///< of the schema: SQLite's user_version

  enum class Access {
    read,   ///< the file must be there
    append  ///< it is made where it is missing, its directory too
  };

  /// @throws HistoryError where the file is missing, is no database, is another program's, or was
  ///         written by a later version; std::system_error where the disk fails
  History(const std::filesystem::path& file, Access access);
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// Adds a run, wholly or not at all. `run.id` is not looked at.
  ///
  /// @return its id
  /// @throws HistoryError, std::system_error as the constructor does
  std::int64_t append(const HistoryRun& run, const HistoryData& data);

  /// In the order of their ids.
  std::vector<HistoryRun> runs(const RunFilter& filter = {}) const;

  /// @throws HistoryError where there is no such run
  HistoryRun run(std::int64_t id) const;
  CheckCounts count_checks(std::int64_t id) const;

  /// In the order in which they were appended; empty where there is no such run.
  std::vector<verify::CheckResult> checks(std::int64_t id) const;
  std::vector<verify::CheckResult> unexpected_checks(std::int64_t id) const;
  std::vector<Distribution> distributions(std::int64_t id) const;
  std::vector<Counter> counters(std::int64_t id) const;

  /// Of the runs that the filter lets through, sorted by name.
  std::vector<DistributionSeries> distribution_series(const RunFilter& filter) const;
  std::vector<CounterSeries> counter_series(const RunFilter& filter) const;

 private:
  std::filesystem::path file_;
  std::unique_ptr<SQLite::Database> database_;
};

}  // namespace plumbline::reports
