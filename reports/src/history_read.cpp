#include <plumbline/reports/history.h>

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include "history_schema.h"
#include "record_fields.h"

namespace plumbline::reports {
namespace {

using SQLite::Statement;

std::optional<double> optional_number(const SQLite::Column& column) {
  return column.isNull() ? std::nullopt : std::optional(column.getDouble());
}

std::vector<double> numbers(const std::string& json) {
  std::vector<double> values;
  const detail::Json list = detail::Json::parse(json);
  for (const detail::Json& value : list.elements()) {
    values.push_back(detail::double_from_json(value));
  }
  return values;
}

verify::Verdict verdict_of(std::string_view word) {
  for (const auto& [verdict, candidate] : detail::EnumWords<verify::Verdict>::kWords) {
    if (word == candidate) return verdict;
  }
  throw FormatError("the verdict \"" + std::string(word) + "\"");
}

std::uint64_t seed_of(const std::string& text) {
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, seed);
  if (!text.empty() && parsed.ec == std::errc() && parsed.ptr == end) return seed;
  throw FormatError("the seed \"" + text + "\"");
}

constexpr const char* kCheckColumns =
    "SELECT kind, name, verdict, expected, waived, estimate, reference, tolerance, bound, p_value, "
    "samples, seconds, figures, record FROM check_result JOIN subject ON subject.id = subject "
    "WHERE run = ?";

verify::CheckResult read_check(const Statement& row) {
  if (!row.isColumnNull(13)) return parse_check(row.getColumn(13).getString());
  verify::CheckResult check;
  check.kind = verify::check_kind(row.getColumn(0).getString()).value_or(check.kind);
  check.subject = row.getColumn(1).getString();
  check.verdict = verdict_of(row.getColumn(2).getString());
  check.expected = verdict_of(row.getColumn(3).getString());
  if (row.getColumn(4).getInt() != 0) check.waived = "yes";
  check.estimate = optional_number(row.getColumn(5));
  check.reference = optional_number(row.getColumn(6));
  check.tolerance = optional_number(row.getColumn(7));
  check.bound = optional_number(row.getColumn(8));
  check.p_value = optional_number(row.getColumn(9));
  check.samples = static_cast<std::uint64_t>(row.getColumn(10).getInt64());
  check.seconds = row.getColumn(11).getDouble();
  if (!row.isColumnNull(12)) {
    const detail::Json figures = detail::Json::parse(row.getColumn(12).getString());
    detail::FieldReader reader(figures);
    detail::visit_figures(reader, check.figures);
  }
  return check;
}

/// What `read` makes of each row of a query whose one parameter is a run.
template <class Read>
auto rows_of_run(const SQLite::Database& database, const std::string& query, std::int64_t id,
                 const Read& read) {
  Statement rows(database, query);
  rows.bind(1, id);
  std::vector<decltype(read(rows))> found;
  while (rows.executeStep()) found.push_back(read(rows));
  return found;
}

/// With the run as a parameter, which may be any.
std::vector<verify::CheckResult> read_checks(const SQLite::Database& database, std::int64_t id,
                                             const char* condition) {
  return rows_of_run(database,
                     std::string(kCheckColumns) + condition + " ORDER BY check_result.rowid", id,
                     read_check);
}

void read_parts(const SQLite::Database& database, HistoryRun& run) {
  run.parts = rows_of_run(
      database, "SELECT name, status, seconds, note FROM part WHERE run = ? ORDER BY rowid", run.id,
      [](const Statement& row) {
        const auto status = part_status(row.getColumn(1).getString());
        return HistoryPart{row.getColumn(0).getString(), status.value_or(PartStatus::failed),
                           row.getColumn(2).getDouble(), row.getColumn(3).getString()};
      });
  run.seed_runs = rows_of_run(
      database, "SELECT record FROM seed_run WHERE run = ? ORDER BY rowid", run.id,
      [](const Statement& row) { return parse_seed_run(row.getColumn(0).getString()); });
}

constexpr const char* kRunColumns = "SELECT id, kind, sources, seed, environment FROM run";

HistoryRun read_run(const SQLite::Database& database, const Statement& row) {
  HistoryRun run;
  run.id = row.getColumn(0).getInt64();
  run.kind = row.getColumn(1).getString();
  run.sources = row.getColumn(2).getString();
  run.seed = seed_of(row.getColumn(3).getString());
  run.environment = parse_environment(row.getColumn(4).getString());
  read_parts(database, run);
  return run;
}

/// What a filter lets through, for a query that joins `run`.
constexpr const char* kFiltered =
    "(:kind IS NULL OR run.kind = :kind) AND (:comparable IS NULL OR run.comparable = :comparable)";

void bind_filter(Statement& statement, const RunFilter& filter) {
  if (filter.kind) statement.bind(":kind", *filter.kind);
  if (filter.comparable) statement.bind(":comparable", *filter.comparable);
}

/// Rows of quantities: those of one name follow each other, in the order of the runs.
template <class Series, class Value>
std::vector<Series> read_series(const SQLite::Database& database, const std::string& value_of,
                                const RunFilter& filter, const Value& value) {
  Statement rows(database, "SELECT quantity.id, name, unit, better, run.id, " + value_of +
                               " JOIN quantity ON quantity.id = quantity JOIN run ON run.id = run "
                               "WHERE " +
                               kFiltered + " ORDER BY name, quantity.id, run.id");
  bind_filter(rows, filter);
  std::vector<Series> all;
  std::optional<std::int64_t> last;
  while (rows.executeStep()) {
    const std::int64_t quantity = rows.getColumn(0).getInt64();
    if (std::exchange(last, quantity) != quantity) {
      Series series;
      series.name = rows.getColumn(1).getString();
      series.unit = rows.getColumn(2).getString();
      if constexpr (requires { series.lower_is_better; }) {
        series.lower_is_better = rows.getColumn(3).getString() == "lower";
      }
      all.push_back(std::move(series));
    }
    all.back().runs.push_back({rows.getColumn(4).getInt64(), value(rows.getColumn(5))});
  }
  return all;
}

}  // namespace

std::vector<HistoryRun> History::runs(const RunFilter& filter) const {
  std::vector<HistoryRun> found;
  detail::ask(file_, [&] {
    Statement rows(*database_, std::string(kRunColumns) + " WHERE " + kFiltered + " ORDER BY id");
    bind_filter(rows, filter);
    while (rows.executeStep()) found.push_back(read_run(*database_, rows));
  });
  return found;
}

HistoryRun History::run(std::int64_t id) const {
  HistoryRun found;
  detail::ask(file_, [&] {
    Statement row(*database_, std::string(kRunColumns) + " WHERE id = ?");
    row.bind(1, id);
    if (!row.executeStep()) {
      throw HistoryError(file_.string() + ": there is no run " + std::to_string(id));
    }
    found = read_run(*database_, row);
  });
  return found;
}

CheckCounts History::count_checks(std::int64_t id) const {
  CheckCounts counts;
  detail::ask(file_, [&] {
    Statement row(*database_, "SELECT count(*), count(record) FROM check_result WHERE run = ?");
    row.bind(1, id);
    if (!row.executeStep()) return;
    counts.checks = static_cast<std::uint64_t>(row.getColumn(0).getInt64());
    counts.unexpected = static_cast<std::uint64_t>(row.getColumn(1).getInt64());
  });
  return counts;
}

std::vector<verify::CheckResult> History::checks(std::int64_t id) const {
  std::vector<verify::CheckResult> found;
  detail::ask(file_, [&] { found = read_checks(*database_, id, ""); });
  return found;
}

std::vector<verify::CheckResult> History::unexpected_checks(std::int64_t id) const {
  std::vector<verify::CheckResult> found;
  detail::ask(file_, [&] { found = read_checks(*database_, id, " AND record IS NOT NULL"); });
  return found;
}

std::vector<Distribution> History::distributions(std::int64_t id) const {
  std::vector<Distribution> found;
  detail::ask(file_, [&] {
    found = rows_of_run(*database_,
                        "SELECT name, unit, better, measured FROM distribution JOIN quantity ON "
                        "quantity.id = quantity WHERE run = ? ORDER BY distribution.rowid",
                        id, [](const Statement& row) {
                          return Distribution{row.getColumn(0).getString(),
                                              row.getColumn(1).getString(),
                                              row.getColumn(2).getString() == "lower",
                                              numbers(row.getColumn(3).getString())};
                        });
  });
  return found;
}

std::vector<Counter> History::counters(std::int64_t id) const {
  std::vector<Counter> found;
  detail::ask(file_, [&] {
    found = rows_of_run(*database_,
                        "SELECT name, unit, value FROM counter JOIN quantity ON quantity.id = "
                        "quantity WHERE run = ? ORDER BY counter.rowid",
                        id, [](const Statement& row) {
                          return Counter{row.getColumn(0).getString(), row.getColumn(1).getString(),
                                         static_cast<std::uint64_t>(row.getColumn(2).getInt64())};
                        });
  });
  return found;
}

std::vector<DistributionSeries> History::distribution_series(const RunFilter& filter) const {
  std::vector<DistributionSeries> found;
  detail::ask(file_, [&] {
    found = read_series<DistributionSeries>(
        *database_, "measured FROM distribution", filter,
        [](const SQLite::Column& column) { return numbers(column.getString()); });
  });
  return found;
}

std::vector<CounterSeries> History::counter_series(const RunFilter& filter) const {
  std::vector<CounterSeries> found;
  detail::ask(file_, [&] {
    found = read_series<CounterSeries>(
        *database_, "value FROM counter", filter,
        [](const SQLite::Column& column) { return static_cast<std::uint64_t>(column.getInt64()); });
  });
  return found;
}

}  // namespace plumbline::reports
