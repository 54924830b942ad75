#include <plumbline/reports/history.h>

#include <array>
#include <optional>
#include <utility>

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>

#include "history_schema.h"
#include "record_fields.h"

namespace plumbline::reports {
namespace {

using detail::Json;
using SQLite::Statement;

constexpr std::array<std::pair<PartStatus, std::string_view>, 4> kStatuses{
    {{PartStatus::passed, "passed"},
     {PartStatus::failed, "failed"},
     {PartStatus::timed_out, "timed out"},
     {PartStatus::skipped, "skipped"}}};

void bind_or_null(Statement& statement, int place, const std::optional<double>& value) {
  value ? statement.bind(place, *value) : statement.bind(place);
}

void bind_or_null(Statement& statement, int place, const std::optional<std::string>& text) {
  text ? statement.bind(place, *text) : statement.bind(place);
}

/// Runs a statement that is kept for the next row.
void write(Statement& statement) {
  statement.exec();
  statement.reset();
}

/// The number of a row that names something, made where it is new.
class Names {
 public:
  Names(SQLite::Database& database, const std::string& find, const std::string& add)
      : find_(database, find), add_(database, add) {}

  template <class... Text>
  std::int64_t id_of(const Text&... text) {
    if (const std::optional<std::int64_t> known = find(text...)) return *known;
    int place = 0;
    (add_.bind(++place, std::string(text)), ...);
    write(add_);
    return find(text...).value();
  }

 private:
  template <class... Text>
  std::optional<std::int64_t> find(const Text&... text) {
    int place = 0;
    (find_.bind(++place, std::string(text)), ...);
    std::optional<std::int64_t> id;
    if (find_.executeStep()) id = find_.getColumn(0).getInt64();
    find_.reset();
    return id;
  }

  Statement find_, add_;
};

std::int64_t add_run(SQLite::Database& database, const HistoryRun& run) {
  Statement statement(database,
                      "INSERT INTO run (kind, time, commit_hash, sources, seed, comparable, "
                      "environment) VALUES (?, ?, ?, ?, ?, ?, ?)");
  statement.bind(1, run.kind);
  statement.bind(2, run.environment.time);
  statement.bind(3, run.environment.commit);
  statement.bind(4, run.sources);
  statement.bind(5, std::to_string(run.seed));
  statement.bind(6, comparable_key(run.environment));
  statement.bind(7, to_json(run.environment));
  statement.exec();
  return database.getLastInsertRowid();
}

void add_parts(SQLite::Database& database, std::int64_t id, const HistoryRun& run) {
  Statement part(database, "INSERT INTO part VALUES (?, ?, ?, ?, ?)");
  for (const HistoryPart& p : run.parts) {
    part.bind(1, id);
    part.bind(2, p.name);
    part.bind(3, std::string(to_string(p.status)));
    part.bind(4, p.seconds);
    part.bind(5, p.note);
    write(part);
  }
  Statement seed_run(database, "INSERT INTO seed_run VALUES (?, ?)");
  for (const SeedRun& s : run.seed_runs) {
    seed_run.bind(1, id);
    seed_run.bind(2, to_json(s));
    write(seed_run);
  }
}

/// Statistics over nights go on from these numbers.
bool keeps_figures(verify::CheckKind kind) {
  using enum verify::CheckKind;
  return kind == mean || kind == agreement || kind == variance_ratio || kind == proportion;
}

std::optional<std::string> kept_figures(const verify::CheckResult& check) {
  if (!keeps_figures(check.kind)) return std::nullopt;
  Json json = Json::object();
  detail::FieldWriter writer(json);
  detail::visit_figures(writer, check.figures);
  return json.dump();
}

void add_checks(SQLite::Database& database, std::int64_t id,
                const std::vector<verify::CheckResult>& checks) {
  Names subjects(database, "SELECT id FROM subject WHERE kind = ? AND name = ?",
                 "INSERT INTO subject (kind, name) VALUES (?, ?)");
  Statement row(database,
                "INSERT INTO check_result VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (const verify::CheckResult& check : checks) {
    row.bind(1, id);
    row.bind(2, subjects.id_of(verify::to_string(check.kind), check.subject));
    row.bind(3, std::string(verify::to_string(check.verdict)));
    row.bind(4, std::string(verify::to_string(check.expected)));
    row.bind(5, check.waived.empty() ? 0 : 1);
    bind_or_null(row, 6, check.estimate);
    bind_or_null(row, 7, check.reference);
    bind_or_null(row, 8, check.tolerance);
    bind_or_null(row, 9, check.bound);
    bind_or_null(row, 10, check.p_value);
    row.bind(11, static_cast<std::int64_t>(check.samples));
    row.bind(12, check.seconds);
    bind_or_null(row, 13, kept_figures(check));
    bind_or_null(row, 14, check.as_expected() ? std::nullopt : std::optional(to_json(check)));
    write(row);
  }
}

void add_measured(SQLite::Database& database, std::int64_t id, const HistoryData& data) {
  Names quantities(database, "SELECT id FROM quantity WHERE name = ? AND unit = ? AND better = ?",
                   "INSERT INTO quantity (name, unit, better) VALUES (?, ?, ?)");
  Statement distribution(database, "INSERT INTO distribution VALUES (?, ?, ?)");
  for (const Distribution& d : data.distributions) {
    const char* better = d.lower_is_better ? "lower" : "higher";
    Json values = Json::array();
    for (const double value : d.values) values.push_back(detail::json_from_double(value));
    distribution.bind(1, id);
    distribution.bind(2, quantities.id_of(d.name, d.unit, better));
    distribution.bind(3, values.dump());
    write(distribution);
  }
  Statement counter(database, "INSERT INTO counter VALUES (?, ?, ?)");
  for (const Counter& c : data.counters) {
    counter.bind(1, id);
    counter.bind(2, quantities.id_of(c.name, c.unit, "same"));
    counter.bind(3, static_cast<std::int64_t>(c.value));
    write(counter);
  }
}

}  // namespace

std::string_view to_string(PartStatus status) {
  for (const auto& [candidate, word] : kStatuses) {
    if (candidate == status) return word;
  }
  return {};
}

std::optional<PartStatus> part_status(std::string_view word) {
  for (const auto& [status, candidate] : kStatuses) {
    if (candidate == word) return status;
  }
  return std::nullopt;
}

std::string comparable_key(const RunEnvironment& environment) {
  return environment.cpu + " x " + std::to_string(environment.cores) + ", " + environment.compiler +
         ", " + environment.flags;
}

History::History(const std::filesystem::path& file, Access access)
    : file_(file),
      database_(detail::open_database(file, access == Access::append, detail::migrations())) {}

History::~History() = default;

std::int64_t History::append(const HistoryRun& run, const HistoryData& data) {
  std::int64_t id = 0;
  detail::ask(file_, [&] {
    SQLite::Transaction transaction(*database_, SQLite::TransactionBehavior::IMMEDIATE);
    id = add_run(*database_, run);
    add_parts(*database_, id, run);
    add_checks(*database_, id, data.checks);
    add_measured(*database_, id, data);
    transaction.commit();
  });
  return id;
}

}  // namespace plumbline::reports
