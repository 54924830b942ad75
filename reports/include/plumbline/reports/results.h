#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/reports/bench_record.h>
#include <plumbline/reports/budgets.h>
#include <plumbline/reports/causes_record.h>
#include <plumbline/reports/duet_record.h>
#include <plumbline/reports/environment.h>
#include <plumbline/reports/errors.h>
#include <plumbline/reports/figure.h>
#include <plumbline/reports/history_record.h>
#include <plumbline/reports/measured.h>
#include <plumbline/reports/render_record.h>
#include <plumbline/reports/stability_record.h>
#include <plumbline/reports/table.h>
#include <plumbline/verify/detail/result.h>

namespace plumbline::reports {

/// One check as a line of JSON, format "plumbline.check/1". NaN becomes null, ±∞ "inf" and "-inf";
/// text that is not UTF-8 gets replacement characters.
std::string to_json(const verify::CheckResult& result);

/// @throws FormatError
verify::CheckResult parse_check(std::string_view json);

/// Appends records to `directory/name.jsonl`, one JSON document per line. Each line is one write(2)
/// to a file opened with O_APPEND: concurrent processes do not tear each other's lines.
class ResultLog {
 public:
  /// Makes the directory if it is missing. Who creates the file notes the environment in it.
  ///
  /// @throws std::system_error where that is impossible
  ResultLog(const std::filesystem::path& directory, std::string_view name);
  ~ResultLog();
  ResultLog(const ResultLog&) = delete;
  ResultLog& operator=(const ResultLog&) = delete;

  /// @throws std::system_error where the line could not be written whole
  void append(const verify::CheckResult& result) { append_line(to_json(result)); }
  void append(const SpeedPoint& point) { append_line(to_json(point)); }
  void append(const RayCost& cost) { append_line(to_json(cost)); }
  void append(const Bar& bar) { append_line(to_json(bar)); }
  void append(const StabilityRecord& record) { append_line(to_json(record)); }
  void append(const CausesRecord& record) { append_line(to_json(record)); }
  void append(const DuetRecord& record) { append_line(to_json(record)); }
  void append(const Figure& figure) { append_line(to_json(figure)); }
  void append(const Table& table) { append_line(to_json(table)); }
  void append(const Distribution& distribution) { append_line(to_json(distribution)); }
  void append(const Counter& counter) { append_line(to_json(counter)); }
  void append(const RunEnvironment& environment) { append_line(to_json(environment)); }

 private:
  void append_line(std::string line);

  std::filesystem::path path_;
  int file_ = -1;
};

/// Writes a file of records with the environment that they were made in: what ResultLog makes, in
/// the place of what was there.
///
/// @throws std::system_error where it cannot be written
void write_checks(const std::filesystem::path& path,
                  const std::vector<verify::CheckResult>& results);

/// A place in a results directory that could not be read.
struct ReadWarning {
  std::filesystem::path file;
  std::size_t line = 0;  ///< from 1; 0 where the whole file is meant
  std::string what;
};

/// Everything found in a results directory, in the order of file names and lines.
struct Results {
  std::vector<verify::CheckResult> checks;
  std::vector<RenderRecord> renders;
  std::vector<SpeedPoint> speed;
  std::vector<RayCost> ray_costs;
  std::vector<Bar> bars;
  std::vector<StabilityRecord> stability;
  std::vector<CausesRecord> causes;
  std::vector<DuetRecord> duets;
  std::vector<Figure> figures;
  std::vector<Table> tables;
  std::vector<Distribution> distributions;
  std::vector<Counter> counters;
  std::vector<SeedRun> seed_runs;
  std::vector<HistoryRecord> histories;
  std::vector<RunEnvironment> environments;  ///< one per build and machine, the latest of each
  std::vector<ReadWarning> warnings;
  std::vector<std::filesystem::path> files;  ///< that may hold records: all that was read
};

/// Reads every `*.jsonl` line and every `*.json` document below the directory that states a
/// Plumbline format. A line that is torn or of an unknown version becomes a warning, never a silent
/// loss; `*.json` files of others (without a `format`) are passed over.
///
/// @param most_records  in all files together
/// @throws ResultsError where the directory is missing, is not one, holds no record at all, or one
///         that asks for more than budgets.h has for it ("file:line: what and what to do")
Results read_results(const std::filesystem::path& directory,
                     std::size_t most_records = kMaxRecords);

/// How many checks there are of each kind.
struct Summary {
  std::size_t passed = 0;              ///< as expected: a bound or an agreement is proven
  std::size_t failed_as_expected = 0;  ///< negative controls that were caught
  std::size_t inconclusive_as_expected = 0;
  std::size_t waived = 0;  ///< known failures
  std::size_t unexpected = 0;
  std::size_t unreadable = 0;  ///< warnings: records that may have held anything

  std::size_t checks() const {
    return passed + failed_as_expected + inconclusive_as_expected + waived + unexpected;
  }
  /// There are checks, all gave their expected verdict, and nothing was lost.
  bool good() const { return checks() > 0 && unexpected == 0 && unreadable == 0; }
};

Summary summarise(const Results& results);

}  // namespace plumbline::reports
